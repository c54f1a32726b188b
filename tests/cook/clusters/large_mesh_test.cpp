// Clusters a mesh of a million triangles, and meshes of the asset corpus where it is installed.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/core/hierarchy.h"
#include "tests/support/sanitized.h"
#include "tests/support/shapes.h"
#include "tests/support/soundness.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

namespace
{

using namespace hearth;

TEST(LargeMesh, ofAMillionTrianglesIsSound)
{
    const mesh::SourceMesh mesh = shapes::rock(test::kSanitized ? 50 : 289, 0.4f);
    ASSERT_GE(mesh.triangleCount(), test::kSanitized ? 30000u : 1000000u);
    const clusters::Hierarchy hierarchy = clusters::buildHierarchy(mesh);
    EXPECT_EQ(cuts::unsoundness(mesh, hierarchy), "");
    EXPECT_EQ(hierarchy.levels.back().clusters.count, 1u);
    EXPECT_EQ(hierarchy.counts.stuck_groups, 0u);
}

bool isSource(const std::filesystem::path& path)
{
    static const std::vector<std::string> extensions{".glb", ".gltf", ".obj", ".ply", ".stl", ".off"};
    return std::find(extensions.begin(), extensions.end(), path.extension()) != extensions.end();
}

TEST(RealMeshes, areSound)
{
    const char* assets = std::getenv("HEARTH_ASSETS");
    if (assets == nullptr)
        GTEST_SKIP() << "HEARTH_ASSETS does not name a folder of assets";
    ASSERT_TRUE(std::filesystem::exists(HEARTH_IMPORT)) << "hearth-import is not built";
    std::vector<std::filesystem::path> sources;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(std::filesystem::path(assets) / "good"))
        if (entry.is_regular_file() && isSource(entry.path()) &&
            !(test::kSanitized && entry.file_size() > test::kLargeFile))
            sources.push_back(entry.path());
    std::sort(sources.begin(), sources.end());

    // the corpus test cooks all assets; this test takes only meshes up to this size, to limit its time
    constexpr size_t kMaxTriangles = test::kSanitized ? 10000 : 60000;
    constexpr size_t kBudget = 10 * kMaxTriangles;
    size_t budget = kBudget;
    size_t mesh_count = 0;
    for (const auto& source : sources)
    {
        const test::TemporaryFolder folder;
        const std::string part = folder.file("import.part");
        const std::string command =
            std::string(HEARTH_IMPORT) + " '" + source.string() + "' -o '" + part + "' 2> /dev/null";
        if (std::system(command.c_str()) != 0)
            continue; // sources that the import refuses are tested elsewhere
        const auto reader = formats::ContainerReader::open(part);
        ASSERT_TRUE(reader.ok());
        for (uint32_t i = 0; reader->find(formats::kChunkSourceMesh, i) != nullptr; ++i)
        {
            const auto mesh = mesh::readSourceMesh(*reader, i);
            ASSERT_TRUE(mesh.ok());
            if (mesh->triangleCount() > std::min(budget, kMaxTriangles))
                continue;
            budget -= mesh->triangleCount();
            ++mesh_count;
            EXPECT_EQ(cuts::unsoundness(*mesh, clusters::buildHierarchy(*mesh)), "")
                << source << " mesh " << i;
        }
    }
    EXPECT_GT(mesh_count, 0u);
    std::printf("%zu meshes, %zu triangles\n", mesh_count, kBudget - budget);
}

} // namespace

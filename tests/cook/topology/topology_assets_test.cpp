// Compares boundaries of real models, as hearth-import writes them, with OpenMesh's.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/cook/topology/expect_boundary.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

namespace hearth::test
{

TEST(TopologyOfAssets, hasTheBoundariesThatOpenMeshHas)
{
    const char* const assets = std::getenv("HEARTH_ASSETS");
    if (assets == nullptr)
        GTEST_SKIP() << "HEARTH_ASSETS does not name the folder of the asset corpus";
    size_t meshes = 0;
    for (const char* const category : {"game-props", "obj-scan", "obj-syntax", "ply", "off", "stl", "skinned",
                                       "draco-skinned", "strips-fans", "scene"})
        for (const auto& entry :
             std::filesystem::recursive_directory_iterator(std::string(assets) + "/good/" + category))
        {
            const std::string extension = entry.path().extension();
            if (extension != ".gltf" && extension != ".glb" && extension != ".obj" && extension != ".ply" &&
                extension != ".off" && extension != ".stl")
                continue;
            SCOPED_TRACE(entry.path());
            const TemporaryFolder folder;
            const std::string part = folder.file("import.part");
            const std::string command = std::string(HEARTH_BIN) + "/hearth-import '" + entry.path().string() +
                                        "' -o '" + part + "' 2> /dev/null";
            ASSERT_EQ(std::system(command.c_str()), 0);
            const auto reader = formats::ContainerReader::open(part);
            ASSERT_TRUE(reader.ok());
            for (uint32_t i = 0; reader->find(formats::kChunkSourceMesh, i) != nullptr; ++i, ++meshes)
                expectBoundaryOfOpenMesh(mesh::readSourceMesh(*reader, i).value());
        }
    EXPECT_GT(meshes, 20u);
}

} // namespace hearth::test

// From an import part to a clusters part, as the program does it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/cluster_part.h"
#include "formats/pack_check.h"
#include "tests/cook/shapes.h"
#include "tests/formats/temporary_folder.h"

#include <gtest/gtest.h>

namespace
{

using namespace hearth;
using formats::PackView;

std::string messageOf(const Status& status)
{
    return status.ok() ? "" : formatMessage(status.error());
}

void writeImportPart(const std::string& path, const std::vector<mesh::SourceMesh>& meshes)
{
    auto writer = formats::ContainerWriter::create(path, formats::ContainerKind::part);
    ASSERT_TRUE(writer.ok());
    for (uint32_t i = 0; i < meshes.size(); ++i)
        ASSERT_TRUE(mesh::writeSourceMesh(*writer, i, meshes[i]).ok());
    ASSERT_TRUE(writer->finish().ok());
}

TEST(ClustersPart, holdsTheHierarchiesOfAllMeshes)
{
    const test::TemporaryFolder folder;
    const std::string import_path = folder.file("import.part");
    const std::string output_path = folder.file("clusters.part");
    std::vector<mesh::SourceMesh> meshes{shapes::rock(20, 0.3f), mesh::SourceMesh{}, shapes::soup(500),
                                         shapes::terrain(40)};
    meshes[0].name = "rock";
    meshes[3].name = "terrain";
    meshes[2].joint_sets.push_back(std::vector<mesh::Joints4>(meshes[2].vertexCount()));
    meshes[2].weight_sets.push_back(std::vector<Float4>(meshes[2].vertexCount(), {1, 0, 0, 0}));
    writeImportPart(import_path, meshes);
    std::vector<std::string> seen;
    const auto observe = [&](uint32_t index, const std::string& name, const clusters::Config&,
                             const clusters::Hierarchy& hierarchy)
    {
        EXPECT_EQ(index, seen.size());
        EXPECT_EQ(hierarchy.mesh.source_triangles, meshes[index].triangleCount());
        seen.push_back(name);
        return success();
    };
    const auto import_part = formats::ContainerReader::open(import_path);
    ASSERT_TRUE(import_part.ok());
    ASSERT_EQ(messageOf(clusters::writeClustersPart(*import_part, output_path, {}, observe)), "");
    EXPECT_EQ(seen, (std::vector<std::string>{"rock", "", "", "terrain"}));

    auto reader = formats::ContainerReader::open(output_path);
    ASSERT_TRUE(reader.ok());
    const auto view = PackView::read(std::move(*reader));
    ASSERT_TRUE(view.ok());
    EXPECT_EQ(messageOf(formats::checkHierarchy(*view)), "");
    ASSERT_EQ(view->meshes().size(), 4u);
    EXPECT_EQ(view->text(view->meshes()[0].name), "rock");
    EXPECT_EQ(view->text(view->meshes()[3].name), "terrain");
    EXPECT_EQ(view->meshes()[1].clusters.count, 0u) << "a mesh without triangles keeps its index";
    EXPECT_EQ(view->meshes()[2].skinned, 1u);
    EXPECT_NE(view->container().find(formats::kChunkDeformation, 2), nullptr);
    EXPECT_EQ(view->container().find(formats::kChunkDeformation, 0), nullptr);
}

TEST(ClustersPart, doesNotAppearWhereTheObserverFails)
{
    const test::TemporaryFolder folder;
    writeImportPart(folder.file("import.part"), {shapes::rock(8, 0.3f)});
    const auto import_part = formats::ContainerReader::open(folder.file("import.part"));
    ASSERT_TRUE(import_part.ok());
    const auto fails = [](uint32_t, const std::string&, const clusters::Config&,
                          const clusters::Hierarchy&) -> Status {
        return Error{Issue::usage, "", "", "no such level"};
    };
    const Status status = clusters::writeClustersPart(*import_part, folder.file("out.part"), {}, fails);
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().detail, "no such level");
    EXPECT_EQ(folder.files(), std::set<std::string>{"import.part"});
}

} // namespace

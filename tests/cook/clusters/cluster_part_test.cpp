// Tests the conversion of an import part to a clusters part, as the program does it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/program/cluster_part.h"
#include "formats/pack/pack_check.h"
#include "tests/support/sanitized.h"
#include "tests/support/shapes.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include <tbb/global_control.h>

namespace
{

using namespace hearth;
using formats::PackView;

std::string getMessage(const Status& status)
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
    const auto observe = [&](uint32_t index, const clusters::BuiltMesh& mesh)
    {
        EXPECT_EQ(index, seen.size());
        EXPECT_EQ(mesh.hierarchy.mesh.source_triangles, meshes[index].triangleCount());
        seen.push_back(mesh.name);
        return success();
    };
    const auto import_part = formats::ContainerReader::open(import_path);
    ASSERT_TRUE(import_part.ok());
    ASSERT_EQ(getMessage(clusters::writeClustersPart(*import_part, output_path, {}, observe)), "");
    EXPECT_EQ(seen, (std::vector<std::string>{"rock", "", "", "terrain"}));

    auto reader = formats::ContainerReader::open(output_path);
    ASSERT_TRUE(reader.ok());
    const auto view = PackView::read(std::move(*reader));
    ASSERT_TRUE(view.ok());
    EXPECT_EQ(getMessage(formats::checkHierarchy(*view)), "");
    ASSERT_EQ(view->meshes().size(), 4u);
    EXPECT_EQ(view->text(view->meshes()[0].name), "rock");
    EXPECT_EQ(view->text(view->meshes()[3].name), "terrain");
    EXPECT_EQ(view->meshes()[1].clusters.count, 0u) << "a mesh without triangles keeps its index";
    EXPECT_EQ(view->meshes()[2].skinned, 1u);
}

/// Import part of three rocks, with records that name the LODs of each.
formats::ContainerReader partWithLods(const test::TemporaryFolder& folder,
                                      const std::vector<formats::AuthoredLodRecord>& lods)
{
    const std::string path = folder.file("lods.part");
    auto writer = formats::ContainerWriter::create(path, formats::ContainerKind::part);
    EXPECT_TRUE(writer.ok());
    const uint32_t sizes[] = {40, 20, 3};
    for (uint32_t i = 0; i < 3; ++i)
        EXPECT_TRUE(mesh::writeSourceMesh(*writer, i, shapes::rock(sizes[i], 0.2f)).ok());
    EXPECT_TRUE(writer->addText(formats::kChunkStrings, "mid").ok());
    EXPECT_TRUE(writer->addRecords<formats::AuthoredLodRecord>(formats::kChunkAuthoredLods, lods).ok());
    EXPECT_TRUE(writer->finish().ok());
    auto reader = formats::ContainerReader::open(path);
    EXPECT_TRUE(reader.ok());
    return std::move(*reader);
}

TEST(ClustersPart, hasAuthoredLevelsInTheMeshThatTheyBelongTo)
{
    const test::TemporaryFolder folder;
    const auto part = partWithLods(folder, {{0, 1, 7, {0, 3}}, {0, 2, kInvalidIndex, {}}});
    ASSERT_EQ(getMessage(clusters::writeClustersPart(part, folder.file("out.part"), {}, {})), "");
    auto reader = formats::ContainerReader::open(folder.file("out.part"));
    ASSERT_TRUE(reader.ok());
    const auto view = PackView::read(std::move(*reader));
    ASSERT_TRUE(view.ok());
    EXPECT_EQ(getMessage(formats::checkHierarchy(*view)), "");
    ASSERT_EQ(view->meshes().size(), 3u) << "they keep their numbers";
    EXPECT_EQ(view->meshes()[1].clusters.count, 0u);
    EXPECT_EQ(view->meshes()[2].clusters.count, 0u);
    std::set<uint32_t> counts;
    for (const formats::LevelRecord& level : view->levels())
        counts.insert(level.triangle_count);
    EXPECT_TRUE(counts.contains(12 * 20 * 20) && counts.contains(12 * 3 * 3));
    const bool has_sets =
        std::any_of(view->groups().begin(), view->groups().end(),
                    [](const formats::GroupRecord& group) { return group.set_offset != 0; });
    EXPECT_TRUE(has_sets) << "the level below the first has several groups";
    ASSERT_EQ(view->authoredLevels().size(), 2u);
    const formats::AuthoredLevelRecord mid = view->authoredLevels()[0], low = view->authoredLevels()[1];
    EXPECT_EQ(view->levels()[mid.level].triangle_count, 12u * 20 * 20);
    EXPECT_EQ(view->levels()[low.level].triangle_count, 12u * 3 * 3);
    EXPECT_EQ(mid.number, 7u);
    EXPECT_EQ(view->text(mid.name), "mid");
    EXPECT_EQ(low.number, kInvalidIndex);
    EXPECT_EQ(view->text(low.name), "");
}

TEST(ClustersPart, refusesLevelsOfNoMesh)
{
    const test::TemporaryFolder folder;
    for (const formats::AuthoredLodRecord bad :
         {formats::AuthoredLodRecord{0, 3, 1, {}}, {3, 0, 1, {}}, {1, 1, 1, {}}})
    {
        const Status status =
            clusters::writeClustersPart(partWithLods(folder, {bad}), folder.file("out.part"), {}, {});
        ASSERT_FALSE(status.ok());
        EXPECT_EQ(status.error().issue, Issue::meaning_reference);
        EXPECT_FALSE(std::filesystem::exists(folder.file("out.part")));
    }
}

TEST(ClustersPart, isTheSameForAnyNumberOfThreads)
{
    const test::TemporaryFolder folder;
    std::vector<mesh::SourceMesh> meshes;
    for (uint32_t i = 0; i < (test::kSanitized ? 6 : 24); ++i)
        meshes.push_back(i % 5 == 4 ? shapes::soup(100 + i) : shapes::rock(6 + i, 0.3f));
    writeImportPart(folder.file("import.part"), meshes);
    const auto import_part = formats::ContainerReader::open(folder.file("import.part"));
    ASSERT_TRUE(import_part.ok());
    std::string first;
    for (const size_t threads : {size_t{1}, size_t{2}, size_t{3}, size_t{7}})
    {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        const std::string path = folder.file("out" + std::to_string(threads) + ".part");
        ASSERT_EQ(getMessage(clusters::writeClustersPart(*import_part, path, {}, {})), "");
        std::ifstream file(path, std::ios::binary);
        const std::string bytes{std::istreambuf_iterator<char>(file), {}};
        ASSERT_FALSE(bytes.empty());
        if (first.empty())
            first = bytes;
        EXPECT_TRUE(bytes == first) << threads << " threads";
    }
}

TEST(ClustersPart, doesNotAppearWhereTheObserverFails)
{
    const test::TemporaryFolder folder;
    writeImportPart(folder.file("import.part"), {shapes::rock(8, 0.3f)});
    const auto import_part = formats::ContainerReader::open(folder.file("import.part"));
    ASSERT_TRUE(import_part.ok());
    const auto fails = [](uint32_t, const clusters::BuiltMesh&) -> Status {
        return Error{Issue::usage, "", "", "no such level"};
    };
    const Status status = clusters::writeClustersPart(*import_part, folder.file("out.part"), {}, fails);
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().detail, "no such level");
    EXPECT_EQ(folder.files(), std::set<std::string>{"import.part"});
}

} // namespace

// Tests GLB files that hearth extract writes, as tinygltf reads them: a second opinion about counts,
// triangles, levels, and what is welded.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/export/compare_packs.h"
#include "tests/import_values/source_primitives.h"
#include "tests/support/sandbox.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace hearth::test
{

using namespace formats;

namespace
{

/// A sample as a pack, in a folder of its own.
class GltfFile : public ::testing::Test
{
protected:
    void cook(const std::string& kind)
    {
        ASSERT_EQ(run({HEARTH_BIN "/hearth-samples", kind, "--triangles", "6000", "--texture-size", "32",
                       "-o", "sample.glb"})
                      .exit_code,
                  0);
        const ProgramEnd end =
            run({HEARTH_BIN "/hearth", "cook", "sample.glb", "-o", "sample.hearth", "--no-cache",
                 "--progress", "none", "--visibility", "off", "--bricks", "off"});
        ASSERT_EQ(end.exit_code, 0) << end.err;
        auto reader = ContainerReader::open(folder / "sample.hearth");
        ASSERT_TRUE(reader.ok());
        auto view = PackView::read(std::move(*reader));
        ASSERT_TRUE(view.ok());
        pack = std::make_unique<PackView>(std::move(*view));
    }

    ProgramEnd run(const std::vector<std::string>& command) { return folder.run(command); }

    ProgramEnd extract(std::vector<std::string> options)
    {
        options.insert(options.begin(), {HEARTH_BIN "/hearth", "extract", "sample.hearth"});
        return run(options);
    }

    SourceModel readFile(const std::string& name)
    {
        SourceModel source = readSourceModel(folder / name);
        EXPECT_EQ(source.error, "");
        return source;
    }

    Sandbox folder;
    std::unique_ptr<PackView> pack;
};

/// Append the triangles of a mesh.
void appendTriangles(const SourceModel& source, int mesh, std::vector<SortedTriangle>& triangles)
{
    for (const SourcePiece& piece : readPieces(source, source.model.meshes[static_cast<size_t>(mesh)]))
        for (const SourceTriangle& triangle : piece.triangles)
        {
            std::array<Float3, 3> corners;
            for (size_t i = 0; i < 3; ++i)
                for (int axis = 0; axis < 3; ++axis)
                    corners[i][axis] = static_cast<float>(
                        piece.positions.at(triangle.vertices[i], static_cast<size_t>(axis)));
            triangles.push_back(sortCorners(
                corners, triangle.material < 0 ? kInvalidIndex : static_cast<uint32_t>(triangle.material)));
        }
}

std::vector<SortedTriangle> findTriangles(const SourceModel& source)
{
    std::vector<SortedTriangle> triangles;
    for (const tinygltf::Node& node : source.model.nodes)
        if (node.mesh >= 0)
            appendTriangles(source, node.mesh, triangles);
    std::sort(triangles.begin(), triangles.end());
    return triangles;
}

/// Return the number of vertices of a mesh whose attributes are those of an earlier vertex of the primitive.
size_t countCopies(const SourceModel& source, const tinygltf::Mesh& mesh)
{
    size_t copies = 0;
    for (const tinygltf::Primitive& primitive : mesh.primitives)
    {
        std::vector<SourceValues> columns;
        for (const auto& [name, accessor] : primitive.attributes)
            columns.push_back(readValues(source, accessor));
        for (const auto& target : primitive.targets)
            for (const auto& [name, accessor] : target)
                columns.push_back(readValues(source, accessor));
        std::set<std::vector<double>> rows;
        for (size_t vertex = 0; vertex < columns.front().count(); ++vertex)
        {
            std::vector<double> row;
            for (const SourceValues& column : columns)
                for (size_t c = 0; c < column.components; ++c)
                    row.push_back(column.at(vertex, c));
            copies += rows.insert(row).second ? 0 : 1;
        }
    }
    return copies;
}

size_t countTriangles(const SourceModel& source, int node)
{
    std::vector<SortedTriangle> triangles;
    appendTriangles(source, source.model.nodes[static_cast<size_t>(node)].mesh, triangles);
    return triangles.size();
}

} // namespace

TEST_F(GltfFile, hasTheSceneOfThePack)
{
    for (const char* kind : {"room", "character", "grass"})
    {
        SCOPED_TRACE(kind);
        cook(kind);
        ASSERT_EQ(extract({"-o", "cut.glb"}).exit_code, 0);
        const SourceModel source = readFile("cut.glb");
        EXPECT_TRUE(findTriangles(source) == findDrawnTriangles(*pack));
        EXPECT_EQ(source.model.materials.size(), pack->materials().size());
        EXPECT_EQ(source.model.images.size(), pack->images().size());
        EXPECT_EQ(source.model.skins.size(), pack->skins().size());
        EXPECT_EQ(source.model.animations.size(), pack->animations().size());
        EXPECT_EQ(source.model.lights.size(), pack->lights().size());
        EXPECT_EQ(source.model.cameras.size(), pack->cameras().size());
        for (uint32_t node = 0; node < pack->nodes().size(); ++node)
            EXPECT_EQ(source.model.nodes[node].name, pack->text(pack->nodes()[node].name));
    }
}

TEST_F(GltfFile, hasEachVertexOnceAndOnePrimitiveAMaterial)
{
    cook("character");
    ASSERT_EQ(extract({"-o", "cut.glb"}).exit_code, 0);
    const SourceModel source = readFile("cut.glb");
    for (const tinygltf::Mesh& mesh : source.model.meshes)
    {
        EXPECT_EQ(countCopies(source, mesh), 0u) << mesh.name;
        std::set<int> materials;
        for (const tinygltf::Primitive& primitive : mesh.primitives)
            EXPECT_TRUE(materials.insert(primitive.material).second) << mesh.name;
    }
}

TEST_F(GltfFile, ofOneMeshHasItsCutAtTheError)
{
    cook("transforms");
    const MeshRecord& mesh = pack->meshes()[0];
    ASSERT_GT(mesh.levels.count, 1u);
    const float error = pack->levels()[mesh.levels.first + 1].max_error;
    ASSERT_EQ(extract({"--mesh", "0", "--error", std::to_string(error), "-o", "cut.glb"}).exit_code, 0);
    ASSERT_EQ(extract({"--mesh", "0", "-o", "finest.glb"}).exit_code, 0);
    const SourceModel cut = readFile("cut.glb"), finest = readFile("finest.glb");
    EXPECT_EQ(cut.model.nodes.size(), 1u);
    EXPECT_EQ(countTriangles(finest, 0), pack->levels()[mesh.levels.first].triangle_count);
    EXPECT_LT(countTriangles(cut, 0), countTriangles(finest, 0));

    // the oracle of the cut is the rule at GroupRecord
    size_t expected = 0;
    for (uint32_t c = mesh.clusters.first; c < mesh.clusters.first + mesh.clusters.count; ++c)
    {
        const ClusterRecord& cluster = pack->clusters()[c];
        const float own =
            cluster.refined_group == kInvalidIndex ? 0 : pack->groups()[cluster.refined_group].error;
        if (own <= std::stof(std::to_string(error)) &&
            pack->groups()[cluster.group].error > std::stof(std::to_string(error)))
            expected += cluster.triangle_count;
    }
    EXPECT_EQ(countTriangles(cut, 0), expected);
}

TEST_F(GltfFile, hasCoarserLevelsWhereTheyAreAskedFor)
{
    cook("transforms");
    const ProgramEnd without = extract({"-o", "plain.glb"});
    EXPECT_NE(without.out.find("coarser levels (--lods writes them)"), std::string::npos) << without.out;
    ASSERT_EQ(extract({"--lods", "-o", "cut.glb"}).exit_code, 0);
    const SourceModel source = readFile("cut.glb");
    size_t chains = 0;
    for (size_t i = 0; i < pack->nodes().size(); ++i)
    {
        const tinygltf::Node& node = source.model.nodes[i];
        const auto lods = node.extensions.find("MSFT_lod");
        if (lods == node.extensions.end())
            continue;
        ++chains;
        size_t finer = countTriangles(source, static_cast<int>(i));
        const tinygltf::Value& ids = lods->second.Get("ids");
        for (size_t level = 0; level < ids.ArrayLen(); ++level)
        {
            const int id = ids.Get(static_cast<int>(level)).GetNumberAsInt();
            EXPECT_LT(countTriangles(source, id), finer);
            EXPECT_EQ(
                std::count(source.model.scenes[0].nodes.begin(), source.model.scenes[0].nodes.end(), id), 0);
            finer = countTriangles(source, id);
        }
    }
    EXPECT_GT(chains, 0u);
}

TEST_F(GltfFile, hasTheSameBytesEachTime)
{
    cook("room");
    ASSERT_EQ(extract({"-o", "a.glb"}).exit_code, 0);
    ASSERT_EQ(extract({"-o", "b.glb"}).exit_code, 0);
    EXPECT_TRUE(folder.read("a.glb") == folder.read("b.glb"));
}

TEST_F(GltfFile, isWrittenWholeOrNotAtAll)
{
    cook("transforms");
    const auto before = folder.list();
    EXPECT_EQ(extract({"-o", "nowhere/cut.glb"}).exit_code, 73);
    const ProgramEnd missing = extract({"--mesh", "99", "-o", "cut.glb"});
    EXPECT_EQ(missing.exit_code, 2);
    EXPECT_NE(missing.err.find("there is no mesh 99"), std::string::npos) << missing.err;
    EXPECT_EQ(folder.list(), before);
}

} // namespace hearth::test

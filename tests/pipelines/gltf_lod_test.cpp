// Tests LODs in glTF files: MSFT_lod, names, and unusable LODs.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/tools/lod_files.h"
#include "pipelines/import/part/bake_transform.h"
#include "tests/pipelines/gltf_fixture.h"
#include "tests/support/sanitized.h"

#include <cmath>

namespace hearth::import::test
{

namespace
{

using namespace formats;

/// Meshes 0, 1 and 2 are the square with 2, 1 and 1 triangles; mesh 3 has points alone. Accessors 0 to 2.
GltfData lodData()
{
    GltfData data;
    data.add("VEC3", kSquare);
    data.add("SCALAR", kSquareIndices);
    data.add("SCALAR", std::vector<uint16_t>{0, 1, 2});
    return data;
}

const std::string kMeshes = R"("meshes":[
    {"name":"a","primitives":[{"attributes":{"POSITION":0},"indices":1}]},
    {"name":"b","primitives":[{"attributes":{"POSITION":0},"indices":2}]},
    {"name":"c","primitives":[{"attributes":{"POSITION":0},"indices":2}]},
    {"name":"d","primitives":[{"attributes":{"POSITION":0},"mode":0}]}],)";

Imported import(const std::string& rest)
{
    Imported result = lodData().import(kMeshes + rest);
    EXPECT_TRUE(result.ok()) << result.message();
    return result;
}

std::vector<std::pair<uint32_t, uint32_t>> getLods(const Imported& result)
{
    std::vector<std::pair<uint32_t, uint32_t>> lods;
    for (const AuthoredLodRecord& record : result.records<AuthoredLodRecord>(kChunkAuthoredLods))
        lods.push_back({record.mesh, record.lod});
    return lods;
}

std::vector<uint32_t> drawnNodes(const Imported& result)
{
    std::vector<uint32_t> nodes;
    for (const InstanceRecord& instance : result.records<InstanceRecord>(kChunkInstances))
        nodes.push_back(instance.node);
    return nodes;
}

using Lods = std::vector<std::pair<uint32_t, uint32_t>>;
using Nodes = std::vector<uint32_t>;

TEST(GltfLods, listedByANodeAreMeshesOfTheirOwnAndNotDrawn)
{
    const Imported result = import(R"("extensionsUsed":["MSFT_lod"],
        "nodes":[{"mesh":0,"extensions":{"MSFT_lod":{"ids":[1,2]}}},{"mesh":1},{"mesh":2}])");
    EXPECT_EQ(getLods(result), (Lods{{0, 4}, {0, 5}}));
    EXPECT_EQ(drawnNodes(result), (Nodes{0}));
    EXPECT_EQ(result.mesh(4).name, "b");
    EXPECT_EQ(result.mesh(4).triangleCount(), 1u);
    EXPECT_EQ(result.mesh(5).name, "c");
    EXPECT_EQ(result.mesh(1).triangleCount(), 0u) << "its number stays, its triangles are in mesh 4";
    EXPECT_EQ(result.counts.triangles, 4u);
    EXPECT_FALSE(result.hasWarning(Issue::dropped, "MSFT_lod"));
}

TEST(GltfLods, areMovedToWhereTheFinestStands)
{
    // node 0 stands at x = 10 with scale 2; its level stands beside it, turned over in x
    const Imported result = import(R"("nodes":[
        {"mesh":0,"translation":[10,0,0],"scale":[2,2,2],"extensions":{"MSFT_lod":{"ids":[1]}}},
        {"mesh":1,"translation":[14,0,0],"scale":[-4,4,4]}],"scenes":[{"nodes":[0,1]}])");
    ASSERT_EQ(getLods(result), (Lods{{0, 4}}));
    const mesh::SourceMesh lod = result.mesh(4);
    // corner (1, 1, 0) stands at x = 14 - 4 = 10, y = 4: (0, 2, 0) of node 0
    ASSERT_EQ(lod.triangleCount(), 1u);
    Float3 normal = cross(lod.positions[lod.indices[1]] - lod.positions[lod.indices[0]],
                          lod.positions[lod.indices[2]] - lod.positions[lod.indices[0]]);
    EXPECT_GT(normal.z, 0) << "it faces the same side as before, though it is mirrored";
    EXPECT_GT(lod.normals[lod.indices[0]].z, 0.99f);
    bool found = false;
    for (const Float3 p : lod.positions)
        found |= length(p - Float3{0, 2, 0}) < 1e-6f;
    EXPECT_TRUE(found);
}

TEST(GltfLods, outsideOfTheSceneStandInPlaceOfTheFinest)
{
    const Imported result = import(R"("scenes":[{"nodes":[1]}],"nodes":[
        {"mesh":0,"translation":[1,0,0],"extensions":{"MSFT_lod":{"ids":[2]}}},
        {"children":[0],"translation":[0,50,0],"scale":[3,3,3]},
        {"mesh":1,"translation":[1,0,0]}])");
    ASSERT_EQ(getLods(result), (Lods{{0, 4}}));
    for (const Float3 p : result.mesh(4).positions)
        EXPECT_TRUE(p.x > -1e-6f && p.x < 1 + 1e-6f && p.y > -1e-6f && p.y < 1 + 1e-6f) << p.x << " " << p.y;
}

TEST(GltfLods, areFoundByTheNamesOfNodes)
{
    const Imported result = import(R"("nodes":[
        {"mesh":0,"name":"Rock_LOD0"},{"mesh":2,"name":"rock_lod2"},{"mesh":1,"name":"Rock_Lod1"},
        {"mesh":1,"name":"Tree_LOD1"},{"mesh":2,"name":"Rock_LOD"},{"children":[6]},{"mesh":2,"name":"Rock_LOD3"}])");
    EXPECT_EQ(getLods(result), (Lods{{0, 4}, {0, 5}}));
    EXPECT_EQ(result.mesh(4).name, "b");
    EXPECT_EQ(result.mesh(5).name, "c");
    EXPECT_EQ(drawnNodes(result), (Nodes{0, 3, 4, 6}))
        << "a level without a finest one, other names, and nodes elsewhere are drawn as ever";
}

/// Return the number and name of each level, as "2 rock_lod2"; "-" for no number.
std::vector<std::string> getLabels(const Imported& result)
{
    const std::string strings = result.text(kChunkStrings);
    std::vector<std::string> labels;
    for (const AuthoredLodRecord& record : result.records<AuthoredLodRecord>(kChunkAuthoredLods))
        labels.push_back((record.number == kInvalidIndex ? "-" : std::to_string(record.number)) + " " +
                         strings.substr(record.name.offset, record.name.length));
    return labels;
}

TEST(GltfLods, keepTheirNamesAndTheNumbersInThem)
{
    using Labels = std::vector<std::string>;
    EXPECT_EQ(getLabels(import(R"("nodes":[
        {"mesh":0,"name":"Rock_LOD0"},{"mesh":2,"name":"rock_lod4"},{"mesh":1,"name":"Rock_LOD2"}])")),
              (Labels{"2 Rock_LOD2", "4 rock_lod4"}));
    EXPECT_EQ(getLabels(import(R"("extensionsUsed":["MSFT_lod"],"nodes":[
        {"mesh":0,"extensions":{"MSFT_lod":{"ids":[1,2]}}},{"mesh":1},{"mesh":2,"name":"far"}])")),
              (Labels{"- b", "- far"}))
        << "a node without a name has that of its mesh";
    const std::string named = replaced(replaced(kMeshes, R"("a")", R"("x_LOD0")"), R"("b")", R"("x_LOD7")");
    EXPECT_EQ(getLabels(lodData().import(named + R"("nodes":[{"mesh":0,"name":"n"},{"mesh":1,"name":"m"}])")),
              (Labels{"7 x_LOD7"}))
        << "the mesh's name has the number";
}

TEST(GltfLods, areFoundByTheNamesOfMeshes)
{
    GltfData data = lodData();
    const Imported result =
        data.import(replaced(replaced(replaced(kMeshes, R"("a")", R"("x_LOD0")"), R"("b")", R"("x_LOD1")"),
                             R"("c")", R"("X_lod2")") +
                    R"("nodes":[{"mesh":0},{"mesh":1}])");
    ASSERT_TRUE(result.ok()) << result.message();
    EXPECT_EQ(getLods(result), (Lods{{0, 4}})) << "node 1 is the level of node 0";
    EXPECT_EQ(drawnNodes(result), (Nodes{0}));
}

TEST(GltfLods, mayBeMeshesThatNoNodeHas)
{
    GltfData data = lodData();
    const Imported result =
        data.import(replaced(replaced(kMeshes, R"("a")", R"("x_LOD0")"), R"("b")", R"("x_LOD1")") +
                    R"("nodes":[{"mesh":0,"translation":[5,5,5]}])");
    ASSERT_TRUE(result.ok()) << result.message();
    EXPECT_EQ(getLods(result), (Lods{{0, 4}}));
    EXPECT_EQ(result.mesh(4).positions.size(), 3u);
    EXPECT_LE(result.mesh(4).positions[0].x, 1);
}

TEST(GltfLods, ofAMeshThatIsAlsoDrawnAreCopies)
{
    const Imported result = import(R"("nodes":[
        {"mesh":0,"extensions":{"MSFT_lod":{"ids":[1]}}},{"mesh":1},{"mesh":1,"translation":[3,0,0]}])");
    EXPECT_EQ(getLods(result), (Lods{{0, 4}}));
    EXPECT_EQ(drawnNodes(result), (Nodes{0, 2}));
    EXPECT_EQ(result.mesh(1).triangleCount(), 1u);
    EXPECT_EQ(result.counts.triangles, 4u) << "mesh 1 counts once";
}

TEST(GltfLods, ofAMeshInSeveralNodesAreThoseOfTheFirst)
{
    const Imported same = import(R"("nodes":[
        {"mesh":0,"extensions":{"MSFT_lod":{"ids":[2]}}},
        {"mesh":0,"translation":[9,0,0],"extensions":{"MSFT_lod":{"ids":[3]}}},
        {"mesh":1},{"mesh":1,"translation":[9,0,0]}])");
    EXPECT_EQ(getLods(same), (Lods{{0, 4}}));
    EXPECT_EQ(drawnNodes(same), (Nodes{0, 1}));
    EXPECT_FALSE(same.hasWarning(Issue::dropped, "other levels"));

    const Imported other = import(R"("nodes":[
        {"mesh":0,"extensions":{"MSFT_lod":{"ids":[2]}}},{"mesh":0,"extensions":{"MSFT_lod":{"ids":[3]}}},
        {"mesh":1},{"mesh":2}])");
    EXPECT_EQ(getLods(other), (Lods{{0, 4}}));
    EXPECT_TRUE(other.hasWarning(Issue::dropped, "mesh 0 has other levels of detail in node 0"));
}

TEST(GltfLods, thatAreNotUsableAreDroppedByName)
{
    const Imported range = import(R"("nodes":[
        {"mesh":0,"extensions":{"MSFT_lod":{"ids":[1,7,-1,0.5,1e30]}}},{"mesh":1}])");
    EXPECT_EQ(getLods(range), (Lods{{0, 4}})) << "the others stay";
    for (const char* id : {"detail 7 is", "detail -1 is", "detail 0.5 is", "detail 1e+30 is"})
        EXPECT_TRUE(range.hasWarning(Issue::dropped, id)) << id;

    const Imported itself = import(R"("nodes":[{"mesh":0,"extensions":{"MSFT_lod":{"ids":[0]}}}])");
    EXPECT_TRUE(getLods(itself).empty());
    EXPECT_EQ(drawnNodes(itself), (Nodes{0}));
    EXPECT_TRUE(itself.hasWarning(Issue::dropped, "node 0 cannot be a level of detail of what it holds"));

    const Imported above = import(R"("nodes":[
        {"mesh":1,"children":[1]},{"mesh":0,"extensions":{"MSFT_lod":{"ids":[0]}}}])");
    EXPECT_EQ(drawnNodes(above), (Nodes{0, 1}));
    EXPECT_TRUE(above.hasWarning(Issue::dropped, "node 0 cannot be a level"));

    const Imported cycle = import(R"("nodes":[
        {"mesh":0,"extensions":{"MSFT_lod":{"ids":[1]}}},{"mesh":1,"extensions":{"MSFT_lod":{"ids":[0]}}}])");
    EXPECT_EQ(getLods(cycle), (Lods{{0, 4}}));
    EXPECT_TRUE(cycle.hasWarning(Issue::dropped, "cannot have levels of its own"));

    const Imported backwards = import(R"("nodes":[
        {"mesh":0,"extensions":{"MSFT_lod":{"ids":[2]}}},{"mesh":1,"extensions":{"MSFT_lod":{"ids":[0]}}},
        {"mesh":2}])");
    EXPECT_EQ(getLods(backwards), (Lods{{0, 4}}));
    EXPECT_EQ(drawnNodes(backwards), (Nodes{0, 1}));
    EXPECT_TRUE(backwards.hasWarning(Issue::dropped, "node 0 cannot be a level of detail: it has levels"));
}

TEST(GltfLods, withoutAMeshAreDroppedByName)
{
    const Imported empty = import(R"("nodes":[
        {"mesh":0,"extensions":{"MSFT_lod":{"ids":[1,2,3]}}},{"name":"empty"},{"mesh":3},{"mesh":0}])");
    EXPECT_TRUE(getLods(empty).empty());
    EXPECT_EQ(drawnNodes(empty), (Nodes{0}));
    EXPECT_TRUE(empty.hasWarning(Issue::dropped, "a level of detail of node 0 has no mesh"));
    EXPECT_TRUE(empty.hasWarning(Issue::dropped, "a level of detail of mesh 0 has no triangles"));
    EXPECT_TRUE(empty.hasWarning(Issue::dropped, "has the same mesh"));

    const Imported base = import(R"("nodes":[
        {"extensions":{"MSFT_lod":{"ids":[1]}},"children":[2]},{"mesh":1},{"mesh":0}])");
    EXPECT_TRUE(getLods(base).empty());
    EXPECT_EQ(drawnNodes(base), (Nodes{2})) << "the finest is drawn, and the level is not";
    EXPECT_TRUE(base.hasWarning(Issue::dropped, "levels of detail of a node without a mesh"));

    const Imported below = import(R"("nodes":[
        {"mesh":0,"extensions":{"MSFT_lod":{"ids":[1]}}},{"mesh":1,"children":[2]},{"mesh":2}])");
    EXPECT_EQ(getLods(below), (Lods{{0, 4}}));
    EXPECT_EQ(drawnNodes(below), (Nodes{0}));
    EXPECT_TRUE(below.hasWarning(Issue::dropped, "meshes below a level of detail"));
}

TEST(GltfLods, areAFewCopiesAtMost)
{
    const Imported twice = import(R"("nodes":[
        {"mesh":0,"extensions":{"MSFT_lod":{"ids":[1,1,2]}}},{"mesh":1},{"mesh":1}])");
    EXPECT_EQ(getLods(twice), (Lods{{0, 4}}));
    EXPECT_TRUE(twice.hasWarning(Issue::dropped, "has the same mesh"));

    std::string meshes, nodes, ids;
    for (int i = 0; i < 100; ++i)
    {
        meshes += R"({"primitives":[{"attributes":{"POSITION":0},"indices":1}]},)";
        nodes += R"({"mesh":)" + std::to_string(i) + "},";
        ids += std::to_string(i) + (i < 99 ? "," : "");
    }
    const Imported many =
        lodData().import(R"("meshes":[)" + meshes +
                         R"({"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"nodes":[)" + nodes +
                         R"({"mesh":100,"extensions":{"MSFT_lod":{"ids":[)" + ids + "]}}}]");
    ASSERT_TRUE(many.ok()) << many.message();
    EXPECT_EQ(getLods(many).size(), 64u);
    EXPECT_TRUE(many.hasWarning(Issue::dropped, "more than 64 levels"));
}

TEST(GltfLods, ofMaterialsAreDroppedByName)
{
    const Imported result =
        import(R"("materials":[{"extensions":{"MSFT_lod":{"ids":[1]}}},{}],"nodes":[{"mesh":0}])");
    EXPECT_TRUE(result.hasWarning(Issue::dropped, "levels of detail of materials"));
}

TEST(GltfLods, mustBeSkinnedLikeTheFinest)
{
    const Imported result = import(R"("skins":[{"joints":[2]}],"nodes":[
        {"mesh":0,"extensions":{"MSFT_lod":{"ids":[1]}}},{"mesh":1,"skin":0},{}])");
    EXPECT_TRUE(getLods(result).empty());
    EXPECT_TRUE(result.hasWarning(Issue::dropped, "must be skinned like it"));
}

TEST(GltfLods, thatCannotBeMovedAreDropped)
{
    const Imported flat = import(R"("nodes":[
        {"mesh":0,"scale":[1,1,0],"extensions":{"MSFT_lod":{"ids":[1]}}},{"mesh":1}])");
    EXPECT_TRUE(getLods(flat).empty());
    EXPECT_TRUE(flat.hasWarning(Issue::dropped, "cannot be moved"));
    const Imported far = import(R"("nodes":[
        {"mesh":0,"extensions":{"MSFT_lod":{"ids":[1]}}},{"mesh":1,"translation":[2e9,0,0]}])");
    EXPECT_TRUE(getLods(far).empty());
}

TEST(GltfLods, inADeepTreeDoNotCostItsDepth)
{
    // each of many nodes on one long branch lists the last one, which contains none of them
    constexpr int kDepth = hearth::test::kSanitized ? 5000 : 20000;
    std::string nodes = R"("nodes":[)";
    for (int i = 0; i < kDepth; ++i)
        nodes += R"({"mesh":0,"children":[)" + std::to_string(i + 1) +
                 R"(],"extensions":{"MSFT_lod":{"ids":[)" + std::to_string(kDepth + 1) + "]}}},";
    const Imported result = import(nodes + R"({"mesh":0},{"mesh":1}],"scenes":[{"nodes":[0]}])");
    EXPECT_EQ(getLods(result), (Lods{{0, 4}}));
}

TEST(ParseLodName, findsTheLevel)
{
    const auto parsed = [](std::string_view name)
    {
        const auto lod = tools::parseLodName(name);
        return lod ? lod->stem + ":" + std::to_string(lod->level) : std::string("-");
    };
    EXPECT_EQ(parsed("Rock_LOD0"), "rock:0");
    EXPECT_EQ(parsed("a_lod_Lod12"), "a_lod:12");
    EXPECT_EQ(parsed("_lod3"), ":3");
    EXPECT_EQ(parsed("Rock_LOD"), "-");
    EXPECT_EQ(parsed("Rock_LOD1234"), "-");
    EXPECT_EQ(parsed("RockLOD1"), "-");
    EXPECT_EQ(parsed("Rock_LOD1.001"), "-");
    EXPECT_EQ(parsed("7"), "-");
}

TEST(BakeTransform, turnsNormalsAndTangents)
{
    mesh::SourceMesh mesh;
    mesh.positions = {{1, 2, 3}};
    mesh.normals = {{0.70710678f, 0.70710678f, 0}};
    mesh.tangents = {{0.70710678f, -0.70710678f, 0, 1}};
    Transform squashed;
    squashed.m[1][1] = 0.5;
    squashed.m[2][2] = -1;
    squashed.m[0][3] = 7;
    ASSERT_TRUE(bakeTransform(mesh, squashed));
    EXPECT_EQ(mesh.positions[0], (Float3{8, 1, -3}));
    EXPECT_NEAR(mesh.normals[0].y / mesh.normals[0].x, 2, 1e-6) << "steeper where the surface is squashed";
    EXPECT_NEAR(length(mesh.normals[0]), 1, 1e-6);
    EXPECT_NEAR(mesh.tangents[0].y / mesh.tangents[0].x, -0.5, 1e-6);
    EXPECT_EQ(mesh.tangents[0].w, -1.0f) << "mirrored";
}

} // namespace

} // namespace hearth::import::test

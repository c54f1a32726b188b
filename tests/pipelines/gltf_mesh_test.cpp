// Tests the import of primitives: triangles, attributes, generated and dropped data.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/pipelines/gltf_fixture.h"

namespace hearth::import::test
{

namespace
{

/// Return the corners of all triangles in order, which do not change when vertices are split.
std::vector<Float3> corners(const mesh::SourceMesh& mesh)
{
    std::vector<Float3> result;
    for (const uint32_t index : mesh.indices)
        result.push_back(mesh.positions[index]);
    return result;
}

/// Five points of a zigzag strip.
const std::vector<float> kStrip{0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 2, 0, 0};

std::vector<Float3> stripPoints(std::initializer_list<size_t> order)
{
    std::vector<Float3> points;
    for (const size_t i : order)
        points.push_back({kStrip[i * 3], kStrip[i * 3 + 1], kStrip[i * 3 + 2]});
    return points;
}

Imported importStrip(int mode)
{
    GltfData data;
    data.add("VEC3", kStrip);
    return data.import(R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":)" +
                       std::to_string(mode) + "}]}]");
}

TEST(GltfPrimitives, turnStripsSoThatAllTrianglesFaceAlike)
{
    const Imported result = importStrip(5);
    ASSERT_TRUE(result.ok()) << result.message();
    EXPECT_EQ(corners(result.mesh()), stripPoints({0, 1, 2, 1, 3, 2, 2, 3, 4}));
}

TEST(GltfPrimitives, openFansAroundTheirFirstVertex)
{
    const Imported result = importStrip(6);
    ASSERT_TRUE(result.ok()) << result.message();
    EXPECT_EQ(corners(result.mesh()), stripPoints({1, 2, 0, 2, 3, 0, 3, 4, 0}));
}

TEST(GltfPrimitives, leaveOutIndicesThatMakeNoWholeTriangle)
{
    const Imported result = importStrip(4);
    ASSERT_TRUE(result.ok()) << result.message();
    EXPECT_EQ(corners(result.mesh()), stripPoints({0, 1, 2}));
    EXPECT_TRUE(result.hasWarning(Issue::dropped, "no whole triangle"));
}

TEST(GltfPrimitives, nameThePointsAndLinesThatAreLeftOut)
{
    for (const int mode : {0, 1, 2, 3})
    {
        const Imported result = importStrip(mode);
        ASSERT_TRUE(result.ok()) << result.message();
        EXPECT_EQ(result.mesh().triangleCount(), 0u);
        EXPECT_EQ(result.counts.vertices, 5u);
        EXPECT_TRUE(
            result.hasWarning(Issue::dropped, mode == 0 ? "primitive of points" : "primitive of lines"));
    }
}

TEST(GltfPrimitives, readIndicesOfEveryWidth)
{
    const auto read = [](const auto& indices)
    {
        GltfData data;
        data.add("VEC3", kSquare);
        data.add("SCALAR", indices);
        const Imported result =
            data.import(R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}])");
        EXPECT_TRUE(result.ok()) << result.message();
        return corners(result.mesh());
    };
    const std::vector<Float3> expected{{1, 1, 0}, {0, 1, 0}, {0, 0, 0}};
    EXPECT_EQ(read(std::vector<uint8_t>{2, 3, 0}), expected);
    EXPECT_EQ(read(std::vector<uint16_t>{2, 3, 0}), expected);
    EXPECT_EQ(read(std::vector<uint32_t>{2, 3, 0}), expected);
}

TEST(GltfPrimitives, shareVerticesAndKeepTheirMaterials)
{
    GltfData data;
    data.add("VEC3", kSquare);
    data.add("VEC3", std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
    data.add("SCALAR", std::vector<uint16_t>{0, 1, 2});
    data.add("SCALAR", std::vector<uint16_t>{0, 2, 3});
    const Imported result = data.import(R"("materials":[{},{}],"meshes":[{"primitives":[
        {"attributes":{"POSITION":0,"NORMAL":1},"indices":2,"material":1},
        {"attributes":{"POSITION":0,"NORMAL":1},"indices":3}]}])");
    ASSERT_TRUE(result.ok()) << result.message();
    const mesh::SourceMesh mesh = result.mesh();
    EXPECT_EQ(mesh.vertexCount(), 4u);
    EXPECT_EQ(mesh.source_vertex_count, 4u);
    EXPECT_EQ(mesh.face_count, 2u);
    EXPECT_EQ(mesh.triangle_materials, (std::vector<uint32_t>{1, kInvalidIndex}));
}

TEST(GltfPrimitives, fillAttributesThatOnlySomeHave)
{
    GltfData data;
    data.add("VEC3", kSquare);
    data.add("VEC3", kSquare);
    data.add("VEC2", std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8});
    data.add("VEC4", std::vector<float>(16, 0.5f));
    data.add("SCALAR", kSquareIndices);
    const Imported result = data.import(R"("meshes":[{"primitives":[
        {"attributes":{"POSITION":0,"TEXCOORD_0":2},"indices":4},
        {"attributes":{"POSITION":1,"COLOR_0":3},"indices":4}]}])");
    ASSERT_TRUE(result.ok()) << result.message();
    const mesh::SourceMesh mesh = result.mesh();
    ASSERT_EQ(mesh.vertexCount(), 8u);
    EXPECT_EQ(mesh.uvs[0][1], (Float2{3, 4}));
    EXPECT_EQ(mesh.uvs[0][5], (Float2{0, 0}));
    EXPECT_EQ(mesh.colors[1], (Float4{1, 1, 1, 1}));
    EXPECT_EQ(mesh.colors[5], (Float4{0.5f, 0.5f, 0.5f, 0.5f}));
    EXPECT_EQ(result.counts.vertices, 8u);
}

TEST(GltfPrimitives, getFlatNormalsWhereTheyAreMissing)
{
    // a roof: two squares that share the edge x = 0
    GltfData data;
    data.add("VEC3", std::vector<float>{-1, 0, 0, 0, 1, 0, 0, 1, 1, -1, 0, 1, 1, 0, 0, 1, 0, 1});
    data.add("SCALAR", std::vector<uint16_t>{0, 3, 2, 0, 2, 1, 1, 2, 5, 1, 5, 4});
    const Imported result =
        data.import(R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}])");
    ASSERT_TRUE(result.ok()) << result.message();
    const mesh::SourceMesh mesh = result.mesh();
    EXPECT_EQ(mesh.vertexCount(), 8u) << "the two vertices of the ridge are split, the others are not";
    EXPECT_EQ(mesh.source_vertex_count, 6u);
    const float s = std::sqrt(0.5f);
    for (size_t i = 0; i < mesh.indices.size(); ++i)
    {
        const Float3 normal = mesh.normals[mesh.indices[i]];
        EXPECT_NEAR(normal.x, i < 6 ? -s : s, 1e-6);
        EXPECT_NEAR(normal.y, s, 1e-6);
    }
}

TEST(GltfPrimitives, mendNormalsWithoutDirection)
{
    GltfData data;
    data.add("VEC3", kSquare);
    data.add("VEC3", std::vector<float>{0, 0, 0, 0, 0, 2, std::nanf(""), 0, 1, 0, 0, 1});
    data.add("SCALAR", kSquareIndices);
    const Imported result =
        data.import(R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":1},"indices":2}]}])");
    ASSERT_TRUE(result.ok()) << result.message();
    for (const Float3 normal : result.mesh().normals)
        EXPECT_EQ(normal, (Float3{0, 0, 1}));
    EXPECT_TRUE(result.hasWarning(Issue::repaired, "normals"));
}

/// Return the square with normals and UVs, with or without tangents, and a material with or without a normal
/// texture.
Imported importTangents(bool source_has_tangents, bool material_has_normal_texture)
{
    GltfData data;
    data.add("VEC3", kSquare);
    data.add("VEC3", std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
    data.add("VEC2", std::vector<float>{0, 1, 1, 1, 1, 0, 0, 0});
    data.add("SCALAR", kSquareIndices);
    data.add("VEC4", std::vector<float>{0, 2, 0, -1, 0, 2, 0, -1, 0, 2, 0, -1, 0, 2, 0, -1});
    return data.import(
        std::string(R"("textures":[{}],"materials":[{)") +
        (material_has_normal_texture ? R"("normalTexture":{"index":0})" : "") +
        R"(}],"meshes":[{"primitives":[{"material":0,"indices":3,"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2)" +
        (source_has_tangents ? R"(,"TANGENT":4)" : "") + "}}]}]");
}

TEST(GltfPrimitives, keepTangentsThatANormalTextureUses)
{
    const Imported result = importTangents(true, true);
    ASSERT_TRUE(result.ok()) << result.message();
    EXPECT_EQ(result.mesh().tangents, std::vector<Float4>(4, {0, 1, 0, -1}));
}

TEST(GltfPrimitives, makeTangentsThatANormalTextureNeeds)
{
    const Imported result = importTangents(false, true);
    ASSERT_TRUE(result.ok()) << result.message();
    ASSERT_EQ(result.mesh().tangents.size(), 4u);
    for (const Float4 tangent : result.mesh().tangents)
    {
        EXPECT_NEAR(tangent.x, 1, 1e-6);
        EXPECT_EQ(tangent.w, 1) << "v runs down the image, as the image on the square does";
    }
}

TEST(GltfPrimitives, haveNoTangentsThatNothingUses)
{
    EXPECT_TRUE(importTangents(false, false).mesh().tangents.empty());
    const Imported dropped = importTangents(true, false);
    EXPECT_TRUE(dropped.mesh().tangents.empty());
    EXPECT_TRUE(dropped.hasWarning(Issue::dropped, "TANGENT"));
}

TEST(GltfPrimitives, nameTheAttributesThatAreLeftOut)
{
    GltfData data;
    data.add("VEC3", kSquare);
    data.add("VEC2", std::vector<float>(8));
    data.add("SCALAR", kSquareIndices);
    const Imported result =
        data.import(R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1,
        "TEXCOORD_1":1,"TEXCOORD_2":1,"TEXCOORD_3":1,"TEXCOORD_4":1,"_WIND":1,"COLOR_1":0},"indices":2}]}])");
    ASSERT_TRUE(result.ok()) << result.message();
    EXPECT_EQ(result.mesh().uvs[3].size(), 4u);
    for (const char* name : {"attribute TEXCOORD_4", "attribute _WIND", "attribute COLOR_1"})
        EXPECT_TRUE(result.hasWarning(Issue::dropped, name)) << name;
    EXPECT_FALSE(result.hasWarning(Issue::dropped, "TEXCOORD_3"));
    EXPECT_NE(
        result.text(formats::kChunkMeta)
            .find(
                R"("dropped":["attribute COLOR_1 is not kept","attribute TEXCOORD_4 is not kept","attribute _WIND is not kept"])"),
        std::string::npos)
        << result.text(formats::kChunkMeta);
}

TEST(GltfPrimitives, nameOneWithoutPositions)
{
    GltfData data;
    data.add("VEC2", std::vector<float>(8));
    const Imported result = data.import(R"("meshes":[{"primitives":[{"attributes":{"TEXCOORD_0":0}}]}])");
    ASSERT_TRUE(result.ok()) << result.message();
    EXPECT_TRUE(result.hasWarning(Issue::dropped, "without POSITION"));
    EXPECT_EQ(result.mesh().triangleCount(), 0u);
}

TEST(GltfPrimitives, normalizeJointWeights)
{
    GltfData data;
    data.add("VEC3", kSquare);
    data.add("VEC4", std::vector<uint8_t>{1, 2, 3, 4, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    data.add("VEC4", std::vector<float>{1, 1, 2, 0, 0, 0, 0, 0, -1, std::nanf(""), 0.5f, 0, 1, 0, 0, 0});
    data.add("SCALAR", kSquareIndices);
    const Imported result = data.import(
        R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2},"indices":3}]}],
        "skins":[{"joints":[1,2,3,4]}],"nodes":[{"mesh":0,"skin":0},{},{},{},{}])");
    ASSERT_TRUE(result.ok()) << result.message();
    const mesh::SourceMesh mesh = result.mesh();
    ASSERT_EQ(mesh.weight_sets.size(), 1u);
    EXPECT_EQ(mesh.weight_sets[0][0], (Float4{0.25f, 0.25f, 0.5f, 0}));
    EXPECT_EQ(mesh.joint_sets[0][0].joint[2], 3);
    EXPECT_EQ(mesh.joint_sets[0][0].joint[3], 0) << "a joint without weight is joint 0";
    EXPECT_EQ(mesh.weight_sets[0][1], (Float4{1, 0, 0, 0}));
    EXPECT_EQ(mesh.weight_sets[0][2], (Float4{0, 0, 1, 0}));
    EXPECT_TRUE(result.hasWarning(Issue::repaired, "weights"));
}

TEST(GltfMorphTargets, moveNothingYet)
{
    GltfData data;
    data.add("VEC3", kSquare);
    data.add("VEC3", std::vector<float>{0, 0, 2, 0, 0, 2, 0, 0, 2, 0, 0, 2});
    data.add("SCALAR", kSquareIndices);
    const std::string mesh_json =
        R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"targets":[{"POSITION":1},{}],"indices":2}],"weights":[0.5,0]}],)";
    const Imported result = data.import(mesh_json + R"("nodes":[{"mesh":0},{"mesh":0,"weights":[1,0]}])");
    ASSERT_TRUE(result.ok()) << result.message();
    const mesh::SourceMesh mesh = result.mesh();
    ASSERT_EQ(mesh.morph_targets.size(), 2u);
    EXPECT_EQ(mesh.morph_targets[0].positions[0], (Float3{0, 0, 2}));
    EXPECT_EQ(mesh.morph_targets[1].positions, std::vector<Float3>(4)) << "one that moves nothing counts too";
    EXPECT_EQ(mesh.positions[2], (Float3{1, 1, 0}));
    EXPECT_EQ(result.records<float>(formats::kChunkMorphWeights), (std::vector<float>{0.5f, 0, 1, 0}));
    const auto nodes = result.records<formats::NodeRecord>(formats::kChunkNodes);
    EXPECT_EQ(nodes[1].morph_weights.first, 2u);
    EXPECT_EQ(nodes[1].morph_weights.count, 2u);
    EXPECT_EQ(result.counts.morph_targets, 2u);
}

TEST(GltfMorphTargets, areRefusedWhereTheyAreTooMany)
{
    for (const size_t count : {size_t{1024}, size_t{1025}})
    {
        GltfData data;
        data.add("VEC3", kSquare);
        data.add("SCALAR", kSquareIndices);
        std::string targets;
        for (size_t i = 0; i < count; ++i)
            targets += i == 0 ? R"({"POSITION":0})" : R"(,{"POSITION":0})";
        const Imported result =
            data.import(R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"targets":[)" +
                        targets + "]}]}]");
        EXPECT_EQ(result.ok(), count == 1024) << result.message();
        if (!result.ok())
        {
            EXPECT_EQ(result.status.error().issue, Issue::input_too_large);
        }
    }
}

TEST(GltfMorphTargets, ofPrimitivesWithFewerAreFilledWithNoMovement)
{
    GltfData data;
    data.add("VEC3", kSquare);
    data.add("VEC3", std::vector<float>(12, 1.0f));
    data.add("SCALAR", kSquareIndices);
    const Imported result = data.import(R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":2},
        {"attributes":{"POSITION":0},"targets":[{"POSITION":1}],"indices":2}]}])");
    ASSERT_TRUE(result.ok()) << result.message();
    const mesh::SourceMesh mesh = result.mesh();
    ASSERT_EQ(mesh.morph_targets.size(), 1u);
    ASSERT_EQ(mesh.morph_targets[0].positions.size(), 8u);
    EXPECT_EQ(mesh.morph_targets[0].positions[3], (Float3{0, 0, 0}));
    EXPECT_EQ(mesh.morph_targets[0].positions[7], (Float3{1, 1, 1}));
}

} // namespace

} // namespace hearth::import::test

// UVs for baked light that import makes for meshes without usable ones.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/pipelines/gltf_fixture.h"

#include <algorithm>

namespace hearth::import::test
{

namespace
{

/// Two squares that share an edge at a right angle.
const std::vector<float> kCorner{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1};
const std::vector<uint16_t> kCornerIndices{0, 1, 2, 0, 2, 3, 0, 4, 5, 0, 5, 1};

/// UVs of the corner's six vertices: both squares have the whole texture, or a half each.
const std::vector<float> kSharedUvs{0, 1, 1, 1, 1, 0, 0, 0, 0, 0, 1, 0};
const std::vector<float> kOwnUvs{0, 0.5f, 1, 0.5f, 1, 0, 0, 0, 0, 1, 1, 1};

/// Import the corner with texels of an eighth of a metre.
/// attributes  of the primitive, behind its positions
/// node        members of the only node, behind its mesh
Imported importCorner(const std::vector<float>& uvs, const std::string& attributes = "",
                      const std::string& node = "", double texel_size = 0.125)
{
    GltfData data;
    data.add("VEC3", kCorner);
    data.add("SCALAR", kCornerIndices);
    if (!uvs.empty())
        data.add("VEC2", uvs);
    ImportOptions options;
    options.receiver_texel_size = texel_size;
    return data.import(R"("scenes":[{"nodes":[0]}],"scene":0,"nodes":[{"mesh":0)" + node +
                           R"(}],"meshes":[{"primitives":[{"indices":1,"attributes":{"POSITION":0)" +
                           std::string(uvs.empty() ? "" : R"(,"TEXCOORD_0":2)") + attributes + "}}]}]",
                       nullptr, options);
}

/// Return the largest extent of a set of UVs along u, of the triangles of one of the squares.
float measureWidth(const mesh::SourceMesh& mesh, size_t set)
{
    float low = 1, high = 0;
    for (size_t i = 0; i < 6; ++i)
    {
        low = std::min(low, mesh.uvs[set][mesh.indices[i]].x);
        high = std::max(high, mesh.uvs[set][mesh.indices[i]].x);
    }
    return high - low;
}

TEST(GltfReceiverUvs, areMadeInTheFirstFreeSet)
{
    for (const bool has_uvs : {false, true})
    {
        const Imported result = importCorner(has_uvs ? kSharedUvs : std::vector<float>{});
        ASSERT_TRUE(result.ok()) << result.message();
        const mesh::SourceMesh mesh = result.mesh();
        const size_t set = has_uvs ? 1 : 0;
        ASSERT_EQ(mesh.uvs[set].size(), mesh.vertexCount());
        EXPECT_TRUE(mesh.uvs[set + 1].empty());
        ASSERT_EQ(mesh.triangleCount(), 4u);
        for (size_t i = 0; i < 12; ++i)
        {
            const size_t vertex = kCornerIndices[i];
            EXPECT_EQ(mesh.positions[mesh.indices[i]],
                      (Float3{kCorner[3 * vertex], kCorner[3 * vertex + 1], kCorner[3 * vertex + 2]}));
            if (has_uvs)
                EXPECT_EQ(mesh.uvs[0][mesh.indices[i]],
                          (Float2{kSharedUvs[2 * vertex], kSharedUvs[2 * vertex + 1]}));
        }
    }
}

TEST(GltfReceiverUvs, leaveUsableOnesAlone)
{
    const Imported result = importCorner(kOwnUvs);
    ASSERT_TRUE(result.ok()) << result.message();
    EXPECT_TRUE(result.mesh().uvs[1].empty());
}

TEST(GltfReceiverUvs, areNotMadeUnlessAskedFor)
{
    const Imported result = importCorner({}, "", "", 0);
    ASSERT_TRUE(result.ok()) << result.message();
    EXPECT_TRUE(result.mesh().uvs[0].empty());
}

TEST(GltfReceiverUvs, haveTexelsOfTheSizeInTheScene)
{
    const auto width = [](const std::string& node, double texel_size)
    { return measureWidth(importCorner({}, "", node, texel_size).mesh(), 0); };
    EXPECT_EQ(width(R"(,"scale":[0.5,0.5,0.5])", 0.125), width("", 0.25));
    EXPECT_NE(width("", 0.125), width("", 0.25));
}

} // namespace

} // namespace hearth::import::test

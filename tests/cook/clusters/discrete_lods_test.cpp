// Recounts the chain of discrete LODs that the hierarchy is compared with, by a slow and obvious method.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/levels/validate.h"
#include "cook/clusters/program/discrete_lods.h"
#include "formats/pack/pack_view.h"
#include "tests/support/cuts.h"
#include "tests/support/sanitized.h"
#include "tests/support/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace
{

using namespace hearth;
using clusters::DiscreteLods;
using clusters::Hierarchy;

/// Distinct vertices and triangles of a cut, by their decoded values.
clusters::DiscreteLod countCut(const Hierarchy& hierarchy, const std::vector<uint8_t>& replaced)
{
    const auto decoded = clusters::decodeHierarchy(hierarchy);
    EXPECT_TRUE(decoded.ok());
    std::set<std::array<float, 8>> vertices;
    clusters::DiscreteLod lod;
    for (const uint32_t c : clusters::findCutClusters(hierarchy, replaced))
    {
        const formats::ClusterRecord& cluster = hierarchy.clusters[c];
        const auto geometry =
            formats::ClusterGeometry::at(decoded->pages[cluster.page], cluster, hierarchy.mesh);
        lod.triangles += geometry->triangleCount();
        for (uint32_t v = 0; v < geometry->vertexCount(); ++v)
        {
            const Float3 p = geometry->position(v), n = geometry->normal(v);
            const Float2 uv = geometry->uv(v, 0);
            vertices.insert({p.x, p.y, p.z, n.x, n.y, n.z, uv.x, uv.y});
        }
    }
    lod.vertices = vertices.size();
    return lod;
}

uint64_t computeBytes(const clusters::DiscreteLod& lod, uint64_t vertex_bytes)
{
    return lod.vertices * vertex_bytes + lod.triangles * 3 * (lod.vertices <= 65536 ? 2 : 4);
}

TEST(DiscreteLods, takeTheInfluencesOfVertices)
{
    mesh::SourceMesh mesh = shapes::grid(4);
    mesh.joint_sets.assign(2, std::vector<mesh::Joints4>(mesh.vertexCount(), {{0, 1, 2, 3}}));
    mesh.weight_sets.assign(2, std::vector<Float4>(mesh.vertexCount(), {0.125f, 0.125f, 0.125f, 0.125f}));
    // a joint that occurs twice becomes one of the four influences
    const DiscreteLods four = clusters::measureDiscreteLods(clusters::buildHierarchy(mesh));
    ASSERT_EQ(four.lods.size(), 1u);
    EXPECT_EQ(four.bytes, 25u * (8 + 4 + 16) + 32 * 3 * 2);
    mesh.joint_sets[1].assign(mesh.vertexCount(), {{4, 5, 6, 7}});
    const DiscreteLods eight = clusters::measureDiscreteLods(clusters::buildHierarchy(mesh));
    EXPECT_EQ(eight.bytes, 25u * (8 + 4 + 32) + 32 * 3 * 2);
}

TEST(DiscreteLods, ofOneClusterAreThatCluster)
{
    // 25 vertices: a position and a normal of 8 bytes, a UV of 4
    const Hierarchy hierarchy = clusters::buildHierarchy(shapes::grid(4));
    ASSERT_EQ(hierarchy.clusters.size(), 1u);
    const DiscreteLods chain = clusters::measureDiscreteLods(hierarchy);
    ASSERT_EQ(chain.lods.size(), 1u);
    EXPECT_EQ(chain.lods[0].triangles, 32u);
    EXPECT_EQ(chain.lods[0].vertices, 25u);
    EXPECT_EQ(chain.bytes, 25u * 12 + 32 * 3 * 2);
    EXPECT_LT(chain.bytes_zstd, chain.bytes);
}

TEST(DiscreteLods, areCutsOfTheHierarchy)
{
    const uint32_t side = test::kSanitized ? 20 : 40;
    for (const uint32_t normal_bits : {8u, 16u})
    {
        clusters::Config config;
        config.normal_bits = normal_bits;
        const Hierarchy hierarchy = clusters::buildHierarchy(shapes::rock(side, 0.3f), config);
        const DiscreteLods chain = clusters::measureDiscreteLods(hierarchy);
        ASSERT_EQ(chain.lods.size(), clusters::kDiscreteLodCount);

        std::vector<float> errors;
        for (const formats::GroupRecord& group : hierarchy.groups)
            if (std::isfinite(group.error))
                errors.push_back(group.error);
        std::sort(errors.begin(), errors.end());
        const uint64_t vertex_bytes = normal_bits == 8 ? 12 : 16;
        clusters::DiscreteLod expected =
            countCut(hierarchy, std::vector<uint8_t>(hierarchy.groups.size(), 0));
        const uint64_t source = expected.triangles;
        EXPECT_EQ(source, 12u * side * side);
        uint64_t bytes = 0;
        for (uint32_t lod = 0; lod < chain.lods.size(); ++lod)
        {
            for (size_t i = 0; expected.triangles > source >> lod; ++i)
                expected = countCut(hierarchy, cuts::cutAtError(hierarchy, double{errors.at(i)}));
            EXPECT_EQ(chain.lods[lod].triangles, expected.triangles) << "lod " << lod;
            EXPECT_EQ(chain.lods[lod].vertices, expected.vertices) << "lod " << lod;
            EXPECT_GT(expected.triangles, (source >> lod) * 2 / 3) << "lod " << lod;
            bytes += computeBytes(expected, vertex_bytes);
        }
        EXPECT_EQ(chain.bytes, bytes);
        EXPECT_LT(chain.bytes_zstd, bytes);
        EXPECT_GT(chain.bytes_zstd, bytes / 4);
    }
}

TEST(DiscreteLods, haveIndicesOf32BitsWhereTheyNeedThem)
{
    const Hierarchy hierarchy = clusters::buildHierarchy(shapes::grid(260));
    const DiscreteLods chain = clusters::measureDiscreteLods(hierarchy);
    EXPECT_EQ(chain.lods[0].vertices, 261u * 261);
    uint64_t bytes = 0;
    for (const clusters::DiscreteLod& lod : chain.lods)
        bytes += computeBytes(lod, 12);
    EXPECT_EQ(chain.bytes, bytes);
    EXPECT_GT(chain.lods[0].vertices, 65536u);
    EXPECT_LT(chain.lods[1].vertices, 65536u);
}

TEST(DiscreteLods, ofNothingAreNothing)
{
    const DiscreteLods chain = clusters::measureDiscreteLods(Hierarchy{});
    EXPECT_TRUE(chain.lods.empty());
    EXPECT_EQ(chain.bytes, 0u);
}

} // namespace

// Tests authored LODs: the whole mesh switches to them at once, and their stored error is a bound.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/core/hierarchy.h"
#include "cook/clusters/levels/validate.h"
#include "formats/base/index.h"
#include "formats/codecs/vertex_codec.h"
#include "tests/support/cuts.h"
#include "tests/support/sanitized.h"
#include "tests/support/shapes.h"
#include "tests/support/soundness.h"
#include "tests/support/surfaces/surface_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

#include <tbb/global_control.h>

namespace
{

using namespace hearth;
using clusters::Hierarchy;
using mesh::SourceMesh;

Hierarchy build(const SourceMesh& source, const std::vector<SourceMesh>& authored,
                const clusters::Config& config = {})
{
    Hierarchy hierarchy = clusters::buildHierarchy(source, authored, config);
    EXPECT_EQ(cuts::unsoundness(source, hierarchy, authored), "");
    return hierarchy;
}

/// Return the mesh that a level is made from: the source (0) or the n-th authored mesh in use.
uint32_t findEra(const Hierarchy& hierarchy, uint32_t level)
{
    uint32_t era = 0;
    for (const uint32_t authored : hierarchy.authored_levels)
        era += authored != kInvalidIndex && authored <= level ? 1 : 0;
    return era;
}

/// Rock of 19200 triangles (half as many under a sanitizer) and three authored LODs with their own materials.
struct Rock
{
    SourceMesh source = shapes::rock(test::kSanitized ? 28 : 40, 0.3f);
    std::vector<SourceMesh> levels{shapes::rock(test::kSanitized ? 14 : 20, 0.3f), shapes::rock(9, 0.28f),
                                   shapes::rock(3, 0.2f)};

    Rock()
    {
        for (uint32_t i = 0; i < levels.size(); ++i)
            levels[i].triangle_materials.assign(levels[i].triangleCount(), 10 + i);
    }
};

double computeVolume(const clusters::DecodedHierarchy& decoded, const std::vector<uint32_t>& triangles)
{
    double volume = 0;
    for (size_t t = 0; t < triangles.size(); t += 3)
        volume += double{dot(decoded.positions[triangles[t]], cross(decoded.positions[triangles[t + 1]],
                                                                    decoded.positions[triangles[t + 2]]))} /
                  6;
    return volume;
}

TEST(AuthoredLevels, takeTheirPlacesAmongTheGenerated)
{
    const Rock rock;
    const Hierarchy hierarchy = build(rock.source, rock.levels);
    ASSERT_EQ(hierarchy.authored_levels.size(), 3u);
    for (size_t i = 0; i < 3; ++i)
    {
        const uint32_t l = hierarchy.authored_levels[i];
        ASSERT_LT(l, hierarchy.levels.size());
        EXPECT_EQ(hierarchy.levels[l].triangle_count, rock.levels[i].triangleCount());
        EXPECT_GT(hierarchy.levels[l - 1].triangle_count, hierarchy.levels[l].triangle_count);
    }
    EXPECT_EQ(hierarchy.authored_levels[0], 2u) << "one level is generated before: 19200, 9600, then 4800";
    for (const auto& cluster : hierarchy.clusters)
    {
        const uint32_t era = findEra(hierarchy, cluster.level);
        EXPECT_EQ(cluster.material, era == 0 ? 0 : 9 + era) << "the materials of a level stay";
    }
    EXPECT_EQ(hierarchy.levels.back().clusters.count, 1u);
    EXPECT_EQ(hierarchy.counts.stuck_groups, 0u);
}

TEST(AuthoredLevels, areDrawnAloneAtEveryThreshold)
{
    const Rock rock;
    const Hierarchy hierarchy = build(rock.source, rock.levels);
    std::set<double> thresholds{0};
    for (const auto& group : hierarchy.groups)
        if (std::isfinite(group.error))
            thresholds.insert({double{group.error}, std::nextafter(group.error, 0.0f)});
    std::set<uint32_t> eras;
    std::mt19937 random(11);
    std::vector<std::vector<uint8_t>> all;
    for (const double threshold : thresholds)
        all.push_back(cuts::cutAtError(hierarchy, threshold));
    for (int i = 0; i < 20; ++i)
        all.push_back(cuts::randomCut(hierarchy, 0.99, random));
    for (const auto& replaced : all)
    {
        std::set<uint32_t> of_cut;
        for (const uint32_t c : clusters::findCutClusters(hierarchy, replaced))
            of_cut.insert(findEra(hierarchy, hierarchy.clusters[c].level));
        ASSERT_EQ(of_cut.size(), 1u) << "a cut has clusters of one authored mesh alone";
        eras.insert(*of_cut.begin());
    }
    EXPECT_EQ(eras.size(), 4u) << "and each is drawn at some threshold";
}

TEST(AuthoredLevels, coverTheSurfaceOnceAtEveryThreshold)
{
    const Rock rock;
    const Hierarchy hierarchy = build(rock.source, rock.levels);
    const auto decoded = clusters::decodeHierarchy(hierarchy);
    ASSERT_TRUE(decoded.ok());
    const Boundary boundary = cuts::findSourceBoundary(hierarchy, *decoded);
    ASSERT_TRUE(boundary.loops.empty());
    std::set<double> thresholds;
    for (const auto& group : hierarchy.groups)
        if (std::isfinite(group.error))
            thresholds.insert({double{group.error}, std::nextafter(group.error, 0.0f)});
    const double source_volume =
        computeVolume(*decoded, cuts::trianglesOfCut(hierarchy, *decoded, cuts::cutAtError(hierarchy, 0)));
    for (const double threshold : thresholds)
    {
        const auto triangles =
            cuts::trianglesOfCut(hierarchy, *decoded, cuts::cutAtError(hierarchy, threshold));
        EXPECT_EQ(findCrack(boundary, findBoundary(triangles)), "") << threshold;
        // the ratio would be 2 if the volume were covered twice, and below 1 if a part were missing
        EXPECT_NEAR(computeVolume(*decoded, triangles) / source_volume, 1, 0.45) << threshold;
    }
}

TEST(AuthoredLevels, haveErrorsThatBoundTheDistance)
{
    const Rock rock;
    const Hierarchy hierarchy = build(rock.source, rock.levels);
    const auto decoded = clusters::decodeHierarchy(hierarchy);
    ASSERT_TRUE(decoded.ok());
    const SurfaceDistance to_source(rock.source.positions, rock.source.indices);
    for (uint32_t l = 1; l < hierarchy.levels.size(); ++l)
    {
        const double error = hierarchy.levels[l].max_error;
        const auto cut = cuts::trianglesOfCut(hierarchy, *decoded, cuts::cutAtError(hierarchy, error));
        const SurfaceDistance to_cut(decoded->positions, cut);
        const double distance =
            std::max(largestDistance(rock.source.positions, rock.source.indices, 50000, to_cut),
                     largestDistance(decoded->positions, cut, 50000, to_source));
        EXPECT_LE(distance, error * (1 + 1e-5)) << "level " << l;
        // an authored level's error is its own distance, unless the level below has a larger error
        if (std::count(hierarchy.authored_levels.begin(), hierarchy.authored_levels.end(), l) > 0)
        {
            EXPECT_LE(error, 1.15 * std::max(distance, double{hierarchy.levels[l - 1].max_error}));
        }
    }
}

TEST(AuthoredLevels, thatAreNotCoarserAreLeftOut)
{
    const SourceMesh source = shapes::rock(20, 0.3f);
    const std::vector<SourceMesh> levels{shapes::rock(30, 0.3f), shapes::rock(8, 0.3f), SourceMesh{},
                                         shapes::rock(8, 0.2f), shapes::rock(4, 0.3f)};
    const Hierarchy hierarchy = build(source, levels);
    ASSERT_EQ(hierarchy.authored_levels.size(), 5u);
    for (const size_t i : {0u, 2u, 3u})
        EXPECT_EQ(hierarchy.authored_levels[i], kInvalidIndex) << i;
    EXPECT_LT(hierarchy.authored_levels[1], hierarchy.authored_levels[4]);
    EXPECT_LT(hierarchy.authored_levels[4], hierarchy.levels.size());
}

TEST(AuthoredLevels, replaceASourceThatCannotBeSimplified)
{
    // a ball of triangles that share no vertices, authored by somebody who knows better
    const SourceMesh source = shapes::blocks(24);
    const std::vector<SourceMesh> levels{shapes::rock(4, 0)};
    const Hierarchy hierarchy = build(source, levels);
    EXPECT_NE(hierarchy.authored_levels[0], kInvalidIndex);
    EXPECT_EQ(hierarchy.counts.stuck_groups, 0u) << "nothing of the source is drawn with the ball";
    const std::vector<uint8_t> all = cuts::cutAtError(hierarchy, 1e30);
    for (const uint32_t c : clusters::findCutClusters(hierarchy, all))
        EXPECT_GE(hierarchy.clusters[c].level, hierarchy.authored_levels[0]);
}

TEST(AuthoredLevels, ofOneClusterSwitchAsWell)
{
    const SourceMesh source = shapes::rock(3, 0.1f); // 108 triangles
    const std::vector<SourceMesh> levels{shapes::rock(1, 0)};
    const Hierarchy hierarchy = build(source, levels);
    ASSERT_EQ(hierarchy.levels.size(), 2u);
    EXPECT_EQ(hierarchy.authored_levels[0], 1u);
    EXPECT_EQ(hierarchy.levels[1].triangle_count, 12u);
}

TEST(AuthoredLevels, getTheAttributesOfTheSource)
{
    SourceMesh source = shapes::rock(20, 0.3f);
    source.colors.assign(source.vertexCount(), {0.5f, 0.5f, 0.5f, 1});
    source.tangents.assign(source.vertexCount(), {1, 0, 0, 1});
    SourceMesh level = shapes::rock(5, 0.3f);
    level.uvs[0].clear();
    level.uvs[1].assign(level.vertexCount(), {0.25f, 0.25f});
    const std::vector<SourceMesh> levels{level};
    const Hierarchy hierarchy = build(source, levels);
    EXPECT_EQ(hierarchy.mesh.attributes & formats::kVertexAttributesAll, mesh::attributeBits(source));
    EXPECT_NE(hierarchy.authored_levels[0], kInvalidIndex);
}

TEST(AuthoredLevels, doNotDependOnThreads)
{
    const Rock rock;
    const Hierarchy many = clusters::buildHierarchy(rock.source, rock.levels, {});
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const Hierarchy single = clusters::buildHierarchy(rock.source, rock.levels, {});
    EXPECT_EQ(many.page_bytes, single.page_bytes);
    ASSERT_EQ(many.groups.size(), single.groups.size());
    EXPECT_EQ(std::memcmp(many.groups.data(), single.groups.data(),
                          many.groups.size() * sizeof(formats::GroupRecord)),
              0);
}

TEST(AuthoredLevels, followTheErrorWeight)
{
    const Rock rock;
    clusters::Config config;
    config.reduction.curve = {{.keep = 0.5f, .error_weight = 3}};
    const Hierarchy plain = build(rock.source, rock.levels);
    const Hierarchy weighted = build(rock.source, rock.levels, config);
    const uint32_t last = plain.authored_levels[2];
    ASSERT_EQ(weighted.authored_levels[2], last);
    EXPECT_NEAR(weighted.levels[last].max_error, 3 * plain.levels[last].max_error,
                0.15 * plain.levels[last].max_error);
}

} // namespace

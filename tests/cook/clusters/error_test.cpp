// Tests that a stored error is a bound: no cut is farther from the source than it says, in either direction.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/levels/validate.h"
#include "formats/pack/pack_view.h"
#include "tests/support/cuts.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_distance.h"

#include <gtest/gtest.h>

namespace
{

using namespace hearth;
using clusters::DecodedHierarchy;
using clusters::Hierarchy;

constexpr size_t kSamples = 50000; // per direction

struct Measured
{
    double bound = 0;
    double distance = 0;
};

Measured measure(const mesh::SourceMesh& mesh, const Hierarchy& hierarchy, const DecodedHierarchy& decoded,
                 const std::vector<uint8_t>& replaced)
{
    Measured measured;
    for (const uint32_t c : clusters::findCutClusters(hierarchy, replaced))
        measured.bound =
            std::max(measured.bound, double{formats::clusterError(hierarchy.clusters[c], hierarchy.groups)});
    const auto cut = cuts::trianglesOfCut(hierarchy, decoded, replaced);
    const SurfaceDistance to_source(mesh.positions, mesh.indices);
    const SurfaceDistance to_cut(decoded.positions, cut);
    measured.distance = std::max(largestDistance(mesh.positions, mesh.indices, kSamples, to_cut),
                                 largestDistance(decoded.positions, cut, kSamples, to_source));
    return measured;
}

/// Check all levels and some mixed cuts. Returns the minimum ratio of distance to bound over the levels.
double expectBounded(const mesh::SourceMesh& mesh)
{
    const Hierarchy hierarchy = clusters::buildHierarchy(mesh);
    const auto decoded = clusters::decodeHierarchy(hierarchy);
    EXPECT_TRUE(decoded.ok());
    const double rounding = 1e-6 * length(hierarchy.mesh.box_max - hierarchy.mesh.box_min);
    double least = 1;
    for (size_t l = 1; l < hierarchy.levels.size(); ++l)
    {
        const Measured measured =
            measure(mesh, hierarchy, *decoded, cuts::cutAtError(hierarchy, hierarchy.levels[l].max_error));
        EXPECT_LE(measured.distance, measured.bound + rounding) << "level " << l;
        if (measured.bound > 0)
            least = std::min(least, measured.distance / measured.bound);
    }
    std::mt19937 random(3);
    for (int i = 0; i < 3; ++i)
    {
        const Measured measured = measure(mesh, hierarchy, *decoded, cuts::randomCut(hierarchy, 0.8, random));
        EXPECT_LE(measured.distance, measured.bound + rounding) << "mixed cut " << i;
    }
    return least;
}

TEST(Error, ofASmoothSphereBoundsTheDistance)
{
    EXPECT_GE(expectBounded(shapes::rock(48, 0)), 0.25) << "the bound should not be loose either";
}

TEST(Error, ofARockBoundsTheDistance)
{
    EXPECT_GE(expectBounded(shapes::rock(40, 0.4f)), 0.2);
}

TEST(Error, ofATerrainBoundsTheDistance)
{
    EXPECT_GE(expectBounded(shapes::terrain(80)), 0.15);
}

TEST(Error, ofBlocksBoundsTheDistance)
{
    expectBounded(shapes::blocks(20));
}

TEST(Error, ofLooseQuadsBoundsTheDistance)
{
    expectBounded(shapes::foliage(3000));
}

TEST(Error, ofAMoebiusStripBoundsTheDistance)
{
    expectBounded(shapes::moebius(200, 10));
}

} // namespace

// Tests that a stored error is a bound: no cut is farther from the source than it says, in either direction.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/levels/validate.h"
#include "formats/pack/pack_view.h"
#include "tests/support/cuts.h"
#include "tests/support/shapes.h"
#include "tests/support/surfaces/certified_distance.h"

#include <gtest/gtest.h>

namespace
{

using namespace hearth;
using clusters::DecodedHierarchy;
using clusters::Hierarchy;

struct Measured
{
    double bound = 0;
    DistanceBounds distance;
};

Measured measure(const mesh::SourceMesh& mesh, const Hierarchy& hierarchy, const DecodedHierarchy& decoded,
                 const std::vector<uint8_t>& replaced)
{
    Measured measured;
    for (const uint32_t c : clusters::findCutClusters(hierarchy, replaced))
        measured.bound =
            std::max(measured.bound, double{formats::clusterError(hierarchy.clusters[c], hierarchy.groups)});
    const auto cut = cuts::trianglesOfCut(hierarchy, decoded, replaced);
    const double rounding = 1e-6 * length(hierarchy.mesh.box_max - hierarchy.mesh.box_min);
    measured.distance = certifyDistance({decoded.positions, cut}, {mesh.positions, mesh.indices},
                                        {.relative = 0.1, .absolute = rounding});
    EXPECT_LE(measured.distance.upper, measured.distance.lower * 1.11 + 2 * rounding)
        << "the search ended early";
    EXPECT_LE(measured.distance.lower, measured.bound + rounding);
    return measured;
}

/// Check all levels and some mixed cuts. Returns the minimum ratio of distance to bound over the levels.
double expectBounded(const mesh::SourceMesh& mesh)
{
    const Hierarchy hierarchy = clusters::buildHierarchy(mesh);
    const auto decoded = clusters::decodeHierarchy(hierarchy);
    EXPECT_TRUE(decoded.ok());
    double least = 1;
    for (size_t l = 1; l < hierarchy.levels.size(); ++l)
    {
        SCOPED_TRACE("level " + std::to_string(l));
        const Measured measured =
            measure(mesh, hierarchy, *decoded, cuts::cutAtError(hierarchy, hierarchy.levels[l].max_error));
        if (measured.bound > 0)
            least = std::min(least, measured.distance.lower / measured.bound);
    }
    std::mt19937 random(3);
    for (int i = 0; i < 3; ++i)
    {
        SCOPED_TRACE("mixed cut " + std::to_string(i));
        measure(mesh, hierarchy, *decoded, cuts::randomCut(hierarchy, 0.8, random));
    }
    return least;
}

TEST(Error, ofASmoothSphereBoundsTheDistance)
{
    EXPECT_GE(expectBounded(shapes::rock(24, 0)), 0.35) << "the bound should not be loose either";
}

TEST(Error, ofARockBoundsTheDistance)
{
    EXPECT_GE(expectBounded(shapes::rock(40, 0.4f)), 0.35);
}

TEST(Error, ofATerrainBoundsTheDistance)
{
    EXPECT_GE(expectBounded(shapes::terrain(80)), 0.35);
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

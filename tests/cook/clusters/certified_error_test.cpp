// Tests stored errors against certified distances: no sample can be missed. The search is compared with
// CGAL's.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/cut_errors.h"
#include "tests/support/cuts.h"
#include "tests/support/shapes.h"
#include "tests/support/surfaces/cgal_distance.h"

#include <gtest/gtest.h>

#include <array>

namespace
{

using namespace hearth;

/// Check the cuts of all levels, and add their ratios of stored error to certified distance.
void expectCertified(const mesh::SourceMesh& mesh, std::vector<double>& ratios)
{
    const clusters::Hierarchy hierarchy = clusters::buildHierarchy(mesh);
    const auto decoded = clusters::decodeHierarchy(hierarchy);
    ASSERT_TRUE(decoded.ok());
    const double rounding = 1e-6 * length(hierarchy.mesh.box_max - hierarchy.mesh.box_min);
    for (const cuts::CutError& cut : cuts::certifyLevels(mesh, hierarchy, *decoded, {}))
    {
        EXPECT_LE(cut.distance.upper, cut.distance.lower * 1.03) << "the search ended early";
        EXPECT_LE(cut.distance.lower, cut.stored + rounding) << "level " << cut.level;
        ratios.push_back(cut.stored / cut.distance.lower);
    }
}

TEST(CertifiedError, isAboveTheDistanceAndNear)
{
    // seeds that no other test uses
    std::vector<double> ratios;
    expectCertified(shapes::rock(24, 0.4f, 7001), ratios);
    expectCertified(shapes::rock(20, 0.2f, 7002), ratios);
    expectCertified(shapes::terrain(56, 7003), ratios);
    ASSERT_GT(ratios.size(), 12u);
    std::sort(ratios.begin(), ratios.end());
    EXPECT_LE(ratios[ratios.size() / 2], 1.7) << "stored error / certified distance, median";
}

TEST(CertifiedDistance, isThatOfSurfacesWithKnownDistance)
{
    const std::vector<Float3> low{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::vector<Float3> high{{0, 0, 2}, {1, 0, 2}, {0, 1, 3}};
    const std::vector<uint32_t> triangle{0, 1, 2};
    const DistanceBounds bounds = certifyDistance({low, triangle}, {high, triangle}, {});
    EXPECT_NEAR(bounds.lower, 3, 1e-6);
    EXPECT_LE(bounds.upper, 3 * 1.021);
    // a ridge between two triangles is nearer to the middle of the third than to its corners
    const std::vector<Float3> roof{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 1}};
    const std::vector<uint32_t> pyramid{0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4}, base{0, 1, 2, 0, 2, 3};
    const DistanceBounds apex = certifyDistance({roof, pyramid}, {roof, base}, {});
    EXPECT_NEAR(apex.lower, 1, 1e-6);
    EXPECT_LE(apex.upper, 1.021);
    const DistanceBounds same = certifyDistance({roof, pyramid}, {roof, pyramid}, {.absolute = 1e-6});
    EXPECT_LE(same.upper, 1.1e-6) << "within the rounding of floats";
}

TEST(CertifiedDistance, agreesWithCgal)
{
    const mesh::SourceMesh mesh = shapes::rock(10, 0.4f, 7004);
    const clusters::Hierarchy hierarchy = clusters::buildHierarchy(mesh);
    const auto decoded = clusters::decodeHierarchy(hierarchy);
    ASSERT_TRUE(decoded.ok());
    const auto cut = cuts::trianglesOfCut(
        hierarchy, *decoded, cuts::cutAtError(hierarchy, double{hierarchy.levels.back().max_error}));
    const TriangleSurface source{mesh.positions, mesh.indices}, coarse{decoded->positions, cut};
    const double error = 1e-3 * length(hierarchy.mesh.box_max - hierarchy.mesh.box_min);
    const SurfaceDistance to_source(mesh.positions, mesh.indices), to_cut(decoded->positions, cut);
    const DistanceBounds out = certifyOneSided(coarse.positions, coarse.triangles, to_source, {});
    const DistanceBounds back = certifyOneSided(source.positions, source.triangles, to_cut, {});
    for (const auto& [bounds, of_cgal] : {std::pair(out, cgalDistance(coarse, source, error)),
                                          std::pair(back, cgalDistance(source, coarse, error))})
    {
        EXPECT_LE(of_cgal, bounds.upper + error);
        EXPECT_GE(of_cgal, bounds.lower - error);
        EXPECT_GT(bounds.lower, 5 * error) << "or the comparison says nothing";
    }
}

} // namespace

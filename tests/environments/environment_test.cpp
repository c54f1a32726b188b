// Tests directions and solid angles of the texels of environments.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/environment/environment.h"

#include <gtest/gtest.h>

#include <numbers>

namespace hearth::environment
{

namespace
{

void expectDirection(Double3 got, Double3 expected, const char* what)
{
    EXPECT_LT(length(got - expected * (1 / length(expected))), 1e-12) << what;
}

/// Solid angle of a texel as the surface element of the unit sphere, by 64 x 64 midpoints of central
/// differences.
double sumSolidAngle(Layout layout, uint32_t panel, const PanelArea& area)
{
    constexpr int kSteps = 64;
    constexpr double kDelta = 1e-5;
    const double du = (area.u1 - area.u0) / kSteps, dv = (area.v1 - area.v0) / kSteps;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i)
        for (int k = 0; k < kSteps; ++k)
        {
            const double u = area.u0 + (i + 0.5) * du, v = area.v0 + (k + 0.5) * dv;
            const auto at = [&](double a, double b) { return panelDirection(layout, panel, {a, b}); };
            const Double3 along_u = (at(u + kDelta, v) - at(u - kDelta, v)) * (0.5 / kDelta);
            const Double3 along_v = (at(u, v + kDelta) - at(u, v - kDelta)) * (0.5 / kDelta);
            sum += length(cross(along_u, along_v)) * du * dv;
        }
    return sum;
}

} // namespace

TEST(PanelDirection, ofLatLongIsThatOfOpenExrAndUsd)
{
    const auto at = [](double u, double v) { return panelDirection(Layout::lat_long, 0, {u, v}); };
    expectDirection(at(0.5, 0.5), {0, 0, 1}, "middle");
    expectDirection(at(0.25, 0.5), {1, 0, 0}, "a quarter from the left");
    expectDirection(at(0.75, 0.5), {-1, 0, 0}, "a quarter from the right");
    expectDirection(at(0, 0.5), {0, 0, -1}, "left edge");
    expectDirection(at(1, 0.5), {0, 0, -1}, "right edge");
    expectDirection(at(0.3, 0), {0, 1, 0}, "top");
    expectDirection(at(0.3, 1), {0, -1, 0}, "bottom");
    expectDirection(at(0.5, 0.25), {0, 1, 1}, "halfway up");
}

TEST(PanelDirection, showsLatLongFromInside)
{
    // Facing the middle with the head up, right is forward x up.
    const Double3 forward = panelDirection(Layout::lat_long, 0, {0.5, 0.5});
    const Double3 right = cross(forward, {0, 1, 0});
    EXPECT_GT(dot(right, panelDirection(Layout::lat_long, 0, {0.51, 0.5})), 0);
}

TEST(PanelDirection, ofCubesIsThatOfVulkan)
{
    // Rows of the table of Vulkan 1.3, "Cube Map Face Selection": the directions of s, t and the face.
    constexpr Double3 kFaces[6][3] = {
        {{0, 0, -1}, {0, -1, 0}, {1, 0, 0}}, {{0, 0, 1}, {0, -1, 0}, {-1, 0, 0}},
        {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}},   {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
        {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}},  {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
    };
    for (uint32_t face = 0; face < 6; ++face)
        for (const double s : {-0.8, 0.0, 0.3})
            for (const double t : {-0.5, 0.0, 0.9})
            {
                const Double3 expected = kFaces[face][0] * s + kFaces[face][1] * t + kFaces[face][2];
                expectDirection(panelDirection(Layout::cube, face, {(s + 1) / 2, (t + 1) / 2}), expected,
                                "face");
                const CubePlace place = findCubePlace(expected);
                EXPECT_EQ(place.panel, face);
                EXPECT_NEAR(place.point.u, (s + 1) / 2, 1e-12);
                EXPECT_NEAR(place.point.v, (t + 1) / 2, 1e-12);
            }
}

TEST(FindTexel, undoesPanelDirection)
{
    for (const Layout layout : {Layout::lat_long, Layout::cube})
    {
        const Environment small{layout, layout == Layout::cube ? 5u : 10u, 5, {}};
        for (uint32_t panel = 0; panel < small.panelCount(); ++panel)
            for (uint32_t y = 0; y < small.height; ++y)
                for (uint32_t x = 0; x < small.width; ++x)
                    for (const double part : {0.01, 0.5, 0.99})
                    {
                        const PanelArea area = small.area(x, y);
                        const PanelPoint point{area.u0 + part * (area.u1 - area.u0),
                                               area.v0 + part * (area.v1 - area.v0)};
                        EXPECT_EQ(findTexel(small, panelDirection(layout, panel, point) * 3),
                                  small.index(panel, x, y));
                    }
    }
}

TEST(PanelSolidAngle, isThatOfTheSphere)
{
    for (const Layout layout : {Layout::lat_long, Layout::cube})
    {
        const Environment small{layout, 6, 6, {}};
        double total = 0;
        for (uint32_t y = 0; y < small.height; ++y)
            for (uint32_t x = 0; x < small.width; ++x)
            {
                const double solid_angle = panelSolidAngle(layout, small.area(x, y));
                total += solid_angle * small.panelCount();
                EXPECT_NEAR(solid_angle, sumSolidAngle(layout, 0, small.area(x, y)), 2e-5) << x << ' ' << y;
            }
        EXPECT_NEAR(total, 4 * std::numbers::pi, 1e-12);
    }
}

} // namespace hearth::environment

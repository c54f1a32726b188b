// Tests the depth bias of shadow casters: slopes against finite differences, and the comparison with a shadow
// map simulated texel by texel on planes. No surface may shadow itself (shadow acne), and no shadow may
// detach from its caster (peter panning) by more than the filter's width.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/frame/shadow_fit.h"

#include "tests/runtime/frame/shadow_cases.h"

#include <cmath>
#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

using namespace shared;

/// A light, a map of it, and a point in the middle of the map.
struct Case
{
    ShadowLight light;
    ShadowMap map;
    Float3 point; ///< relative to the light's origin
};

Case randomSun(std::mt19937& random, ShadowMapSize size)
{
    Case c{};
    c.light = makeSunShadow(randomUnit(random), {{-40, -10, -40}, {40, 30, 40}});
    const Sphere sphere{c.light.origin + randomUnit(random) * 8, between(random, 1, 20)};
    c.map = fitSunMap(c.light, sphere, size);
    c.point = sphere.center + randomUnit(random) * (0.5f * sphere.radius) - c.light.origin;
    return c;
}

Case randomSpot(std::mt19937& random, ShadowMapSize size)
{
    Case c{};
    c.light = makeSpotShadow(randomUnit(random) * 10, randomUnit(random), 0.1f);
    const float radius = between(random, 0.3f, 2);
    const Sphere sphere{c.light.origin + tilted(c.light.direction, 0.5, random) * between(random, 3, 9),
                        radius};
    c.map = *fitSpotMap(c.light, 1.2f, sphere, size);
    c.point = sphere.center + randomUnit(random) * (0.5f * radius) - c.light.origin;
    return c;
}

float slopeAt(const Case& c, Float3 point, Float3 normal, float nearest)
{
    return shadowSlope(c.light, c.map, normal, shadowFacing(c.light, point, normal, nearest));
}

/// Ray of light through a point.
Float3 rayTo(const Case& c)
{
    return c.light.perspective == 0 ? c.light.direction : c.point / length(c.point);
}

double computeDepth(const ShadowLight& light, Double3 point)
{
    const double z = dot(widen(light.direction), point);
    return (z * double{light.depth_scale} + double{light.depth_offset}) / (light.perspective == 0 ? 1 : z);
}

/// |du| + |dv| by differences over a texel to each side.
double slopeByDifferences(const Case& c, const Plane& plane)
{
    const Float2 at = shadowTexel(c.map, shadowPoint(c.light, c.point));
    const auto depthAt = [&](double x, double y)
    { return computeDepth(c.light, plane.meet(rayThrough(c.light, c.map, x, y))); };
    const double x = double{at.x};
    const double y = double{at.y};
    return std::abs(depthAt(x + 0.5, y) - depthAt(x - 0.5, y)) +
           std::abs(depthAt(x, y + 0.5) - depthAt(x, y - 0.5));
}

void expectSlopes(Case (*makeCase)(std::mt19937&, ShadowMapSize))
{
    std::mt19937 random(1);
    for (int run = 0; run < 2000; ++run)
    {
        const Case c = makeCase(random, {.texels = 1024, .kernel = 1});
        const double angle = double{between(random, 1, 85)} * kDegree;
        const Float3 normal = tilted(rayTo(c), angle, random);
        const double expected = slopeByDifferences(c, {widen(c.point), widen(normal)});
        // Floats lose precision by cancellation: between normal and axes on planes across the light, and
        // between normal and ray on planes along it.
        const double distance = c.light.perspective == 0 ? 1 : length(widen(c.point));
        const double flat = double{c.light.depth_step} / (double{c.map.density} * distance);
        EXPECT_NEAR(double{slopeAt(c, c.point, normal, 0)}, expected,
                    std::max(expected, flat) * 1e-6 / std::cos(angle));
    }
}

TEST(ShadowSlope, ofASunIsThatOfFiniteDifferences)
{
    expectSlopes(randomSun);
}

TEST(ShadowSlope, ofASpotIsThatOfFiniteDifferences)
{
    expectSlopes(randomSpot);
}

TEST(ShadowSlope, isTheSameFromBothSides)
{
    std::mt19937 random(2);
    for (int run = 0; run < 100; ++run)
    {
        const Case c = randomSpot(random, {});
        const Float3 normal = randomUnit(random);
        EXPECT_EQ(slopeAt(c, c.point, normal, 0), slopeAt(c, c.point, -normal, 0));
    }
}

TEST(ShadowSlope, isBoundedAtGrazingAngles)
{
    std::mt19937 random(3);
    for (int run = 0; run < 100; ++run)
    {
        const Case c = randomSun(random, {});
        const float slope = slopeAt(c, c.point, tilted(c.light.direction, 90 * kDegree, random), 0);
        EXPECT_LE(slope, 1.4143f * c.light.depth_step / (c.map.density * kGrazingCosine));
        EXPECT_TRUE(std::isfinite(slopeAt(c, c.point, {0, 0, 0}, 0)));
    }
}

/// All vertices of a triangle are moved by the same amount: otherwise the triangle would be tilted.
TEST(ShadowSlope, ofASpotIsTheSameAllOverAPlane)
{
    std::mt19937 random(6);
    for (int run = 0; run < 200; ++run)
    {
        const Case c = randomSpot(random, {});
        // so near the light that its far part is seen from the side
        const Double3 normal = widen(randomUnit(random));
        const Double3 foot = normal * 0.05;
        const Double3 aside = unit(cross(normal, widen(randomUnit(random))));
        const float near = slopeAt(c, narrow(foot), narrow(normal), 0.05f);
        const float far = slopeAt(c, narrow(foot + aside * 40.0), narrow(normal), 0.05f);
        EXPECT_NEAR(far, near, near * 1e-3f);
        EXPECT_LE(slopeAt(c, narrow(foot), narrow(normal), 40), near * 0.2f);
    }
}

/// Depth in the map at the centre of a texel of a plane; 0 if the plane is not there.
float storedDepth(const Case& c, const Plane& plane, Float3 normal, double texel_x, double texel_y)
{
    const LightRay ray = rayThrough(c.light, c.map, std::floor(texel_x) + 0.5, std::floor(texel_y) + 0.5);
    const Double3 point = plane.meet(ray);
    if (c.light.perspective != 0 && dot(point, widen(c.light.direction)) <= 0)
        return 0;
    const Float4 clip = shadowCasterClip(c.light, c.map, narrow(point), normal, 0, 0, 1);
    return clip.z / clip.w;
}

/// Return a depth as the map stores it: rounded up to a step, the worse of its neighbours.
float roundDepth(const Case& c, float depth)
{
    const double step = double{c.light.depth_quantum};
    return step == 0 ? depth : static_cast<float>(std::ceil(double{depth} / step) * step);
}

/// Count the filter taps around points of the plane that the plane itself shadows.
size_t countAcne(const Case& c, const Plane& plane, Float3 normal, std::mt19937& random)
{
    const Float2 middle = shadowTexel(c.map, shadowPoint(c.light, c.point));
    const int kernel = static_cast<int>(c.map.kernel);
    size_t shadowed = 0;
    for (int i = 0; i < 40; ++i)
    {
        const double x = double{middle.x + between(random, -1, 1)};
        const double y = double{middle.y + between(random, -1, 1)};
        const Double3 point = plane.meet(rayThrough(c.light, c.map, x, y));
        const ShadowPoint looked_up = shadowPoint(c.light, narrow(point));
        const Float2 texel = shadowTexel(c.map, looked_up);
        for (int dy = -kernel; dy <= kernel; ++dy)
            for (int dx = -kernel; dx <= kernel; ++dx)
                shadowed +=
                    looked_up.depth <
                    roundDepth(c, storedDepth(c, plane, normal, double{texel.x} + dx, double{texel.y} + dy));
    }
    return shadowed;
}

/// depth_quantum  as in ShadowLight
void expectNoAcne(Case (*makeCase)(std::mt19937&, ShadowMapSize), float depth_quantum = 0)
{
    std::mt19937 random(4);
    size_t without_offset = 0;
    for (uint32_t kernel = 0; kernel <= 2; ++kernel)
        for (int degrees = 1; degrees <= 89; ++degrees)
            for (int run = 0; run < 4; ++run)
            {
                Case c = makeCase(random, {.texels = 1024, .kernel = kernel});
                c.light.depth_quantum = depth_quantum;
                const Float3 ray = rayTo(c);
                const Float3 normal = tilted(ray, degrees * kDegree, random);
                const Plane plane{widen(c.point), widen(normal)};
                ASSERT_EQ(countAcne(c, plane, normal, random), 0u)
                    << degrees << " degrees, kernel " << kernel;
                // a normal along the ray has no slope
                without_offset += countAcne(c, plane, ray, random);
            }
    EXPECT_GT(without_offset, 1000u);
}

TEST(ShadowDepth, givesPlanesUnderASunNoAcne)
{
    expectNoAcne(randomSun);
}

TEST(ShadowDepth, givesPlanesUnderASpotNoAcne)
{
    expectNoAcne(randomSpot);
}

TEST(ShadowDepth, givesPlanesNoAcneWith16Bits)
{
    expectNoAcne(randomSun, 1.0f / 65535);
    expectNoAcne(randomSpot, 1.0f / 65535);
}

/// A wall on level ground with light across the wall from above. Returns how far behind the wall's foot a
/// ground point is still lit, in texels along that axis of the map that gives less.
double litBehindWall(Float3 up, double elevation_rad, ShadowMapSize size, std::mt19937& random)
{
    Case c{};
    // normal of the wall, in the direction of the light
    const Float3 away = tilted(up, 90 * kDegree, random);
    const Double3 shine = widen(away) * std::cos(elevation_rad) - widen(up) * std::sin(elevation_rad);
    c.light = makeSunShadow(narrow(shine), {{-6, -6, -6}, {6, 6, 6}});
    c.map = fitSunMap(c.light, {{}, 4}, size);
    const Plane ground{{}, widen(up)};
    const Plane wall{{}, widen(away)};

    const Double3 along = cross(widen(up), widen(away));
    double farthest = 0;
    for (int i = 0; i < 400; ++i)
    {
        const double behind = double{between(random, 0, 8)} / double{c.map.density} / std::sin(elevation_rad);
        const Double3 point = widen(away) * behind + along * double{between(random, -1, 1)};
        const ShadowPoint looked_up = shadowPoint(c.light, narrow(point));
        const Float2 texel = shadowTexel(c.map, looked_up);
        const LightRay centre =
            rayThrough(c.light, c.map, std::floor(double{texel.x}) + 0.5, std::floor(double{texel.y}) + 0.5);
        const bool meets_wall = dot(wall.meet(centre), widen(up)) >= 0;
        const float stored =
            std::max(storedDepth(c, ground, up, double{texel.x}, double{texel.y}),
                     meets_wall ? storedDepth(c, wall, away, double{texel.x}, double{texel.y}) : 0.0f);
        // direction across the wall's foot, in the map
        const Double3 across = unit(cross(along, widen(c.light.direction)));
        const double axes =
            std::abs(dot(across, widen(c.light.right))) + std::abs(dot(across, widen(c.light.down)));
        const double texels = std::abs(dot(across, point)) * double{c.map.density} / axes;
        if (looked_up.depth >= stored)
            farthest = std::max(farthest, texels);
    }
    return farthest;
}

/// The offset detaches the shadow by at most kernel + 1/2 texels and a margin; the texel's own centre adds
/// another half.
TEST(ShadowDepth, holdsShadowsBackByNoMoreThanTheFilterAndATexel)
{
    std::mt19937 random(5);
    double farthest = 0;
    for (uint32_t kernel = 0; kernel <= 2; ++kernel)
        for (int degrees = 5; degrees <= 85; degrees += 2)
        {
            const double elevation = degrees * kDegree;
            const double texels =
                litBehindWall(randomUnit(random), elevation, {.texels = 1024, .kernel = kernel}, random);
            // Ground that slopes away from the light makes the comparison easier, but the texel's centre may
            // lie before the wall.
            const double share = std::sin(elevation) * std::sin(elevation);
            EXPECT_LE(texels, std::max(0.5, (kernel + 1) * share) + 0.05 + double{kRasterMargin})
                << degrees << " degrees, kernel " << kernel;
            farthest = std::max(farthest, texels - kernel);
        }
    EXPECT_GT(farthest, 0.1);
}

} // namespace

} // namespace hearth::test

// Tests the comparison with a shadow map, simulated texel by texel on planes: slopes against finite
// differences, surfaces that shadow themselves (shadow acne), shadows that do not begin at their caster
// (peter panning), and light that shines in under walls. SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/frame/shadow_fit.h"

#include "tests/runtime/frame/shadow_cases.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

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
    const Float4 clip = shadowCasterClip(c.light, c.map, narrow(point), normal, 0, 0);
    return clip.z / clip.w;
}

/// Numbers of the taps of a filter, by their kind.
struct Taps
{
    std::array<size_t, 4> of_kind{};

    float litShare() const
    {
        return shared::litShare(count(kTapLit), count(kTapShadowed), count(kTapBeyond), count(kTapTouching),
                                true);
    }

private:
    float count(uint32_t kind) const { return static_cast<float>(of_kind[kind]); }
};

/// Filter as the shader does.
/// storedAt  depth of the texel that holds a position in the map
template <typename StoredAt>
Taps filterTaps(const Case& c, Double3 point, Float3 normal, const StoredAt& storedAt)
{
    const ShadowPoint looked_up = shadowPoint(c.light, narrow(point));
    const Float2 texel = shadowTexel(c.map, looked_up);
    const ShadowPlane plane = shadowReceiver(c.light, c.map, looked_up, narrow(point), normal);
    const int kernel = static_cast<int>(c.map.kernel);
    Taps taps;
    for (int dy = -kernel; dy <= kernel; ++dy)
        for (int dx = -kernel; dx <= kernel; ++dx)
        {
            const double u = std::floor(double{texel.x}) + dx + 0.5;
            const double v = std::floor(double{texel.y}) + dy + 0.5;
            const auto x = static_cast<float>(u - double{texel.x});
            const auto y = static_cast<float>(v - double{texel.y});
            const float stored = storedAt(u, v);
            uint32_t kind = compareTap(plane, x, y, stored);
            if (kind == kTapShadowed)
                kind = continueTap(plane, x, y, stored, storedAt(u + (x < 0 ? -1 : 1), v),
                                   storedAt(u, v + (y < 0 ? -1 : 1)));
            ++taps.of_kind[kind];
        }
    return taps;
}

/// Count the filter taps around points of the plane that the plane itself shadows.
/// unbiased  counts the taps that are nearer to the light than the point instead
size_t countAcne(const Case& c, const Plane& plane, Float3 normal, size_t& unbiased, std::mt19937& random)
{
    const Float2 middle = shadowTexel(c.map, shadowPoint(c.light, c.point));
    size_t shadowed = 0;
    for (int i = 0; i < 40; ++i)
    {
        const double x = double{middle.x + between(random, -1, 1)};
        const double y = double{middle.y + between(random, -1, 1)};
        const Double3 point = plane.meet(rayThrough(c.light, c.map, x, y));
        const auto storedAt = [&](double u, double v) { return storedDepth(c, plane, normal, u, v); };
        const Taps taps = filterTaps(c, point, normal, storedAt);
        shadowed += taps.of_kind[kTapShadowed] + taps.of_kind[kTapTouching];
        unbiased += shadowPoint(c.light, narrow(point)).depth < storedAt(x, y);
    }
    return shadowed;
}

void expectNoAcne(Case (*makeCase)(std::mt19937&, ShadowMapSize))
{
    std::mt19937 random(4);
    size_t without_planes = 0;
    for (uint32_t kernel = 0; kernel <= 2; ++kernel)
        for (int degrees = 1; degrees <= 89; ++degrees)
            for (int run = 0; run < 4; ++run)
            {
                const Case c = makeCase(random, {.texels = 1024, .kernel = kernel});
                const Float3 ray = rayTo(c);
                const Float3 normal = tilted(ray, degrees * kDegree, random);
                const Plane plane{widen(c.point), widen(normal)};
                ASSERT_EQ(countAcne(c, plane, normal, without_planes, random), 0u)
                    << degrees << " degrees, kernel " << kernel;
            }
    EXPECT_GT(without_planes, 1000u);
}

TEST(ShadowDepth, givesPlanesUnderASunNoAcne)
{
    expectNoAcne(randomSun);
}

TEST(ShadowDepth, givesPlanesUnderASpotNoAcne)
{
    expectNoAcne(randomSpot);
}

/// Point of the ground beside a thin wall, which the sun shines across from above.
struct WallPoint
{
    double behind_texels; ///< distance behind the wall's foot in the map; below 0 before it, in the light
    float lit_share;
};

std::vector<WallPoint> lookUpBesideWall(Float3 up, double elevation_rad, ShadowMapSize size,
                                        std::mt19937& random)
{
    Case c{};
    // normal of the wall, in the direction of the light
    const Float3 away = tilted(up, 90 * kDegree, random);
    const Double3 shine = widen(away) * std::cos(elevation_rad) - widen(up) * std::sin(elevation_rad);
    c.light = makeSunShadow(narrow(shine), {{-6, -6, -6}, {6, 6, 6}});
    c.map = fitSunMap(c.light, {{}, 4}, size);
    const Plane ground{{}, widen(up)};
    const Plane wall{{}, widen(away)};
    const auto storedAt = [&](double u, double v)
    {
        const bool meets_wall = dot(wall.meet(rayThrough(c.light, c.map, u, v)), widen(up)) >= 0;
        return std::max(storedDepth(c, ground, up, u, v),
                        meets_wall ? storedDepth(c, wall, away, u, v) : 0.0f);
    };
    const Double3 along = cross(widen(up), widen(away));
    std::vector<WallPoint> points;
    for (int i = 0; i < 400; ++i)
    {
        const double texels = double{between(random, -4, 4)};
        const double behind = texels / double{c.map.density} / std::sin(elevation_rad);
        const Double3 point = widen(away) * behind + along * double{between(random, -1, 1)};
        points.push_back({texels, filterTaps(c, point, up, storedAt).litShare()});
    }
    return points;
}

/// The light ends at the wall's foot, within half a texel: none shines in under the wall, and before it the
/// corner of two lit surfaces is free of shadow. A wall that is steeper to the light than kMaxContinuedSlope
/// is left out: it looks like two surfaces.
TEST(ShadowDepth, endsTheLightWhereAThinWallStands)
{
    std::mt19937 random(5);
    for (uint32_t kernel = 1; kernel <= 3; ++kernel)
        for (int degrees = 5; degrees <= 81; degrees += 2)
            for (const WallPoint& point : lookUpBesideWall(randomUnit(random), degrees * kDegree,
                                                           {.texels = 1024, .kernel = kernel}, random))
                if (point.behind_texels > 0.5)
                    EXPECT_EQ(point.lit_share, 0) << point.behind_texels << " texels behind, " << degrees;
                else if (point.behind_texels < -0.25)
                    EXPECT_EQ(point.lit_share, 1) << point.behind_texels << " texels behind, " << degrees;
}

/// A filter of one texel finds the wall up to half a texel, along both axes, beside its foot.
TEST(ShadowDepth, endsTheLightWithinATexelWithoutAFilter)
{
    std::mt19937 random(8);
    for (int degrees = 5; degrees <= 85; degrees += 2)
        for (const WallPoint& point :
             lookUpBesideWall(randomUnit(random), degrees * kDegree, {.texels = 1024, .kernel = 0}, random))
            if (std::abs(point.behind_texels) > 0.75)
                EXPECT_EQ(point.lit_share, point.behind_texels < 0 ? 1 : 0) << point.behind_texels;
}

/// Both walls of a lit corner are free of shadow, at any angle between them.
TEST(ShadowDepth, givesHollowCornersNoShadow)
{
    std::mt19937 random(10);
    for (int run = 0; run < 300; ++run)
    {
        const Case c = randomSpot(random, {.texels = 1024, .kernel = 1 + static_cast<uint32_t>(run) % 2});
        const Float3 to_light = rayTo(c) * -1.0f;
        const Float3 normals[] = {tilted(to_light, between(random, 2, 80) * kDegree, random),
                                  tilted(to_light, between(random, 2, 80) * kDegree, random)};
        const Plane walls[] = {{widen(c.point), widen(normals[0])}, {widen(c.point), widen(normals[1])}};
        // of two planes through a point the nearer one is seen, so the corner is hollow
        const auto nearer = [&](double u, double v)
        {
            const LightRay ray = rayThrough(c.light, c.map, u, v);
            const auto distance = [&](const Plane& wall)
            { return dot(wall.meet(ray), widen(c.light.direction)); };
            return distance(walls[0]) < distance(walls[1]) ? 0 : 1;
        };
        const auto storedAt = [&](double u, double v)
        {
            const double x = std::floor(u) + 0.5, y = std::floor(v) + 0.5;
            const int wall = nearer(x, y);
            return storedDepth(c, walls[wall], normals[wall], x, y);
        };
        const Float2 middle = shadowTexel(c.map, shadowPoint(c.light, c.point));
        size_t dark = 0;
        for (int i = 0; i < 100; ++i)
        {
            const double u = double{middle.x + between(random, -3, 3)};
            const double v = double{middle.y + between(random, -3, 3)};
            const int wall = nearer(u, v);
            const Double3 point = walls[wall].meet(rayThrough(c.light, c.map, u, v));
            dark += filterTaps(c, point, normals[wall], storedAt).litShare() < 1;
        }
        // a tenth of a texel along the edge, of six
        EXPECT_LE(dark, 8u);
    }
}

} // namespace

} // namespace hearth::test

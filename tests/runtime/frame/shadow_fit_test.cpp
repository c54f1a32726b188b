// Tests shadow maps fitted to spheres: their extent, their density, and their stability while the view moves.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/frame/shadow_fit.h"

#include "tests/runtime/frame/shadow_cases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace hearth::test
{

namespace
{

using namespace shared;

constexpr ShadowMapSize kSize{.texels = 512, .kernel = 1};

Box3 makeScene(float half)
{
    return {{-half, -half, -half}, {half, half, half}};
}

/// Texel at which the rasteriser puts a point, from the clip position of a caster.
Float2 rasterTexel(const ShadowLight& light, const ShadowMap& map, Float3 point)
{
    const Float4 clip = shadowCasterClip(light, map, point, light.direction, 1, 0, 1);
    return {(clip.x / clip.w + 1) * 0.5f * map.size, (clip.y / clip.w + 1) * 0.5f * map.size};
}

TEST(SunMap, holdsItsSphere)
{
    std::mt19937 random(1);
    for (int run = 0; run < 200; ++run)
    {
        const ShadowLight light = makeSunShadow(randomUnit(random), makeScene(100));
        const Sphere sphere{randomUnit(random) * between(random, 0, 80), std::exp2(between(random, -4, 9))};
        const ShadowMap map = fitSunMap(light, sphere, kSize);
        EXPECT_GE(map.density, 0.97f * 512 / (2 * sphere.radius));
        for (int i = 0; i < 50; ++i)
        {
            const Float3 point = sphere.center + randomUnit(random) * sphere.radius;
            ASSERT_TRUE(isInShadowMap(map, shadowPoint(light, point - light.origin)));
        }
    }
}

TEST(SunMap, depthsFallFromOneToZeroThroughTheScene)
{
    std::mt19937 random(2);
    for (int run = 0; run < 100; ++run)
    {
        const Box3 scene{{-30, 2, 5}, {70, 40, 300}};
        const ShadowLight light = makeSunShadow(randomUnit(random), scene);
        float least = 1;
        float most = 0;
        for (int corner = 0; corner < 8; ++corner)
        {
            const Float3 point{corner & 1 ? scene.max.x : scene.min.x, corner & 2 ? scene.max.y : scene.min.y,
                               corner & 4 ? scene.max.z : scene.min.z};
            const float depth = shadowPoint(light, point - light.origin).depth;
            const float deeper = shadowPoint(light, point + light.direction - light.origin).depth;
            EXPECT_NEAR(depth - deeper, light.depth_step, 1e-6f);
            least = std::min(least, depth);
            most = std::max(most, depth);
        }
        EXPECT_GE(least, 0.0f);
        EXPECT_LE(most, 1.0f);
        EXPECT_NEAR(most - least, 1, 1e-3f);
    }
}

TEST(SunMap, movesInWholeTexelsAndKeepsVerticesInTheirPlaceToTheBit)
{
    std::mt19937 random(3);
    for (int run = 0; run < 100; ++run)
    {
        const ShadowLight light = makeSunShadow(randomUnit(random), makeScene(200));
        const Sphere before{randomUnit(random) * between(random, 0, 50), between(random, 1, 40)};
        const Sphere after{before.center + randomUnit(random) * between(random, 0, 3), before.radius};
        const ShadowMap a = fitSunMap(light, before, kSize);
        const ShadowMap b = fitSunMap(light, after, kSize);
        ASSERT_EQ(a.scale_x, b.scale_x);
        const float step_x = b.offset_x - a.offset_x;
        const float step_y = b.offset_y - a.offset_y;
        EXPECT_EQ(step_x, std::floor(step_x));
        EXPECT_EQ(step_y, std::floor(step_y));
        for (int i = 0; i < 50; ++i)
        {
            const Float3 point = before.center + randomUnit(random) * (0.9f * before.radius) - light.origin;
            const ShadowPoint projected = shadowPoint(light, point);
            const Float2 at_a = shadowTexel(a, projected);
            const Float2 at_b = shadowTexel(b, projected);
            // floats near 0 have more bits of the fraction than elsewhere
            EXPECT_NEAR(at_a.x + step_x, at_b.x, 0x1p-12f);
            EXPECT_NEAR(at_a.y + step_y, at_b.y, 0x1p-12f);
            const Float4 drawn_a = shadowCasterClip(light, a, point, light.right, 1, 0, 1);
            const Float4 drawn_b = shadowCasterClip(light, b, point, light.right, 1, 0, 1);
            EXPECT_EQ((drawn_a.x + 1) * 256 + step_x, (drawn_b.x + 1) * 256);
            EXPECT_EQ((drawn_a.y + 1) * 256 + step_y, (drawn_b.y + 1) * 256);
            EXPECT_EQ(drawn_a.z, drawn_b.z);
        }
    }
}

TEST(SunMap, tinyAndHugeSpheresGetMapsThatFloatsCanAddress)
{
    const ShadowLight light = makeSunShadow({0.3f, -1, 0.2f}, makeScene(500));
    for (const float radius : {1e-30f, 1e-6f, 1e-3f, 1.0f, 1e4f, 1e12f})
    {
        const Sphere sphere{{300, 20, -200}, radius};
        const ShadowMap map = fitSunMap(light, sphere, kSize);
        ASSERT_TRUE(std::isfinite(map.scale_x) && map.scale_x > 0);
        EXPECT_LE(std::abs(map.offset_x), 0x1p21f);
        EXPECT_TRUE(isInShadowMap(map, shadowPoint(light, sphere.center - light.origin)));
    }
}

TEST(SplitSpheres, holdTheViewAndKeepTheirRadii)
{
    std::mt19937 random(4);
    std::array<Sphere, 4> first{};
    for (int run = 0; run < 50; ++run)
    {
        // an image that jitters by a pixel
        Camera camera{.position = randomUnit(random) * 100,
                      .shift = {between(random, -1, 1) / 800, between(random, -1, 1) / 500}};
        camera.target = camera.position + randomUnit(random);
        std::array<Sphere, 4> spheres{};
        const FrameView view = makeFrameView(camera, 1600, 1000, 1, 1);
        computeSplitSpheres(view, {.near = 0.1f, .far = 120, .blend = 0.8f}, spheres);
        if (run == 0)
            first = spheres;
        for (size_t i = 0; i < spheres.size(); ++i)
        {
            EXPECT_EQ(spheres[i].radius, first[i].radius);
            EXPECT_TRUE(i == 0 || spheres[i].radius > spheres[i - 1].radius);
        }
        for (int i = 0; i < 200; ++i)
        {
            const float w = 0.1f * std::pow(1200.0f, between(random, 0, 1));
            const float x = between(random, -1, 1) * w / length(row3(view.clip_x));
            const float y = between(random, -1, 1) * w / length(row3(view.clip_y));
            const Float3 point = view.eye + row3(view.clip_w) * w + normalizeOr(row3(view.clip_x), {}) * x +
                                 normalizeOr(row3(view.clip_y), {}) * y;
            EXPECT_TRUE(std::any_of(spheres.begin(), spheres.end(),
                                    [&](const Sphere& s)
                                    { return length(point - s.center) <= s.radius * 1.0001f; }));
        }
    }
}

TEST(SplitSpheres, holdViewsThatAreOffCentre)
{
    std::mt19937 random(6);
    for (int run = 0; run < 50; ++run)
    {
        Camera camera{.position = randomUnit(random) * 100,
                      .shift = {between(random, -3, 3), between(random, -3, 3)}};
        const Float3 forward = randomUnit(random);
        camera.target = camera.position + forward;
        std::array<Sphere, 4> spheres{};
        const FrameView view = makeFrameView(camera, 1600, 1000, 1, 1);
        computeSplitSpheres(view, {.near = 0.1f, .far = 120, .blend = 0.8f}, spheres);
        const Float3 right = normalizeOr(cross(forward, camera.up), {}), up = cross(right, forward);
        const float focal = 1 / std::tan(camera.y_fov_rad / 2);
        for (int i = 0; i < 200; ++i)
        {
            const float w = 0.1f * std::pow(1200.0f, between(random, 0, 1));
            const float x = (between(random, -1, 1) - camera.shift.x) * w * 1.6f / focal;
            const float y = (between(random, -1, 1) - camera.shift.y) * w / focal;
            const Float3 point = view.eye + forward * w + right * x + up * y;
            EXPECT_TRUE(std::any_of(spheres.begin(), spheres.end(),
                                    [&](const Sphere& s)
                                    { return length(point - s.center) <= s.radius * 1.0001f; }));
        }
    }
}

TEST(SpotMap, isAPartOfTheWholeConeScaledAndMoved)
{
    std::mt19937 random(5);
    int crops = 0;
    for (int run = 0; run < 500; ++run)
    {
        const ShadowLight light = makeSpotShadow(randomUnit(random) * 20, randomUnit(random), 0.05f);
        const float tangent = coneTangent(between(random, 0.1f, 1.3f));
        const ShadowMap whole = makeConeMap(tangent, kSize);
        const Sphere sphere{light.origin + randomUnit(random) * between(random, 1, 15),
                            between(random, 0.05f, 2)};
        const auto map = fitSpotMap(light, tangent, sphere, kSize);
        if (!map)
            continue;
        ++crops;
        EXPECT_GE(map->density, whole.density);
        // for texels and uv of the parent map alike: crop = parent * scale + offset
        const double scale = double{map->scale_x} / double{whole.scale_x};
        const double offset = double{map->offset_x} - double{whole.offset_x} * scale;
        for (int i = 0; i < 20; ++i)
        {
            const Float3 point = sphere.center - light.origin + randomUnit(random) * sphere.radius;
            const ShadowPoint projected = shadowPoint(light, point);
            if (projected.known == 0 || std::abs(projected.x) > tangent || std::abs(projected.y) > tangent)
                continue;
            ASSERT_TRUE(isInShadowMap(*map, projected));
            const Float2 texel = shadowTexel(*map, projected);
            EXPECT_NEAR(double{shadowTexel(whole, projected).x} * scale + offset, double{texel.x},
                        1e-3 + 2e-4 * scale);
            const Float2 drawn = rasterTexel(light, *map, point);
            EXPECT_NEAR(drawn.x, texel.x, 0.01f + 1e-6f * map->scale_x);
            EXPECT_NEAR(drawn.y, texel.y, 0.01f + 1e-6f * map->scale_y);
        }
    }
    EXPECT_GT(crops, 100);
}

/// The crop is minimal: points of the sphere come within a texel of each of its sides.
TEST(SpotMap, takesTheExactBoundsOfASphere)
{
    std::mt19937 random(6);
    for (int run = 0; run < 50; ++run)
    {
        const ShadowLight light = makeSpotShadow({}, randomUnit(random), 0.05f);
        const Sphere sphere{tilted(light.direction, 0.4, random) * 5, between(random, 0.2f, 1)};
        const ShadowMap map = *fitSpotMap(light, 2, sphere, {.texels = 64, .kernel = 1});
        Float2 low{64, 64};
        Float2 high{0, 0};
        for (int i = 0; i < 20000; ++i)
        {
            const Float2 texel =
                shadowTexel(map, shadowPoint(light, sphere.center + randomUnit(random) * sphere.radius));
            low = {std::min(low.x, texel.x), std::min(low.y, texel.y)};
            high = {std::max(high.x, texel.x), std::max(high.y, texel.y)};
        }
        EXPECT_NEAR(low.x, 2, 0.5f);
        EXPECT_NEAR(low.y, 2, 0.5f);
        EXPECT_NEAR(high.x, 62, 0.5f);
        EXPECT_NEAR(high.y, 62, 0.5f);
    }
}

TEST(SpotMap, isTheWholeConeForASphereAroundTheLight)
{
    const ShadowLight light = makeSpotShadow({1, 2, 3}, {0, -1, 0.1f}, 0.05f);
    const ShadowMap whole = makeConeMap(1, kSize);
    for (const Sphere& sphere :
         {Sphere{{1, 2, 3}, 0.01f}, Sphere{{1.5f, 2, 3}, 0.6f}, Sphere{{1, 900, 3}, 1e6f}})
    {
        const auto map = fitSpotMap(light, 1, sphere, kSize);
        ASSERT_TRUE(map.has_value());
        EXPECT_EQ(map->scale_x, whole.scale_x);
        EXPECT_EQ(map->scale_y, whole.scale_y);
        EXPECT_EQ(map->offset_x, whole.offset_x);
    }
}

TEST(SpotMap, isNotThereForSpheresBehindTheLightOrBesideTheCone)
{
    const ShadowLight light = makeSpotShadow({0, 0, 0}, {0, 0, -1}, 0.05f);
    EXPECT_FALSE(fitSpotMap(light, 1, {{0, 0, 3}, 2}, kSize).has_value());
    EXPECT_FALSE(fitSpotMap(light, 1, {{0, 0, 3}, 2.99f}, kSize).has_value());
    EXPECT_FALSE(fitSpotMap(light, 1, {{9, 0, -3}, 1}, kSize).has_value());
    EXPECT_FALSE(fitSpotMap(light, 1, {{0, -9, -3}, 1}, kSize).has_value());
    EXPECT_TRUE(fitSpotMap(light, 1, {{3.2f, 0, -3}, 1}, kSize).has_value());
    // reaches past the plane of the light without containing the light
    EXPECT_TRUE(fitSpotMap(light, 1, {{3, 0, -0.5f}, 2.5f}, kSize).has_value());
}

TEST(SpotMap, ofATinySphereStaysAddressable)
{
    const ShadowLight light = makeSpotShadow({0, 0, 0}, {0, 0, -1}, 0.05f);
    for (const float radius : {1e-30f, 1e-6f, 1e-3f})
    {
        const auto map = fitSpotMap(light, 1, {{2, 1, -5}, radius}, kSize);
        ASSERT_TRUE(map.has_value());
        EXPECT_LE(map->scale_x, 0x1p20f);
        EXPECT_TRUE(isInShadowMap(*map, shadowPoint(light, {2, 1, -5})));
    }
}

/// Directions on the twelve edges and eight corners of a cube, exactly and beside them by up to 1e-3.
std::vector<Float3> makeSeams(std::mt19937& random)
{
    std::vector<Float3> seams;
    for (int corner = 0; corner < 8; ++corner)
        for (int axis = 0; axis < 3; ++axis)
            for (int i = 0; i < 200; ++i)
            {
                float p[3] = {corner & 1 ? 1.0f : -1.0f, corner & 2 ? 1.0f : -1.0f,
                              corner & 4 ? 1.0f : -1.0f};
                p[axis] = i == 0 ? p[axis] : between(random, -1, 1);
                const Float3 exact = Float3{p[0], p[1], p[2]} * std::exp2(between(random, -6, 6));
                seams.push_back(exact);
                seams.push_back(exact + randomUnit(random) * (length(exact) * between(random, 0, 1e-3f)));
            }
    return seams;
}

TEST(PointFaces, coverAllDirectionsWithAllTapsOfTheFilter)
{
    std::mt19937 random(9);
    std::vector<Float3> points = makeSeams(random);
    for (int i = 0; i < 5000; ++i)
        points.push_back(randomUnit(random) * std::exp2(between(random, -6, 6)));
    for (const uint32_t kernel : {0u, 1u, 3u})
        for (const uint32_t texels : {16u, 512u, 8192u})
        {
            const ShadowMap map = makeConeMap(kFaceTangent, {.texels = texels, .kernel = kernel});
            for (const Float3& point : points)
            {
                const ShadowLight face = makePointShadow({3, 1, 2}, pointFace(point), 0.01f);
                const ShadowPoint at = shadowPoint(face, point);
                ASSERT_TRUE(isInShadowMap(map, at)) << point.x << " " << point.y << " " << point.z;
                // the face that is nearest in angle
                for (uint32_t other = 0; other < kPointFaces; ++other)
                    ASSERT_LE(dot(makePointShadow({}, other, 1).direction, point),
                              dot(face.direction, point));
            }
        }
}

/// The half-width of a map of n texels is n / (n - 2 (kernel + 1)): of these texels the face itself has
/// n - 2 (kernel + 1), less an eighth for rounding.
TEST(PointFaces, areWiderThanNinetyDegreesByTheFilterAlone)
{
    for (const uint32_t kernel : {0u, 1u, 3u})
    {
        const ShadowMap map = makeConeMap(kFaceTangent, {.texels = 256, .kernel = kernel});
        const float tangent = (map.size - map.offset_x) / map.scale_x;
        EXPECT_GE(tangent, 256.0f / (256 - 2 * static_cast<float>(kernel + 1)));
        EXPECT_LE(tangent, 256.0f / (255.8f - 2 * static_cast<float>(kernel + 1)));
        EXPECT_EQ(-map.offset_x / map.scale_x, -tangent);
    }
}

TEST(ShadowMaps, areSortedByDensityAndKeepTheOrderOfEquals)
{
    std::mt19937 random(7);
    std::vector<ShadowMap> maps(40);
    for (uint32_t i = 0; i < maps.size(); ++i)
    {
        maps[i].density = static_cast<float>(random() % 8);
        maps[i].layer = i;
    }
    sortByDensity(maps);
    for (size_t i = 1; i < maps.size(); ++i)
        EXPECT_TRUE(maps[i - 1].density > maps[i].density ||
                    (maps[i - 1].density == maps[i].density && maps[i - 1].layer < maps[i].layer));
}

TEST(ShadowMaps, theFirstThatHoldsAPointIsTheDensestThatDoes)
{
    std::mt19937 random(8);
    size_t found = 0;
    for (int run = 0; run < 50; ++run)
    {
        const ShadowLight light = makeSunShadow(randomUnit(random), makeScene(50));
        std::vector<ShadowMap> maps;
        for (int i = 0; i < 6; ++i)
            maps.push_back(fitSunMap(
                light, {randomUnit(random) * between(random, 0, 30), between(random, 1, 20)}, kSize));
        sortByDensity(maps);
        for (int i = 0; i < 100; ++i)
        {
            const Float3 point = randomUnit(random) * between(random, 0, 40);
            const ShadowMap* best = nullptr;
            for (const ShadowMap& map : maps)
                if (isInShadowMap(map, shadowPoint(light, point)) &&
                    (best == nullptr || map.density > best->density))
                    best = &map;
            EXPECT_EQ(findShadowMap(light, maps, point), best);
            found += best != nullptr;
        }
    }
    EXPECT_GT(found, 1000u);
}

TEST(ShadowMaps, nothingBehindASpotIsHeld)
{
    const ShadowLight light = makeSpotShadow({0, 0, 0}, {0, 0, -1}, 0.05f);
    const std::vector<ShadowMap> maps{makeConeMap(1, kSize)};
    EXPECT_NE(findShadowMap(light, maps, {0.1f, 0.2f, -4}), nullptr);
    EXPECT_EQ(findShadowMap(light, maps, {0.1f, 0.2f, 4}), nullptr);
    EXPECT_EQ(findShadowMap(light, maps, {0, 0, 0}), nullptr);
}

} // namespace

} // namespace hearth::test

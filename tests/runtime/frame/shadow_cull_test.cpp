// Tests culling of shadow casters: all that lies in the map is drawn, little else, and the cut is coarser by
// the bias.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/frame/shadow_cull.h"

#include "runtime/frame/lod_curve.h"
#include "tests/runtime/frame/shadow_cases.h"

#include <cmath>
#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

using namespace shared;

constexpr ShadowMapSize kSize{.texels = 256, .kernel = 1};

struct Case
{
    ShadowLight light;
    ShadowMap map;
};

Case randomCase(std::mt19937& random, bool sun)
{
    const Sphere sphere{randomUnit(random) * 10, between(random, 0.5f, 3)};
    if (sun)
    {
        const ShadowLight light = makeSunShadow(randomUnit(random), {{-30, -30, -30}, {30, 30, 30}});
        return {light, fitSunMap(light, sphere, kSize)};
    }
    const Float3 position = sphere.center + randomUnit(random) * between(random, 4, 9);
    const Float3 towards = normalizeOr(sphere.center - position, {});
    const ShadowLight light = makeSpotShadow(position, tilted(towards, 0.3, random), 0.1f);
    return {light, *fitSpotMap(light, 1, sphere, kSize)};
}

FrameView randomView(std::mt19937& random)
{
    Camera camera{.position = randomUnit(random) * between(random, 1, 300)};
    camera.target = camera.position + randomUnit(random);
    return makeFrameView(camera, 640, 480, 1, 1);
}

Instance unmoved()
{
    Instance instance{};
    instance.world_from_object_x = {1, 0, 0, 0};
    instance.world_from_object_y = {0, 1, 0, 0};
    instance.world_from_object_z = {0, 0, 1, 0};
    instance.scale_max = 1;
    return instance;
}

bool landsInMap(const Case& c, Float3 point)
{
    const Float4 clip = shadowCasterClip(c.light, c.map, point - c.light.origin, c.light.direction, 1, 0, 1);
    return clip.w > 0 && clip.z <= clip.w && std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w;
}

TEST(CasterView, leavesOutNothingThatLandsInTheMap)
{
    std::mt19937 random(1);
    size_t inside = 0;
    size_t culled = 0;
    for (int run = 0; run < 400; ++run)
    {
        const Case c = randomCase(random, run % 2 == 0);
        const FrameView casters = makeCasterView(randomView(random), c.light, c.map, 2);
        for (int i = 0; i < 100; ++i)
        {
            const Float3 middle = randomUnit(random) * between(random, 0, 30);
            const Float3 half = Float3{1, 1, 1} * between(random, 0.01f, 1);
            const bool outside = boxOutsideFrustum(casters, unmoved(), middle - half, middle + half);
            culled += outside;
            for (int corner = 0; corner < 8; ++corner)
            {
                const Float3 signs{corner & 1 ? 1.0f : -1.0f, corner & 2 ? 1.0f : -1.0f,
                                   corner & 4 ? 1.0f : -1.0f};
                const bool lands = landsInMap(c, middle + half * signs);
                inside += lands;
                ASSERT_FALSE(lands && outside);
            }
        }
    }
    EXPECT_GT(inside, 4000u);
    EXPECT_GT(culled, 20000u);
}

TEST(CasterView, leavesOutPointsBesideTheMap)
{
    std::mt19937 random(2);
    size_t count = 0;
    for (int run = 0; run < 200; ++run)
    {
        const Case c = randomCase(random, run % 2 == 0);
        const FrameView casters = makeCasterView(randomView(random), c.light, c.map, 1);
        for (int i = 0; i < 100; ++i)
        {
            const Float3 point = randomUnit(random) * between(random, 0, 30);
            const ShadowPoint projected = shadowPoint(c.light, point - c.light.origin);
            const Float2 texel = shadowTexel(c.map, projected);
            const auto off = [&](float t) { return t < -8 || t > c.map.size + 8; };
            // close to a spot, a few texels are less than the tolerance of the test
            const bool far = length(point - c.light.origin) > 2;
            const bool beside = projected.known != 0 && far && (off(texel.x) || off(texel.y));
            count += beside;
            if (beside)
            {
                EXPECT_TRUE(boxOutsideFrustum(casters, unmoved(), point, point));
            }
        }
    }
    EXPECT_GT(count, 5000u);
}

/// Casters within the range of a light are drawn, and boxes beyond the face's square at that distance are
/// not.
TEST(CasterView, ofALightWithARangeEndsThere)
{
    std::mt19937 random(8);
    size_t near = 0;
    size_t far = 0;
    for (int run = 0; run < 300; ++run)
    {
        const Float3 position = randomUnit(random) * between(random, 0, 1000);
        const uint32_t face = random() % kPointFaces;
        const ShadowLight light = makePointShadow(position, face, 0.05f);
        const float range = between(random, 0.5f, 20);
        const FrameView casters =
            makeCasterView(randomView(random), light, makeConeMap(kFaceTangent, kSize), 2, range);
        for (int i = 0; i < 100; ++i)
        {
            const Float3 from_light = randomUnit(random) * between(random, 0.02f, 2) * range;
            if (pointFace(from_light) != face)
                continue;
            const Float3 half = Float3{1, 1, 1} * (range * between(random, 0.001f, 0.01f));
            const Float3 middle = position + from_light;
            const bool outside = boxOutsideFrustum(casters, unmoved(), middle - half, middle + half);
            near += length(from_light) < range;
            EXPECT_FALSE(length(from_light) < range && outside);
            const bool beyond = dot(from_light, light.direction) > range * 1.02f;
            far += beyond;
            EXPECT_TRUE(!beyond || outside);
        }
    }
    EXPECT_GT(near, 1000u);
    EXPECT_GT(far, 500u);
}

TEST(CasterView, drawsWhatTheImageWouldWithErrorsDividedByTheBias)
{
    std::mt19937 random(3);
    const Case c = randomCase(random, true);
    size_t refined = 0;
    for (int run = 0; run < 2000; ++run)
    {
        const FrameView view = randomView(random);
        const FrameView casters = makeCasterView(view, c.light, c.map, 4);
        const Float3 center = randomUnit(random) * 10;
        const float error = std::exp2(between(random, -12, 2));
        const bool exceeds = errorExceeds(view, unmoved(), center, 1, error);
        EXPECT_EQ(errorExceeds(casters, unmoved(), center, 1, 4 * error), exceeds);
        refined += exceeds;
    }
    EXPECT_GT(refined, 200u);
    EXPECT_LT(refined, 1800u);
}

TEST(CasterView, looksAtNeitherConesNorWhatIsHidden)
{
    std::mt19937 random(4);
    const Case c = randomCase(random, false);
    FrameView view = randomView(random);
    EXPECT_EQ(makeCasterView(view, c.light, c.map, 1).flags, kCullInstances | kCullFrustum);
    view.flags = kCullCone;
    EXPECT_EQ(makeCasterView(view, c.light, c.map, 1).flags, 0u);
}

/// A view that requests the source triangles requests them in its shadows, too.
TEST(CasterView, refinesEverythingWhereTheImageDoes)
{
    std::mt19937 random(5);
    const Case c = randomCase(random, true);
    const FrameView view = makeFrameView({}, 64, 64, 0, 1);
    const FrameView casters = makeCasterView(view, c.light, c.map, 8);
    EXPECT_TRUE(errorExceeds(casters, unmoved(), {0, 0, -5}, 1, 0));
}

TEST(EyeCell, isAsLargeAsTheTexelsOfTheMapAllow)
{
    const FrameView view = makeFrameView({.position = {3, -7, 1e4f}}, 1280, 720, 1, 1);
    for (const float texel_m : {0.001f, 0.02f, 0.3f})
    {
        const EyeCell cell = findEyeCell(view, texel_m, 2);
        // the threshold of 2 pixels, in metres, at a distance that grows by the shift
        const float grown = 2 * cell.shift / view.lod_scale;
        EXPECT_LE(grown, 0.5f * texel_m * 1.001f);
        EXPECT_GE(grown, 0.25f * texel_m * 0.99f);
    }
    // the cut of the source triangles does not depend on the eye
    EXPECT_GT(findEyeCell(makeFrameView({}, 64, 64, 0, 1), 0.01f, 1).shift, 500);
}

/// A level of the seen surface that lies above it by the errors of both casts no shadow on it.
TEST(CutErrors, keepACoarserSurfaceFromShadowingTheOneThatIsSeen)
{
    std::mt19937 random(7);
    size_t without_errors = 0;
    for (int degrees = 1; degrees <= 89; ++degrees)
        for (int run = 0; run < 10; ++run)
        {
            const Case c = randomCase(random, run % 2 == 0);
            const float seen_error = between(random, 0, 0.03f);
            const float cast_error = between(random, 0, 0.03f);
            const Double3 centre = rayThrough(c.light, c.map, 128, 128).along * 5.0;
            const Float3 towards_light = narrow(unit(centre)) * -1.0f;
            const Float3 normal = tilted(towards_light, degrees * kDegree, random);
            const Double3 seen = rayThrough(c.light, c.map, 128, 128).begin + centre;
            const Plane casting{seen + widen(normal) * double{seen_error + cast_error}, widen(normal)};
            const auto isLit = [&](float lift, float error)
            {
                const ShadowPoint looked_up = shadowPoint(c.light, narrow(seen) + normal * lift);
                const Float2 texel = shadowTexel(c.map, looked_up);
                const LightRay ray = rayThrough(c.light, c.map, double{std::floor(texel.x)} + 0.5,
                                                double{std::floor(texel.y)} + 0.5);
                const Float4 clip =
                    shadowCasterClip(c.light, c.map, narrow(casting.meet(ray)), normal, 0, error, 1);
                return looked_up.depth >= clip.z / clip.w;
            };
            EXPECT_TRUE(isLit(seen_error, cast_error)) << degrees;
            without_errors += !isLit(0, cast_error) + !isLit(seen_error, 0);
        }
    EXPECT_GT(without_errors, 200u);
}

/// The depth of a caster is that of its plane moved along the normal by the error.
TEST(CutErrors, moveThePlaneOfACasterAlongItsNormal)
{
    std::mt19937 random(9);
    for (int degrees = 1; degrees <= 85; ++degrees)
        for (int run = 0; run < 10; ++run)
        {
            const Case c = randomCase(random, run % 2 == 0);
            const float error = between(random, 0.001f, 0.03f);
            const LightRay ray = rayThrough(c.light, c.map, 128.5, 128.5);
            const Double3 point = ray.begin + ray.along * 5.0;
            const Float3 normal = tilted(narrow(unit(ray.along)) * -1.0f, degrees * kDegree, random);
            const Plane farther{point - widen(normal) * double{error}, widen(normal)};
            const auto depthAt = [&](Double3 at)
            {
                const double z = dot(widen(c.light.direction), at);
                return (z * double{c.light.depth_scale} + double{c.light.depth_offset}) /
                       (c.light.perspective == 0 ? 1 : z);
            };
            const auto drawnDepth = [&](float moved)
            {
                const Float4 clip = shadowCasterClip(c.light, c.map, narrow(point), normal, 0, moved, 1);
                return double{clip.z / clip.w};
            };
            const double expected = depthAt(point) - depthAt(farther.meet(ray));
            EXPECT_NEAR(drawnDepth(0) - drawnDepth(error), expected, 1e-3 * expected + 1e-7);
        }
}

} // namespace

} // namespace hearth::test

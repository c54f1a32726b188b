// Tests baked irradiance against closed forms: lamps over planes, polygons that shine, the furnace; and rooms
// that must stay dark.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/receivers/bake/bake.h"
#include "cook/receivers/bake/dilation.h"
#include "cook/receivers/bake/direct_light.h"
#include "formats/gpu_shared/record_values.h"
#include "tests/cook/receivers/receiver_shapes.h"
#include "tests/reference/polygon_visibility.h"
#include "tests/support/sanitized.h"

#include <gtest/gtest.h>
#include <numbers>
#include <random>
#include <tbb/global_control.h>

namespace hearth::receivers
{
namespace
{

constexpr float kPi = std::numbers::pi_v<float>;
constexpr Float3 kGrey{0.5f, 0.5f, 0.5f};

Lamp pointLamp(Float3 position, Float3 intensity)
{
    Lamp lamp;
    lamp.light.type = shared::kLightPoint;
    lamp.light.position = position;
    lamp.light.intensity = intensity;
    return lamp;
}

Lamp sun(Float3 direction, float lux)
{
    Lamp lamp;
    lamp.light.type = shared::kLightDirectional;
    lamp.light.direction = normalizeOr(direction, {0, -1, 0});
    lamp.light.intensity = {lux, lux, lux};
    return lamp;
}

shared::Sky constantSky(Float3 radiance)
{
    shared::Sky sky;
    sky.zenith = sky.horizon = sky.ground = radiance;
    return sky;
}

/// Light of all triangles of a scene from the given one on.
MeshLight shineAll(const BakeScene& scene, size_t first, Float3 radiance)
{
    MeshLight light;
    for (size_t t = first; t < scene.triangles.size(); ++t)
    {
        light.triangles.push_back(static_cast<uint32_t>(t));
        light.radiance.push_back(radiance);
    }
    return light;
}

/// Floor of 4 x 4 m at z = 0 that faces up.
BakeScene makeFloor(Float3 albedo = kGrey)
{
    BakeScene scene;
    scene.instance_count = 1;
    addQuad(scene.triangles, {-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, albedo, 0);
    return scene;
}

BakedReceivers bake(const BakeScene& scene, double texels_per_metre)
{
    std::optional<BakedReceivers> baked = bakeReceivers(scene, {.texels_per_metre = texels_per_metre});
    EXPECT_TRUE(baked);
    EXPECT_FALSE(baked->texels.empty());
    return std::move(*baked);
}

/// Return the irradiance of a quad of radiance 1, by the reference: what the hemisphere loses to it.
double quadIrradiance(Float3 point, Float3 normal, Float3 corner, Float3 a, Float3 b)
{
    using reference::Polygon;
    const auto wide = [](Float3 v) { return reference::Double3{v.x, v.y, v.z}; };
    const Polygon quad{wide(corner), wide(corner + a), wide(corner + a + b), wide(corner + b)};
    const auto m1 = reference::visibleBesidePolygons(wide(point), wide(normal), std::span(&quad, 1)).m1;
    return std::numbers::pi - (m1.x * normal.x + m1.y * normal.y + m1.z * normal.z);
}

/// Rotate about an axis that is parallel to no edge of a room.
Float3 rotated(Float3 v, float angle)
{
    const Float3 axis = normalizeOr({1, 2, 3}, {});
    return v * std::cos(angle) + cross(axis, v) * std::sin(angle) +
           axis * (dot(axis, v) * (1 - std::cos(angle)));
}

/// Ground of many small triangles that is bumpy, with texels.
void addHills(std::vector<Triangle>& triangles, uint32_t count, uint32_t instance)
{
    const auto height = [](Float2 at) { return 0.3f * std::sin(5 * at.x) * std::cos(7 * at.y); };
    const auto vertex = [&](uint32_t x, uint32_t y)
    {
        const float step = 1 / static_cast<float>(count);
        return Float2{static_cast<float>(x) * step, static_cast<float>(y) * step};
    };
    const auto add = [&](Float2 a, Float2 b, Float2 c)
    {
        Triangle triangle{{}, {}, {a, b, c}, kGrey, instance, false};
        for (size_t i = 0; i < 3; ++i)
            triangle.corners[i] = {4 * triangle.uvs[i].x - 2, 4 * triangle.uvs[i].y - 2,
                                   height(triangle.uvs[i])};
        triangle.normals.fill(normalizeOr(crossEdges(triangle), {0, 0, 1}));
        triangles.push_back(triangle);
    };
    for (uint32_t y = 0; y < count; ++y)
        for (uint32_t x = 0; x < count; ++x)
        {
            add(vertex(x, y), vertex(x + 1, y), vertex(x + 1, y + 1));
            add(vertex(x, y), vertex(x + 1, y + 1), vertex(x, y + 1));
        }
}

} // namespace

TEST(ReceiversBake, hasTheLightOfALampOverAPlane)
{
    BakeScene scene = makeFloor();
    scene.lamps = {pointLamp({0.3f, -0.2f, 1.5f}, {10, 20, 5}), pointLamp({0.3f, -0.2f, -1}, {10, 10, 10})};
    const BakedReceivers baked = bake(scene, 16);
    size_t count = 0;
    for (size_t i = 0; i < baked.texels.size(); ++i)
    {
        if (baked.texels[i].is_copy)
            continue;
        const Float3 offset = scene.lamps[0].light.position - baked.texels[i].position;
        const float expected = offset.z / std::pow(length(offset), 3.0f);
        ASSERT_NEAR(baked.light(i)[0].x, 10 * expected, 0.005f * 10 * expected);
        ASSERT_NEAR(baked.light(i)[0].y, 20 * expected, 0.005f * 20 * expected);
        ASSERT_EQ(baked.light(i)[1], Float3{});
        ++count;
    }
    EXPECT_EQ(count, 64u * 64);
}

TEST(ReceiversBake, hasTheConeOfASpot)
{
    constexpr float kInner = 0.3f, kOuter = 0.5f;
    BakeScene scene = makeFloor();
    Lamp spot = pointLamp({0, 0, 2}, {1, 1, 1});
    spot.light.type = shared::kLightSpot;
    spot.light.direction = {0, 0, -1};
    spot.light.cone_scale = 1 / (std::cos(kInner) - std::cos(kOuter));
    spot.light.cone_offset = -std::cos(kOuter) * spot.light.cone_scale;
    scene.lamps = {spot, pointLamp({0, 0, 2}, {1, 1, 1})};
    const BakedReceivers baked = bake(scene, 16);
    size_t inside = 0, outside = 0;
    for (size_t i = 0; i < baked.texels.size(); ++i)
    {
        const Float3 at = baked.texels[i].position;
        const float angle = std::atan2(std::sqrt(at.x * at.x + at.y * at.y), 2.0f);
        if (angle < kInner - 0.04f)
        {
            ++inside;
            ASSERT_NEAR(baked.light(i)[0].x, baked.light(i)[1].x, 1e-6f);
        }
        if (angle > kOuter + 0.04f)
        {
            ++outside;
            ASSERT_EQ(baked.light(i)[0], Float3{});
        }
        ASSERT_LE(baked.light(i)[0].x, baked.light(i)[1].x * 1.000001f);
    }
    EXPECT_GT(inside, 200u);
    EXPECT_GT(outside, 1000u);
}

TEST(ReceiversBake, staysDarkInASealedRoom)
{
    for (const float angle : {0.0f, 0.7f})
    {
        BakeScene scene;
        scene.instance_count = 1;
        addRoom(scene.triangles, {-2, -1.5f, -1}, {4, 3, 2}, kGrey, 0);
        for (Triangle& triangle : scene.triangles)
            for (size_t i = 0; i < 3; ++i)
            {
                triangle.corners[i] = rotated(triangle.corners[i], angle);
                triangle.normals[i] = rotated(triangle.normals[i], angle);
            }
        scene.lamps = {pointLamp({0, 0, 5}, {1e6f, 1e6f, 1e6f}), pointLamp({3, 0, 0.2f}, {1e6f, 1e6f, 1e6f}),
                       sun({1, 1, -1}, 1e6f), sun({0, 0.1f, 1}, 1e6f)};
        scene.lamps[0].radius = 0.5f;
        scene.sky = constantSky({1e6f, 1e6f, 1e6f});
        const BakedReceivers baked = bake(scene, 16);
        for (const Float3& light : baked.irradiance)
            ASSERT_EQ(light, Float3{}) << angle;
        EXPECT_GT(baked.shadow_rays, baked.texels.size());
    }
}

TEST(ReceiversBake, hasTheLightOfAShiningQuad)
{
    const Float3 corner{-0.5f, -0.3f, 0.4f}, a{0, 1, 0.3f}, b{1.2f, 0, 0};
    BakeScene scene = makeFloor();
    scene.instance_count = 2;
    addQuad(scene.triangles, corner, a, b, {}, 1, {{0.5f, 0.5f}, {0.5f, 0.5f}});
    scene.mesh_lights = {shineAll(scene, 2, {3, 1, 0})};
    const size_t first = scene.triangles.size();
    constexpr int kPieces = 6; // the same light of 72 triangles, which are sampled
    for (int i = 0; i < kPieces * kPieces; ++i)
        addQuad(scene.triangles,
                corner + a * (static_cast<float>(i % kPieces) / kPieces) +
                    b * (static_cast<float>(i / kPieces) / kPieces) + Float3{0, 0, 1e-4f},
                a / kPieces, b / kPieces, {}, 1, {{0.5f, 0.5f}, {0.5f, 0.5f}});
    scene.mesh_lights.push_back(shineAll(scene, first, {3, 1, 0}));
    // each of the two alone, for they shadow each other
    for (const size_t light : {size_t{0}, size_t{1}})
    {
        BakeScene alone = scene;
        alone.mesh_lights = {scene.mesh_lights[light]};
        if (light == 0)
            alone.triangles.resize(first);
        else
        {
            alone.triangles.erase(alone.triangles.begin() + 2, alone.triangles.begin() + 4);
            for (uint32_t& triangle : alone.mesh_lights[0].triangles)
                triangle -= 2;
        }
        const BakedReceivers baked = bake(alone, 16);
        double error = 0, squares = 0, found_sum = 0, expected_sum = 0;
        for (size_t i = 0; i < baked.texels.size(); ++i)
        {
            if (baked.texels[i].is_copy)
                continue;
            const Float3 at = baked.texels[i].position;
            const bool is_behind = dot(cross(a, b), at - corner) <= 0; // of the quad, whose back is black
            const double expected = is_behind ? 0 : quadIrradiance(at, {0, 0, 1}, corner, a, b);
            const double found = double{baked.light(i)[0].x} / 3;
            error += (found - expected) * (found - expected);
            squares += expected * expected;
            found_sum += found;
            expected_sum += expected;
            if (light == 0)
            {
                ASSERT_NEAR(found, expected, 0.01 * expected + 1e-4) << i;
            }
            ASSERT_EQ(baked.light(i)[0].z, 0);
        }
        const double rms = std::sqrt(error / squares);
        std::printf("light of %s triangles: %.2f %% rms\n", light == 0 ? "2" : "72", 100 * rms);
        EXPECT_LT(rms, light == 0 ? 0.004 : 0.04); // noise of 128 rays
        EXPECT_NEAR(found_sum / expected_sum, 1, 0.003);
    }
}

TEST(ReceiversBake, hasPenumbras)
{
    // a wall of half the height of the lamp over the line y = 0: half the lamp is seen from one metre behind
    BakeScene scene = makeFloor({});
    scene.instance_count = 2;
    addQuad(scene.triangles, {-50, 0, 0}, {100, 0, 0}, {0, 0, 1}, {}, 1, {{0.5f, 0.5f}, {0.5f, 0.5f}});
    scene.lamps = {pointLamp({0, -1, 2}, {1, 1, 1}), pointLamp({0, -1, 2}, {1, 1, 1})};
    scene.lamps[0].radius = 0.3f;
    const BakedReceivers baked = bake(scene, 20);
    double sum = 0, all = 0;
    for (size_t i = 0; i < baked.texels.size(); ++i)
    {
        const Float3 at = baked.texels[i].position, offset = Float3{0, -1, 2} - at;
        const float whole = offset.z / std::pow(length(offset), 3.0f);
        const bool is_dark = at.y > 0.05f && at.y < 0.95f;
        if (is_dark)
        {
            ASSERT_EQ(baked.light(i)[1].x, 0);
        }
        if (std::abs(at.x) < 0.3f && std::abs(at.y - 1) < 0.2f)
        {
            sum += double{baked.light(i)[0].x / whole};
            all += 1;
        }
    }
    EXPECT_GT(all, 50);
    EXPECT_NEAR(sum / all, 0.5, 0.02);
}

TEST(ReceiversBake, isAFurnaceWithTexels)
{
    BakeScene scene;
    scene.instance_count = 1;
    addRoom(scene.triangles, {0, 0, 0}, {3, 2, 2.5f}, {0.5f, 0.8f, 0}, 0);
    scene.mesh_lights = {shineAll(scene, 0, {1, 1, 1})};
    const BakedReceivers baked = bake(scene, test::kSanitized ? 4 : 8);
    Double3 mean;
    for (size_t i = 0; i < baked.texels.size(); ++i)
    {
        const Float3 light = baked.light(i)[0];
        mean = mean + widen(light) * (1 / static_cast<double>(baked.texels.size()));
        ASSERT_NEAR(light.x, kPi / 0.5f, 0.02f * kPi / 0.5f) << i;
        ASSERT_NEAR(light.y, kPi / 0.2f, 0.02f * kPi / 0.2f) << i;
        ASSERT_NEAR(light.z, kPi, 0.02f * kPi) << i;
    }
    std::printf("furnace: %.4f, %.4f, %.4f of the closed form\n", mean.x / (std::numbers::pi / 0.5),
                mean.y / (std::numbers::pi / 0.2), mean.z / std::numbers::pi);
    EXPECT_NEAR(mean.y, std::numbers::pi / 0.2, 0.01 * std::numbers::pi / 0.2);
}

TEST(ReceiversBake, isAFurnaceWithPatches)
{
    BakeScene scene;
    scene.instance_count = 2;
    // a plate over the floor has texels, walls and its back have patches
    addQuad(scene.triangles, {1, 0.5f, 0.01f}, {1, 0, 0}, {0, 1, 0}, kGrey, 0);
    addRoom(scene.triangles, {0, 0, 0}, {3, 2, 2.5f}, kGrey, 1);
    for (size_t t = 0; t < scene.triangles.size(); ++t)
    {
        scene.triangles[t].double_sided = t < 2;
        if (t >= 2)
            scene.triangles[t].uvs.fill({0, 0});
    }
    scene.mesh_lights = {shineAll(scene, 0, {1, 1, 1})};
    const BakedReceivers baked = bake(scene, 16);
    EXPECT_EQ(baked.rectangles[1].uvs.use, UvUse::flat);
    for (size_t i = 0; i < baked.texels.size(); ++i)
        ASSERT_NEAR(baked.light(i)[0].x, kPi / 0.5f, 0.02f * kPi / 0.5f) << i;
}

TEST(ReceiversBake, sharesPatchesOfSmallTriangles)
{
    // the same furnace, its walls in triangles of 2 cm, which share patches
    BakeScene scene;
    scene.instance_count = 2;
    addQuad(scene.triangles, {0.2f, 0.2f, 0.01f}, {0.6f, 0, 0}, {0, 0.6f, 0}, kGrey, 0);
    std::vector<Triangle> room;
    addRoom(room, {0, 0, 0}, {1, 1, 1}, kGrey, 1);
    constexpr int kParts = 20;
    for (size_t t = 0; t < room.size(); t += 2)
        for (int i = 0; i < kParts * kParts; ++i)
        {
            const Float3 a = (room[t].corners[1] - room[t].corners[0]) / kParts,
                         b = (room[t].corners[2] - room[t].corners[1]) / kParts;
            addQuad(scene.triangles,
                    room[t].corners[0] + a * static_cast<float>(i % kParts) +
                        b * static_cast<float>(i / kParts),
                    a, b, kGrey, 1, {{0, 0}, {0, 0}});
        }
    // a lamp's light, of which the walls give back as much as the same walls of large triangles
    scene.lamps = {pointLamp({0.5f, 0.4f, 0.7f}, {1, 1, 1})};
    const BakedReceivers small = bake(scene, 16);
    BakeScene large = scene;
    large.triangles.resize(2);
    for (Triangle& triangle : room)
        triangle.uvs.fill({0, 0});
    large.triangles.insert(large.triangles.end(), room.begin(), room.end());
    const BakedReceivers expected = bake(large, 16);
    double sum = 0, expected_sum = 0;
    for (size_t i = 0; i < small.texels.size(); ++i)
    {
        sum += double{small.light(i)[0].x};
        expected_sum += double{expected.light(i)[0].x};
    }
    EXPECT_NEAR(sum / expected_sum, 1, 0.01);
    EXPECT_LT(small.gather_rays, 64u * (small.texels.size() + 6 * 4 * 4 + 100));
}

TEST(ReceiversBake, hasNoLightInsideOfWalls)
{
    BakeScene scene = makeFloor();
    scene.instance_count = 2;
    std::vector<Triangle> box;
    addRoom(box, {-1, -1, -1}, {2, 2, 2}, kGrey, 1);
    for (Triangle& triangle : box) // seen from outside
    {
        std::swap(triangle.corners[1], triangle.corners[2]);
        triangle.uvs.fill({0, 0});
        for (Float3& normal : triangle.normals)
            normal = -normal;
    }
    scene.triangles.insert(scene.triangles.end(), box.begin(), box.end());
    scene.lamps = {pointLamp({1.7f, 0, 1.5f}, {1, 1, 1})};
    const BakedReceivers baked = bake(scene, 16);
    for (const BakedTexel& texel : baked.texels)
    {
        const float inside = 1 - std::max(std::abs(texel.position.x), std::abs(texel.position.y));
        ASSERT_LT(inside, 0.07f);
    }
    // the wall of the box hides the lamp from the floor on its other side
    EXPECT_GT(baked.texels.size(), 64u * 64 - 32 * 32);
}

TEST(ReceiversBake, hasTheLightOfTheSkyOverAPlane)
{
    // the gradient goes along y: the plane at z = 0 sees all of it, that at y = 0 what is above the horizon
    shared::Sky sky;
    sky.zenith = {0.2f, 0.5f, 1};
    sky.horizon = {1, 0.8f, 0.6f};
    sky.ground = {0.1f, 0.05f, 0};
    for (const bool is_level : {false, true})
    {
        BakeScene scene = makeFloor();
        if (is_level)
        {
            scene.triangles.clear();
            addQuad(scene.triangles, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, kGrey, 0);
        }
        scene.sky = sky;
        // rings and sectors of equal projected solid angle
        constexpr int kRings = 400, kSectors = 400;
        Double3 expected;
        for (int i = 0; i < kRings * kSectors; ++i)
        {
            const double radius = std::sqrt((i / kSectors + 0.5) / kRings),
                         turn = 2 * std::numbers::pi * (i % kSectors + 0.5) / kSectors;
            const double across = radius * std::cos(turn), along = radius * std::sin(turn),
                         up = std::sqrt(1 - radius * radius);
            const Double3 direction = is_level ? Double3{across, up, along} : Double3{across, along, up};
            expected = expected +
                       widen(skyRadiance(sky, narrow(direction))) * (std::numbers::pi / (kRings * kSectors));
        }
        const BakedReceivers baked = bake(scene, 8);
        ASSERT_EQ(baked.light_count, 1u);
        const std::array channels{expected.x, expected.y, expected.z};
        Double3 mean;
        double largest = 0, squares = 0;
        for (const Float3& light : baked.irradiance)
        {
            mean = mean + widen(light) * (1 / static_cast<double>(baked.irradiance.size()));
            for (int channel = 0; channel < 3; ++channel)
            {
                const double error = double{light[channel]} / channels[static_cast<size_t>(channel)] - 1;
                largest = std::max(largest, std::abs(error));
                squares += error * error / (3 * static_cast<double>(baked.irradiance.size()));
            }
        }
        std::printf("sky over a plane: %.2f %% rms, a texel is off by %.2f %% at most\n",
                    100 * std::sqrt(squares), 100 * largest);
        EXPECT_LT(largest, is_level ? 0.01 : 0.05); // the edge of the ground is noise of 64 rays
        EXPECT_LT(std::sqrt(squares), 0.015);
        EXPECT_NEAR(mean.x, expected.x, 0.002 * expected.x);
        EXPECT_NEAR(mean.y, expected.y, 0.002 * expected.y);
        EXPECT_NEAR(mean.z, expected.z, 0.002 * expected.z);
    }
}

TEST(ReceiversBake, hasHalfTheSkyUnderTheEdgeOfARoof)
{
    // a black roof over x > 0 that has no end: at x the sky is seen up to an angle of sine s before the
    // vertical, (1 + s) / 2 of its light
    BakeScene scene = makeFloor();
    scene.instance_count = 2;
    addQuad(scene.triangles, {0, -200, 1}, {0, 400, 0}, {200, 0, 0}, {}, 1, {{0.5f, 0.5f}, {0.5f, 0.5f}});
    scene.sky = constantSky({1, 1, 1});
    const BakedReceivers baked = bake(scene, 16);
    double below = 0, count = 0, squares = 0;
    for (size_t i = 0; i < baked.texels.size(); ++i)
    {
        if (baked.texels[i].is_copy)
            continue;
        const double x = double{baked.texels[i].position.x};
        const double expected = std::numbers::pi * 0.5 * (1 - x / std::sqrt(1 + x * x));
        const double found = double{baked.light(i)[0].x};
        squares += (found - expected) * (found - expected) / static_cast<double>(baked.texels.size());
        if (std::abs(x) > 0.05)
            continue;
        below += found;
        count += std::numbers::pi / 2;
    }
    std::printf("sky beside a roof: %.2f %% of the sky's light rms\n", 100 * std::sqrt(squares) / 3.14159);
    EXPECT_GT(count, 100);
    EXPECT_NEAR(below / count, 1, 0.01);
    EXPECT_LT(std::sqrt(squares), 0.02 * std::numbers::pi); // noise of 64 rays
}

TEST(ReceiversBake, hasTheSkyThatWallsGiveBack)
{
    // an open box under the sky, and under a black lid that shines as the sky does
    BakeScene box;
    box.instance_count = 2;
    addRoom(box.triangles, {0, 0, 0}, {2, 2, 1}, {0.8f, 0.6f, 0.4f}, 0);
    std::erase_if(box.triangles, [](const Triangle& triangle) { return triangle.normals[0].z < -0.5f; });
    ASSERT_EQ(box.triangles.size(), 10u);
    BakeScene under_sky = box, under_lid = box;
    under_sky.sky = constantSky({1, 1, 1});
    addQuad(under_lid.triangles, {0, 0, 1}, {0, 2, 0}, {2, 0, 0}, {}, 1, {{0.5f, 0.5f}, {0.5f, 0.5f}});
    under_lid.mesh_lights = {shineAll(under_lid, box.triangles.size(), {1, 1, 1})};
    const BakedReceivers baked = bake(under_sky, 12), expected = bake(under_lid, 12);
    ASSERT_EQ(baked.texels.size(), expected.texels.size());
    Double3 sum, expected_sum;
    for (size_t i = 0; i < baked.texels.size(); ++i)
    {
        sum = sum + widen(baked.light(i)[0]);
        expected_sum = expected_sum + widen(expected.light(i)[0]);
    }
    EXPECT_GT(sum.x, 1.1 * sum.z);
    EXPECT_NEAR(sum.x / expected_sum.x, 1, 0.01);
    EXPECT_NEAR(sum.z / expected_sum.z, 1, 0.01);
}

TEST(ReceiversBake, spreadsNoSpecksThroughWalls)
{
    // one floor goes below a wall of 20 cm; on one side of it a lamp hangs below a small plate
    BakeScene scene = makeFloor();
    scene.instance_count = 2;
    constexpr float kWall = 0.1f, kHigh = 1.5f;
    std::vector<Triangle> walls;
    addRoom(walls, {-3, -3, -0.001f}, {3 - kWall, 6, 2}, kGrey, 1);
    addRoom(walls, {kWall, -3, -0.001f}, {3 - kWall, 6, 2}, kGrey, 1);
    addQuad(walls, {-0.5f, -0.1f, kHigh}, {0, 0.2f, 0}, {0.2f, 0, 0}, {0.8f, 0.8f, 0.8f}, 1);
    for (Triangle& triangle : walls)
        triangle.uvs.fill({0.5f, 0.5f});
    scene.triangles.insert(scene.triangles.end(), walls.begin(), walls.end());
    scene.lamps = {pointLamp({-0.4f, 0, kHigh - 0.2f}, {1, 1, 1})};
    const BakedReceivers baked = bake(scene, 16);
    size_t dark = 0;
    for (size_t i = 0; i < baked.texels.size(); ++i)
        if (baked.texels[i].position.x > kWall + 2.0f / 16)
        {
            ASSERT_EQ(baked.light(i)[0], Float3{}) << baked.texels[i].position.x;
            ++dark;
        }
    EXPECT_GT(dark, 500u);
}

namespace
{

/// Parallelogram that gives back the light of a lamp, to the side of cross(a, b).
struct GivingBack
{
    Float3 corner, a, b;

    /// Return the irradiance that it causes at a point of a level floor, as a sum over small parts.
    /// lamp  of one candela
    double at(Float3 to, Float3 lamp, double albedo) const
    {
        constexpr int kParts = 20;
        const Double3 area = widen(cross(a, b)) * (1.0 / (kParts * kParts));
        double sum = 0;
        for (int i = 0; i < kParts * kParts; ++i)
        {
            const auto along = static_cast<float>((i % kParts + 0.5) / kParts),
                       across = static_cast<float>((i / kParts + 0.5) / kParts);
            const Float3 part = corner + a * along + b * across;
            const Double3 to_lamp = widen(lamp - part), down = widen(to - part);
            const double lit = std::max(dot(to_lamp, area), 0.0) / std::pow(length(to_lamp), 3);
            sum += albedo / std::numbers::pi * lit * std::max(dot(down, area), 0.0) / length(area) * -down.z /
                   std::pow(length(down), 4);
        }
        return sum;
    }
};

} // namespace

TEST(ReceiversBake, hasNoSpecksUnderASmallBrightSurface)
{
    // a lamp below a plate of 20 cm gives back light along one gather ray of some hundred; beside it stands a
    // wall in its light, which up to twenty rays of a texel meet, and all others meet nothing
    constexpr float kHigh = 1.5f, kHalf = 0.1f, kAlbedo = 0.8f;
    constexpr Float3 kLamp{0, 0, 1.2f};
    const GivingBack plate{{-kHalf, -kHalf, kHigh}, {0, 2 * kHalf, 0}, {2 * kHalf, 0, 0}};
    const GivingBack wall{{2, -2, 0}, {0, 0, 2}, {0, 4, 0}};
    for (const bool has_wall : {false, true})
    {
        BakeScene scene = makeFloor({});
        scene.instance_count = 2;
        std::vector<GivingBack> quads{plate};
        if (has_wall)
            quads.push_back(wall);
        for (const GivingBack& quad : quads)
            addQuad(scene.triangles, quad.corner, quad.a, quad.b, {kAlbedo, kAlbedo, kAlbedo}, 1,
                    {{0.5f, 0.5f}, {0.5f, 0.5f}});
        scene.lamps = {pointLamp(kLamp, {1, 1, 1})};
        const BakedReceivers all = bakeReceivers(scene, {.texels_per_metre = 16, .bounces = 1}).value();
        const BakedReceivers direct = bakeReceivers(scene, {.texels_per_metre = 16, .bounces = 0}).value();
        double squares = 0, errors = 0, found_sum = 0, sum = 0, largest = 0;
        for (size_t i = 0; i < all.texels.size(); ++i)
        {
            if (all.texels[i].is_copy)
                continue;
            const double found = double{all.light(i)[0].x - direct.light(i)[0].x};
            double expected = 0;
            for (const GivingBack& quad : quads)
                expected += quad.at(all.texels[i].position, kLamp, double{kAlbedo});
            errors += (found - expected) * (found - expected);
            squares += expected * expected;
            found_sum += found;
            sum += expected;
            largest = std::max(largest, found / expected);
        }
        const double rms = std::sqrt(errors / squares);
        std::printf("small bright surface%s: %.1f %% rms, mean off by %+.1f %%, a texel has %.2f at most\n",
                    has_wall ? " and a wall" : "", 100 * rms, 100 * (found_sum / sum - 1), largest);
        EXPECT_LT(rms, 0.19);
        EXPECT_NEAR(found_sum / sum, 1, 0.05);
    }
}

TEST(ReceiversBake, leavesTheDirectLightOfSunsOut)
{
    // a lamp that is far away is a sun, but for its own light
    BakeScene scene;
    scene.instance_count = 1;
    addRoom(scene.triangles, {0, 0, 0}, {2, 2, 1}, {0.8f, 0.6f, 0.4f}, 0);
    std::erase_if(scene.triangles, [](const Triangle& triangle) { return triangle.normals[0].z < -0.5f; });
    constexpr float kFar = 1000;
    const Float3 to_sun = normalizeOr({1, 0.5f, 2}, {});
    scene.lamps = {sun(-to_sun, 2), pointLamp(to_sun * kFar, Float3{2, 2, 2} * (kFar * kFar))};
    const BakedReceivers all = bakeReceivers(scene, {.texels_per_metre = 12}).value();
    const BakedReceivers direct = bakeReceivers(scene, {.texels_per_metre = 12, .bounces = 0}).value();
    double sum = 0;
    for (size_t i = 0; i < all.texels.size(); ++i)
    {
        ASSERT_EQ(direct.light(i)[0], Float3{});
        const Float3 expected = all.light(i)[1] - direct.light(i)[1];
        ASSERT_NEAR(all.light(i)[0].x, expected.x, 0.005f + 0.02f * expected.x);
        sum += double{expected.x};
    }
    EXPECT_GT(sum / static_cast<double>(all.texels.size()), 0.1);
}

TEST(ReceiversBake, isTheSameForAllThreadsAndEachLightAlone)
{
    BakeScene scene;
    scene.instance_count = 2;
    addHills(scene.triangles, test::kSanitized ? 16 : 64, 0);
    addQuad(scene.triangles, {-0.5f, -0.5f, 1}, {0, 1, 0}, {1, 0, 0}, kGrey, 1, {{0, 0}, {0, 0}});
    for (int i = 0; i < 9; ++i)
        scene.lamps.push_back(
            pointLamp({static_cast<float>(i % 3) - 1, static_cast<float>(i / 3) - 1, 1.5f}, {1, 2, 3}));
    scene.lamps[4].radius = 0.2f;
    scene.mesh_lights = {shineAll(scene, scene.triangles.size() - 2, {1, 1, 1})};
    scene.sky = constantSky({0.5f, 0.75f, 1});
    const BakeSettings settings{.texels_per_metre = test::kSanitized ? 4.0 : 12.0};
    std::vector<BakedReceivers> baked;
    for (const size_t threads : {size_t{1}, size_t{2}, size_t{3}})
    {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        baked.push_back(bakeReceivers(scene, settings).value());
    }
    for (const BakedReceivers& other : baked)
        EXPECT_EQ(other.irradiance, baked[0].irradiance);
    BakeScene alone = scene;
    alone.lamps = {scene.lamps[8]};
    alone.mesh_lights.clear();
    alone.sky.reset();
    const BakedReceivers last = bakeReceivers(alone, settings).value();
    ASSERT_EQ(last.texels.size(), baked[0].texels.size());
    for (size_t i = 0; i < last.texels.size(); ++i)
    {
        const Float3 difference = last.light(i)[0] - baked[0].light(i)[8];
        ASSERT_LE(length(difference), 0.005f * length(last.light(i)[0]));
    }
}

TEST(ReceiversBake, tellsWhyAnInstanceHasNoTexels)
{
    BakeScene scene = makeFloor();
    addQuad(scene.triangles, {-2, -2, 3}, {4, 0, 0}, {0, 4, 0}, kGrey, 0);
    const BakedReceivers baked = bakeReceivers(scene, {}).value();
    EXPECT_EQ(baked.rectangles[0].uvs.use, UvUse::overlapping);
    EXPECT_NEAR(baked.rectangles[0].uvs.share, 1, 0.01);
    EXPECT_EQ(baked.rectangles[0].size, RectangleSize{});
    EXPECT_TRUE(baked.texels.empty());
}

TEST(Dilation, continuesChartsByTwoTexels)
{
    const std::vector<TexelCell> texels{{0, 0}, {5, 5}, {6, 5}};
    const std::vector<TexelCopy> copies = dilate(12, 12, texels);
    for (int32_t y = -1; y < 13; ++y)
        for (int32_t x = -1; x < 13; ++x)
        {
            int32_t nearest = 99;
            for (const TexelCell& texel : texels)
                nearest = std::min(nearest, std::max(std::abs(texel.x - x), std::abs(texel.y - y)));
            const auto copy = std::ranges::find_if(copies, [&](const TexelCopy& found)
                                                   { return found.cell.x == x && found.cell.y == y; });
            ASSERT_EQ(copy != copies.end(), nearest > 0 && nearest <= 2) << x << ", " << y;
            if (copy == copies.end())
                continue;
            const TexelCell source = texels[copy->source];
            ASSERT_EQ(std::max(std::abs(source.x - x), std::abs(source.y - y)), nearest);
        }
}

} // namespace hearth::receivers

// Compares global illumination of bricks with closed forms: furnaces, sealed rooms, planes, plates, and
// lights that go out.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/cook/bricks/lit_bricks.h"
#include "tests/support/sanitized.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <tbb/global_control.h>

namespace hearth::bricks
{
namespace
{

using namespace shared;

constexpr float kPi = 3.14159265f;
constexpr uint32_t kUp = 3;

// ---- the furnace

class Furnace : public ::testing::TestWithParam<float>
{
};

/// For any shape, voxel size and ray direction.
TEST_P(Furnace, goesToEmissionOverOneLessAlbedo)
{
    const float albedo = GetParam();
    const Float3 emission{0.7f, 0.3f, 1.1f};
    const struct
    {
        std::array<uint32_t, 3> inside;
        float voxel_size;
    } shapes[] = {{{2, 2, 2}, 1}, {{1, 1, 1}, 0.03f}, {{9, 2, 5}, 0.25f}, {{3, 14, 1}, 7}};
    for (const auto& shape : shapes)
    {
        const Room room(shape.inside, makeVoxel({albedo, albedo, albedo}, emission), shape.voxel_size);
        const BrickView view = makeBrickView(room.tables);
        FaceLighting lighting(view);
        SceneLighting outside = constantSky({5, 5, 5});
        addSun(outside, {1, -2, 0.5f}, {30, 30, 30});
        lighting.sweep(outside, 16, sweepsToDecay(albedo, 1e-3f));
        const float exact = decodeAlbedo(encodeAlbedo({albedo, albedo, albedo})).x;
        const Float3 expected = decodeRadiance(encodeRadiance(emission)) / (1 - exact);
        const std::vector<uint32_t> codes = lighting.codes();
        for (const LitFace& position : room.inner)
        {
            expectRelative(computeRadiance(lighting, position.face), expected, 2e-3f);
            // stored codes add half of a step: 1/128, for blue 1/64
            expectRelative(decodeRadiance(codes[position.face]), expected, 0.018f);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(albedos, Furnace, ::testing::Values(0.2f, 0.5f, 0.8f, 0.9f));

/// Grey stays grey over 64 bounces, although blue has coarser steps.
TEST(BrickLight, doesNotDriftInHue)
{
    const Room room({3, 3, 3}, makeVoxel({0.85f, 0.85f, 0.85f}, {0.37f, 0.37f, 0.37f}));
    BrickTables tables = room.tables;
    const BrickView view = makeBrickView(tables);
    FaceLighting lighting(view);
    lighting.sweep(darkness(), 16, 64);
    const Float3 emission = decodeRadiance(tables.emission[0]);
    for (const LitFace& position : room.inner)
    {
        const Float3 light = computeRadiance(lighting, position.face);
        EXPECT_NEAR(light.z / light.x, emission.z / emission.x, 1e-3f);
        EXPECT_NEAR(light.y / light.x, 1, 1e-3f);
    }
}

TEST(BrickLight, emissionFollowsTheExposure)
{
    const Room room({3, 3, 3}, makeVoxel({0, 0, 0}, {4, 8, 16}));
    const BrickView view = makeBrickView(room.tables);
    FaceLighting lighting(view);
    SceneLighting dimmed = darkness();
    dimmed.exposure = 0.25f;
    lighting.sweep(dimmed, 4, 1);
    for (const LitFace& position : room.inner)
        EXPECT_NEAR(computeRadiance(lighting, position.face).y, 2, 0.01f);
}

// ---- leaks

/// Rounding leaks no light either, for any position of sun and lamps, and for any normals of the surfaces.
TEST(FaceLighting, aSealedRoomIsExactlyDark)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<float> number(-1, 1);
    for (int i = 0; i < 6; ++i)
    {
        Voxel wall = makeVoxel({0.9f, 0.9f, 0.9f});
        for (VoxelSide& side : wall.sides)
            if (i % 2 == 1)
                side.normal = {number(random), number(random), number(random)};
        const Room room({3 + static_cast<uint32_t>(i), 4, 2}, wall, 0.5f);
        const BrickView view = makeBrickView(room.tables);
        FaceLighting lighting(view);
        SceneLighting outside = constantSky({3, 4, 5});
        for (int sun = 0; sun < 20; ++sun)
            addSun(outside, {number(random), number(random), number(random)}, {50, 40, 30});
        addSun(outside, {0, -1, 0}, {50, 40, 30});
        addSun(outside, {1, 0, 0}, {50, 40, 30});
        addSun(outside, {1, -1, 1}, {50, 40, 30});
        // in the air beside a wall: the wall's outer side is at z = 0.5 + 0.5
        addLamp(outside, {-1.5f, 6.5f, 0.99f}, {90, 90, 90});
        lighting.sweep(outside, 16, 4);
        float outer = 0;
        for (const BrickLight& face : lighting.faces())
            outer = std::max(outer, largest(decodeBrickLight(face)));
        EXPECT_GT(outer, 1) << "the light is on";
        for (const LitFace& position : room.inner)
        {
            EXPECT_EQ(lighting.faces()[position.face].code, 0u);
            EXPECT_EQ(lighting.faces()[position.face].rest, 0u);
        }
        // and a surface in the room receives no light: its point lies in the wall
        const Sky sky{{3, 4, 5}, {3, 4, 5}, {3, 4, 5}};
        const BrickStart start = brickSurfaceStart(lighting.scene(), {3.3f, 1.6f, 3.1f}, {0, 1, 0});
        EXPECT_EQ(start.is_interior, 0u);
        EXPECT_EQ(largest(brickGather(lighting.scene(), sky, start, 256, 5)), 0);
    }
}

// ---- a light that goes out

class Decay : public ::testing::TestWithParam<float>
{
};

TEST_P(Decay, isBelowOneHundredthInTheStatedFrames)
{
    const float albedo = GetParam();
    constexpr uint32_t kPeriod = 3, kRays = 8;
    const Room room({4, 3, 4}, makeVoxel({albedo, albedo, albedo}));
    const BrickView view = makeBrickView(room.tables);
    FaceLighting lighting(view);
    SceneLighting lit = darkness();
    addLamp(lit, {0.6f, 8.4f, 3.3f}, {40, 30, 20});
    const uint32_t sweeps = sweepsToDecay(albedo, 0.01f);
    // lit until nothing changes; the frames after that begin in the middle of a period
    for (uint32_t frame = 0; frame < 3 * kPeriod * sweeps + 1; ++frame)
        lighting.light(lit, {.period = kPeriod, .rays = kRays});
    const auto brightest = [&]
    {
        float most = 0;
        for (const LitFace& position : room.inner)
            most = std::max(most, largest(computeRadiance(lighting, position.face)));
        return most;
    };
    const float before = brightest();
    ASSERT_GT(before, 0.1f);
    float late = before;
    for (uint32_t frame = 0; frame < kPeriod * sweeps; ++frame)
    {
        lighting.light(darkness(), {.period = kPeriod, .rays = kRays});
        if (frame + 1 == kPeriod * sweeps / 3)
            late = brightest();
    }
    EXPECT_LT(brightest(), 0.01f * before);
    if (albedo > 0.5f)
    {
        EXPECT_GT(late, 0.01f * before) << "the bound means something";
    }
}

INSTANTIATE_TEST_SUITE_P(albedos, Decay, ::testing::Values(0.1f, 0.5f, 0.8f, 0.9f));

TEST(SweepsToForget, areThoseOfThePowersOfTheAlbedo)
{
    EXPECT_EQ(sweepsToDecay(0, 0.01f), 1u);
    EXPECT_EQ(sweepsToDecay(0.5f, 0.01f), 7u);
    EXPECT_EQ(sweepsToDecay(0.8f, 0.01f), 21u);
    EXPECT_EQ(sweepsToDecay(0.9f, 0.01f), 44u);
    EXPECT_EQ(sweepsToDecay(1, 0.01f), 90u) << "no face returns more than 95 %";
}

// ---- direct light and the sky

/// Floor of `side` x `side` voxels at height 1, with air above.
BrickTables makeFloor(uint32_t side, uint32_t height, const Voxel& voxel, float voxel_size = 1)
{
    VoxelModel model({side, height, side}, voxel_size);
    model.fill({0, 0, 0}, {side, 1, side}, voxel);
    return model.build();
}

TEST(FaceLighting, sunOnAPlaneIsItsCosine)
{
    const BrickTables tables = makeFloor(20, 8, makeVoxel({0.5f, 0.5f, 0.5f}));
    const float albedo = decodeAlbedo(tables.albedo[0]).x;
    const BrickView view = makeBrickView(tables);
    FaceLighting lighting(view);
    SceneLighting sun = darkness();
    addSun(sun, {0.3f, -0.8f, 0.4f}, {3, 2, 1});
    lighting.sweep(sun, 4, 1);
    const float cosine = -sun.lights[0].direction.y;
    for (const LitFace& position : facesIn(tables, {0, 1, 0}, {20, 2, 20}))
        expectRelative(computeRadiance(lighting, position.face), Float3{3, 2, 1} * (albedo * cosine / kPi),
                       1e-3f);
}

/// Voxels that are not opaque transmit the rest of the light.
TEST(FaceLighting, whatIsNotOpaqueStopsItsShare)
{
    VoxelModel model({9, 9, 9});
    model.fill({0, 0, 0}, {9, 1, 9}, makeVoxel({0.5f, 0.5f, 0.5f}));
    model.fill({0, 6, 0}, {9, 7, 9}, makeVoxel({0, 0, 0}, {}, 102)); // 0.4
    const BrickTables tables = model.build();
    const float albedo = decodeAlbedo(tables.albedo[faceAt(tables, 4, 0, 4, kUp)]).x;
    const BrickView view = makeBrickView(tables);
    FaceLighting lighting(view);
    SceneLighting sun = darkness();
    addSun(sun, {0, -1, 0}, {1, 1, 1});
    lighting.sweep(sun, 4, 1);
    expectRelative(computeRadiance(lighting, faceAt(tables, 4, 0, 4, kUp)),
                   Float3{1, 1, 1} * (0.6f * albedo / kPi), 2e-3f);
}

TEST(FaceLighting, aLampOverAPlaneFollowsTheInverseSquare)
{
    constexpr float kSize = 0.25f;
    VoxelModel model({32, 16, 32}, kSize);
    model.fill({0, 0, 0}, {32, 1, 32}, makeVoxel({0.5f, 0.5f, 0.5f}));
    // casts a shadow on the voxels behind it
    model.fill({20, 5, 14}, {21, 6, 18}, makeVoxel({0.5f, 0.5f, 0.5f}));
    const BrickTables tables = model.build();
    const float albedo = decodeAlbedo(tables.albedo[0]).x;
    const BrickView view = makeBrickView(tables);
    FaceLighting lighting(view);
    SceneLighting lit = darkness();
    const Float3 lamp{4, 2.3f, 4};
    addLamp(lit, lamp, {5, 5, 5}, 6);
    lighting.sweep(lit, 4, 1);
    uint32_t shadowed = 0;
    for (const LitFace& position : facesIn(tables, {0, 1, 0}, {32, 2, 32}))
    {
        const Float3 middle = brickFaceMiddle(position.x, position.y, position.z, position.side) * kSize;
        const float d = length(lamp - middle);
        const float window = 1 - std::pow(d / 6, 4.0f);
        const float expected = albedo * 5 / kPi * (lamp.y - middle.y) / (d * d * d) * window;
        const float value = computeRadiance(lighting, position.face).x;
        if (value == 0)
        {
            ++shadowed;
            EXPECT_GT(position.x, 20u);
        }
        else
            EXPECT_NEAR(value, expected, 2e-3f * expected + 1e-6f);
    }
    EXPECT_GT(shadowed, 8u);
    EXPECT_EQ(computeRadiance(lighting, faceAt(tables, 25, 0, 16, kUp)).x, 0);
}

/// The lamp stands in its own shade, which fills its voxel, but still lights downwards.
TEST(FaceLighting, aLampInsideItsOwnVoxelIsSeen)
{
    VoxelModel model({11, 11, 11});
    model.fill({0, 0, 0}, {11, 1, 11}, makeVoxel({0.5f, 0.5f, 0.5f}));
    model.fill({5, 8, 5}, {6, 10, 6}, makeVoxel({0.5f, 0.5f, 0.5f}));
    const BrickTables tables = model.build();
    const BrickView view = makeBrickView(tables);
    FaceLighting lighting(view);
    SceneLighting lit = darkness();
    addLamp(lit, {5.5f, 8.1f, 5.5f}, {5, 5, 5});
    lighting.sweep(lit, 4, 1);
    for (uint32_t x = 0; x < 11; ++x)
        EXPECT_GT(computeRadiance(lighting, faceAt(tables, x, 0, 5, kUp)).x, 0) << x;
}

/// A slanted plane close to a lamp passes through the middle of its voxels on average, not along their sides.
TEST(FaceLighting, aLampBesideASlopeLightsThePlaneNotItsSteps)
{
    constexpr uint32_t kSide = 24;
    const Float3 normal = normalizeOr({-1, 1, 0}, {0, 1, 0});
    Voxel slope = makeVoxel({0.5f, 0.5f, 0.5f});
    for (VoxelSide& side : slope.sides)
    {
        side.normal = normal;
        side.depth = 0.5f;
    }
    VoxelModel model({kSide, kSide, kSide});
    for (uint32_t x = 0; x < kSide; ++x)
        model.fill({x, x, 0}, {x + 1, x + 1, kSide}, slope);
    const BrickTables tables = model.build();
    const BrickView view = makeBrickView(tables);
    FaceLighting lighting(view);
    SceneLighting lit = darkness();
    constexpr float kAway = 3;
    const Float3 foot{12.5f, 12.5f, 12.5f}, lamp = foot + normal * kAway;
    addLamp(lit, lamp, {5, 5, 5});
    lighting.sweep(lit, 1, 1);
    for (const uint32_t side : {kUp, 0u})
    {
        const float light = computeRadiance(lighting, faceAt(tables, 12, 12, 12, side)).x;
        const float expected = 0.5f * 5 / kPi / (kAway * kAway);
        EXPECT_NEAR(light, expected, 0.01f * expected) << side;
    }
}

/// A shade just beyond a lamp's radius is lit at its own distance, wherever it lies in its voxels.
TEST(FaceLighting, aShadeNearALampIsLitAtItsDepth)
{
    constexpr float kVoxelSize = 0.1f;
    for (const float depth : {0.0f, 0.25f, 0.75f})
    {
        Voxel shade = makeVoxel({0.5f, 0.5f, 0.5f});
        for (VoxelSide& side : shade.sides)
            side.depth = depth;
        VoxelModel model({7, 7, 7}, kVoxelSize);
        model.fill({0, 0, 0}, {7, 1, 7}, shade);
        const BrickTables tables = model.build();
        const BrickView view = makeBrickView(tables);
        FaceLighting lighting(view);
        SceneLighting lit = darkness();
        // 0.15 m above the upper side of the voxels
        addLamp(lit, Float3{3.5f, 2.5f, 3.5f} * kVoxelSize, {5, 5, 5});
        lighting.sweep(lit, 4, 1);
        const float away = (1.5f + depth) * kVoxelSize;
        const float expected = 0.5f * 5 / kPi / (away * away);
        EXPECT_NEAR(computeRadiance(lighting, faceAt(tables, 3, 0, 3, kUp)).x, expected, 0.02f * expected)
            << depth;
    }
}

/// A slope of voxel steps is lit as the plane that it represents, by its normal.
TEST(FaceLighting, aSlopeIsNotLitAsAStaircase)
{
    constexpr uint32_t kSide = 24;
    const Float3 normal = normalizeOr({-0.5f, 1, 0}, {0, 1, 0});
    Voxel slope = makeVoxel({0.5f, 0.5f, 0.5f});
    for (VoxelSide& side : slope.sides)
        side.normal = normal;
    VoxelModel model({kSide, kSide, kSide});
    for (uint32_t x = 0; x < kSide; ++x)
        model.fill({x, x / 2, 0}, {x + 1, x / 2 + 1, kSide}, slope);
    const BrickTables tables = model.build();
    const BrickView view = makeBrickView(tables);
    FaceLighting lighting(view);
    SceneLighting sun = darkness();
    addSun(sun, {0.2f, -1, 0.1f}, {2, 2, 2});
    lighting.sweep(sun, 16, 1);
    const float expected = 2 * 0.5f / kPi * -dot(normal, sun.lights[0].direction);
    for (uint32_t x = 4; x < kSide - 4; ++x)
        EXPECT_NEAR(computeRadiance(lighting, faceAt(tables, x, x / 2, 12, kUp)).x, expected,
                    0.02f * expected)
            << x;
}

TEST(FaceLighting, spotsEndAtTheirCone)
{
    const BrickTables tables = makeFloor(21, 12, makeVoxel({0.5f, 0.5f, 0.5f}));
    const float albedo = decodeAlbedo(tables.albedo[0]).x;
    const BrickView view = makeBrickView(tables);
    FaceLighting lighting(view);
    SceneLighting lit = darkness();
    addLamp(lit, {10.5f, 11, 10.5f}, {100, 100, 100});
    Light& spot = lit.lights[0];
    spot.type = kLightSpot;
    spot.direction = {0, -1, 0};
    const float inner = std::cos(0.2f), outer = std::cos(0.5f);
    spot.cone_scale = 1 / (inner - outer);
    spot.cone_offset = -outer * spot.cone_scale;
    lighting.sweep(lit, 4, 1);
    for (uint32_t x = 0; x < 21; ++x)
    {
        const Float3 way = Float3{static_cast<float>(x) + 0.5f, 1.002f, 10.5f} - spot.position;
        const float d = length(way), cosine = -way.y / d;
        const float cone = std::clamp((cosine - outer) / (inner - outer), 0.0f, 1.0f);
        const float expected = albedo * 100 / kPi * cosine / (d * d) * cone * cone;
        EXPECT_NEAR(computeRadiance(lighting, faceAt(tables, x, 0, 10, kUp)).x, expected,
                    2e-3f * expected + 1e-6f)
            << x;
    }
}

TEST(FaceLighting, aConstantSkyLightsAnOpenPlaneByItsRadiance)
{
    const BrickTables tables = makeFloor(12, 6, makeVoxel({0.5f, 0.25f, 0.75f}));
    const BrickView view = makeBrickView(tables);
    FaceLighting lighting(view);
    lighting.sweep(constantSky({2, 2, 2}), 16, 1);
    const uint32_t face = faceAt(tables, 6, 0, 6, kUp);
    expectRelative(computeRadiance(lighting, face), decodeAlbedo(tables.albedo[face]) * 2, 1e-3f);
    const Sky sky{{2, 2, 2}, {2, 2, 2}, {2, 2, 2}};
    const BrickStart start = brickSurfaceStart(lighting.scene(), {6.5f, 0.8f, 6.5f}, {0, 1, 0});
    expectRelative(brickGather(lighting.scene(), sky, start, 16, 1), {2, 2, 2}, 1e-5f);
}

// ---- light between faces

/// Form factor from a point to a parallel square of half side a, centred above the point at distance 1.
/// source  any table of view factors: four times a quarter of the square
double toSquare(double a)
{
    const double s = std::sqrt(1 + a * a);
    return 4 / (2 * 3.14159265358979) * 2 * (a / s) * std::atan(a / s);
}

TEST(FaceLighting, parallelPlatesExchangeByTheirFormFactor)
{
    constexpr uint32_t kSide = 17, kGap = 14;
    VoxelModel model({kSide, kGap + 2, kSide});
    model.fill({0, 0, 0}, {kSide, 1, kSide}, makeVoxel({0.5f, 0.5f, 0.5f}));
    model.fill({0, kGap + 1, 0}, {kSide, kGap + 2, kSide}, makeVoxel({0, 0, 0}, {2, 2, 2}));
    const BrickTables tables = model.build();
    const BrickView view = makeBrickView(tables);
    FaceLighting lighting(view);
    lighting.sweep(darkness(), test::kSanitized ? 1024 : 4096, 2);
    const uint32_t face = faceAt(tables, 8, 0, 8, kUp);
    const float albedo = decodeAlbedo(tables.albedo[face]).x;
    const double expected = 2 * toSquare(0.5 * kSide / kGap);
    EXPECT_NEAR(computeRadiance(lighting, face).x / albedo, expected, 0.01 * expected);
}

TEST(FaceLighting, aRedWallReddensTheFloorBesideIt)
{
    VoxelModel model({16, 12, 16});
    model.fill({0, 0, 0}, {16, 1, 16}, makeVoxel({0.7f, 0.7f, 0.7f}));
    model.fill({0, 1, 0}, {1, 12, 16}, makeVoxel({0.8f, 0.1f, 0.1f}));
    const BrickTables tables = model.build();
    const BrickView view = makeBrickView(tables);
    FaceLighting lighting(view);
    SceneLighting sun = darkness();
    addSun(sun, {-1, -1, 0}, {3, 3, 3});
    lighting.sweep(sun, 64, 4);
    const auto redness = [&](uint32_t x)
    {
        const Float3 light = computeRadiance(lighting, faceAt(tables, x, 0, 8, kUp));
        return light.x / light.y;
    };
    EXPECT_GT(redness(1), 1.1f);
    EXPECT_GT(redness(1), redness(6));
    EXPECT_GT(redness(6), redness(13));
}

// ---- threads

TEST(FaceLighting, isTheSameForAnyNumberOfThreads)
{
    const Room room({9, 7, 11}, makeVoxel({0.6f, 0.5f, 0.4f}, {0.1f, 0, 0.2f}));
    const BrickView view = makeBrickView(room.tables);
    SceneLighting lit = constantSky({1, 2, 3});
    addLamp(lit, {1, 9, 6}, {9, 9, 9});
    const auto run = [&](size_t threads)
    {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        FaceLighting lighting(view);
        for (int frame = 0; frame < 20; ++frame)
            lighting.light(lit, {.period = 4, .rays = 8});
        return lighting.codes();
    };
    EXPECT_EQ(run(1), run(4));
}

} // namespace
} // namespace hearth::bricks

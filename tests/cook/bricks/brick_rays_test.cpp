// Tests lighting rays and the stored light of faces: directions, starts, the sky, and codes with their
// remainders.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/cook/bricks/lit_bricks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hearth::bricks
{
namespace
{

using namespace shared;

/// The remainder is necessary: codes alone stop short of the limit.
TEST(BrickLight, codesAloneWouldStopTheFurnaceShort)
{
    const float albedo = 0.9f, emission = 0.3f;
    float code_only = 0;
    BrickLight light{0, 0};
    for (int sweep = 0; sweep < 400; ++sweep)
    {
        code_only = decodeRadiance(encodeRadiance(Float3{1, 1, 1} * (emission + albedo * code_only))).z;
        light = encodeBrickLight(Float3{1, 1, 1} * (emission + albedo * decodeBrickLight(light).z));
    }
    EXPECT_LT(code_only, 0.95f * emission / (1 - albedo));
    EXPECT_NEAR(decodeBrickLight(light).z, emission / (1 - albedo), 1e-3f);
}

TEST(BrickLight, keepsValuesToSixteenBits)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<float> power(-13.9f, 15.9f);
    for (int i = 0; i < 100000; ++i)
    {
        const Float3 value{std::exp2(power(random)), std::exp2(power(random)), std::exp2(power(random))};
        const BrickLight light = encodeBrickLight(value);
        ASSERT_EQ(light.code, encodeRadiance(value));
        const Float3 back = decodeBrickLight(light);
        for (int c = 0; c < 3 && largest(value) < 64000; ++c)
            ASSERT_NEAR(back[c], value[c], value[c] * 3.2e-5f);
    }
    EXPECT_EQ(decodeBrickLight({encodeRadiance({0.3f, 2, 7}), 0}),
              decodeRadiance(encodeRadiance({0.3f, 2, 7})))
        << "no rest: the code itself";
    EXPECT_EQ(decodeBrickLight(encodeBrickLight({0, 0, 0})), (Float3{}));
    EXPECT_EQ(decodeBrickLight(encodeBrickLight({1e9f, 1e9f, 1e9f})).x,
              kMaxRadianceRedGreen * (1 + 0.5f / 127))
        << "what is too bright is the brightest";
}

TEST(BrickRayDirection, areUnitAndByTheCosine)
{
    std::mt19937 random(11);
    std::normal_distribution<float> number;
    for (int i = 0; i < 50; ++i)
    {
        const Float3 n = normalizeOr({number(random), number(random), number(random)}, {0, 0, 1});
        constexpr uint32_t kCount = 64;
        Float3 sum;
        for (uint32_t ray = 0; ray < kCount; ++ray)
        {
            const Float3 d = brickRayDirection(n, ray, kCount, static_cast<uint32_t>(random()));
            EXPECT_NEAR(length(d), 1, 2e-6f);
            EXPECT_GE(dot(d, n), -1e-6f);
        }
        const auto seed = static_cast<uint32_t>(random());
        for (uint32_t ray = 0; ray < kCount; ++ray)
            sum += brickRayDirection(n, ray, kCount, seed) * (1.0f / kCount);
        EXPECT_NEAR(length(sum - n * (2.0f / 3)), 0, 0.03f);
    }
}

TEST(BrickSurfaceStart, leavesItsOwnVoxelsAndSaysWhereThereIsNoAir)
{
    VoxelModel model({8, 16, 8});
    model.fill({0, 0, 0}, {8, 2, 8}, makeVoxel({0.5f, 0.5f, 0.5f}));
    model.fill({0, 8, 0}, {8, 16, 8}, makeVoxel({0.5f, 0.5f, 0.5f}));
    const BrickTables tables = model.build();
    const BrickView view = makeBrickView(tables);
    const FaceLighting lighting(view);
    const BrickScene scene = lighting.scene();
    EXPECT_NEAR(brickSurfaceStart(scene, {4.5f, 0.7f, 4.5f}, {0, 1, 0}).position.y, 2, 0.01f);
    EXPECT_NEAR(brickSurfaceStart(scene, {4.5f, 8.2f, 4.5f}, {0, -1, 0}).position.y, 8, 0.01f);
    EXPECT_NEAR(brickSurfaceStart(scene, {4.5f, 3, 4.5f}, {0, 1, 0}).position.y, 3, 0.01f)
        << "in the air already";
    EXPECT_NEAR(brickSurfaceStart(scene, {4.5f, 1.7f, 4.5f}, {0.6f, 0.8f, 0}).position.y,
                2 + 0.8f * kBrickLift, 0.01f)
        << "slanted: off its steps";
    EXPECT_EQ(brickSurfaceStart(scene, {4.5f, 9, 4.5f}, {0, 1, 0}).is_interior, 1u);
    EXPECT_EQ(brickSurfaceStart(scene, {4.5f, 15.5f, 4.5f}, {0, 1, 0}).is_interior, 0u)
        << "above the grid is air";
    EXPECT_EQ(brickSurfaceStart(scene, {40, 90, 4}, {0, 1, 0}).is_interior, 0u) << "as is what lies outside";
}

/// A point of a wall just below a ceiling that fills its voxels only in part: points along its normal and far
/// along the ray to the eye are not in the air, but near the start of that ray there is air.
TEST(BrickSeenStart, takesTheAirThatAPointIsSeenThrough)
{
    VoxelModel model({12, 12, 12});
    model.fill({0, 0, 0}, {12, 12, 1}, makeVoxel({0.5f, 0.5f, 0.5f})); // the wall
    model.fill({0, 8, 0}, {12, 9, 12}, makeVoxel({0.5f, 0.5f, 0.5f})); // the ceiling
    const BrickTables tables = model.build();
    const BrickView view = makeBrickView(tables);
    const FaceLighting lighting(view);
    const Float3 to_eye{0, -6, 8};
    const BrickStart start = brickVisibleStart(lighting.scene(), {6.5f, 8.3f, 1}, {0, 0, 1}, to_eye);
    EXPECT_EQ(start.is_interior, 0u);
    EXPECT_EQ(start.normal, (Float3{0, 0, 1}));
    EXPECT_NEAR(start.position.y, 8, 0.7f);
    EXPECT_LT(start.position.y, 8);
    const BrickStart open = brickVisibleStart(lighting.scene(), {6.5f, 4.5f, 0.9f}, {0, 0, 1}, to_eye);
    EXPECT_NEAR(open.position.y, 4.5f, 1e-5f) << "before it, where nothing is in the way";
    EXPECT_NEAR(open.position.z, 1, 0.01f);
}

/// In a narrow wedge there is air only far along the way to the eye; beyond the eye it does not count.
TEST(BrickSeenStart, goesAsFarAsTheEye)
{
    VoxelModel model({12, 12, 12});
    model.fill({0, 0, 0}, {9, 12, 12}, makeVoxel({0.5f, 0.5f, 0.5f}));
    const BrickTables tables = model.build();
    const BrickView view = makeBrickView(tables);
    const FaceLighting lighting(view);
    const BrickStart start = brickVisibleStart(lighting.scene(), {1.5f, 6.5f, 6.5f}, {0, 1, 0}, {10, 0, 0});
    EXPECT_EQ(start.is_interior, 0u);
    EXPECT_NEAR(start.position.x, 9, 0.1f);
    EXPECT_EQ(start.normal, (Float3{0, 1, 0}));
    EXPECT_EQ(brickVisibleStart(lighting.scene(), {1.5f, 6.5f, 6.5f}, {0, 1, 0}, {5, 0, 0}).is_interior, 1u);
}

/// A ray seems to come from the surface point itself, whatever the height of its start; it passes no wall.
TEST(BrickRayOrigin, liesOnTheLineThroughTheSurface)
{
    VoxelModel model({12, 12, 12});
    model.fill({0, 0, 0}, {12, 1, 12}, makeVoxel({0.5f, 0.5f, 0.5f}));
    model.fill({7, 1, 0}, {8, 12, 12}, makeVoxel({0.5f, 0.5f, 0.5f}));
    const BrickTables tables = model.build();
    const BrickView view = makeBrickView(tables);
    const FaceLighting lighting(view);
    const Float3 surface{5.5f, 0.25f, 6.5f};
    const BrickStart start = brickSurfaceStart(lighting.scene(), surface, {0, 1, 0});
    const Float3 left{-0.6f, 0.8f, 0};
    const Float3 origin = brickRayOrigin(lighting.scene(), start, left);
    EXPECT_NEAR(origin.y, start.position.y, 1e-5f);
    EXPECT_NEAR(length(cross(origin - surface, left)), 0, 1e-4f);
    const Float3 flat = normalizeOr({0.9f, 0.1f, 0}, {});
    EXPECT_EQ(brickRayOrigin(lighting.scene(), start, flat), start.position) << "the wall is in the way";
}

/// An emissive strip of one voxel on a wall: rays that started off the wall would pass it.
TEST(BrickFaceStart, seesWhatStandsBesideItOnAWall)
{
    VoxelModel model({65, 10, 6});
    model.fill({0, 0, 0}, {65, 10, 1}, makeVoxel({0, 0, 0}));
    model.fill({0, 8, 1}, {65, 9, 2}, makeVoxel({0, 0, 0}, {2, 2, 2}));
    const BrickTables tables = model.build();
    const BrickView view = makeBrickView(tables);
    FaceLighting lighting(view);
    lighting.sweep(darkness(), 1, 1);
    for (uint32_t below = 1; below <= 4; ++below)
    {
        const BrickStart start = brickFaceStart(lighting.scene(), 32, 8 - below, 0, 5, {0, 0, 1},
                                                brickFaceSurface(32, 8 - below, 0, 5, 0));
        const float light = brickGather(lighting.scene(), {}, start, 4096, below).x;
        // an endless strip of height 1 occludes this share of the plane that it stands on
        const double distance = below - 0.5;
        const double expected = 2 * 0.5 * (1 - distance / std::sqrt(distance * distance + 1));
        EXPECT_NEAR(light, expected, 0.03 * expected) << below;
    }
}

} // namespace
} // namespace hearth::bricks

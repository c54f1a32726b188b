// Compares rays that march side by side (SIMD lanes) with the same rays one after the other, and the light
// that they return.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/light/face_lighting.h"
#include "cook/bricks/light/march_lanes.h"
#include "tests/support/march_rays.h"

#include <gtest/gtest.h>

#include <bit>

namespace hearth::bricks
{

using namespace shared;
using test::MarchRays;
using test::MarchScene;

namespace
{

/// Compare two rays. The position of a ray that is not in a voxel is undefined, so it is not compared.
void expectSame(const BrickRay& found, const BrickRay& truth)
{
    ASSERT_EQ(found.inside, truth.inside);
    ASSERT_EQ(found.steps, truth.steps);
    ASSERT_EQ(found.face, truth.face);
    ASSERT_EQ(std::bit_cast<uint32_t>(found.t), std::bit_cast<uint32_t>(truth.t));
    if (truth.inside == 0)
        return;
    ASSERT_EQ(found.x, truth.x);
    ASSERT_EQ(found.y, truth.y);
    ASSERT_EQ(found.z, truth.z);
    ASSERT_EQ(found.brick, truth.brick);
    ASSERT_EQ(found.bit, truth.bit);
}

std::vector<BrickRay> makeRays(const MarchScene& scene, size_t count, std::mt19937& random)
{
    MarchRays make(scene, random);
    std::vector<BrickRay> rays;
    for (size_t i = 0; i < count; ++i)
    {
        const test::MarchRay ray = make.next();
        rays.push_back(brickRayInVoxels(scene.model.masks().grid, ray.origin, ray.direction, ray.far));
    }
    return rays;
}

} // namespace

TEST(MarchLanes, findWhatRaysFindOneByOne)
{
    std::mt19937 random(1);
    constexpr test::Cell kGrids[] = {{40, 40, 40}, {5, 7, 9},    {64, 16, 32}, {1, 1, 1},
                                     {100, 3, 50}, {17, 33, 15}, {4, 90, 4},   {31, 31, 65}};
    constexpr uint32_t kCounts[] = {1, 6, 25, 70, 150};
    constexpr size_t kSpans[] = {1, 4, 15, 16, 17, 40, 100, 1000};
    uint32_t hits = 0, rays_in_all = 0;
    for (uint32_t i = 0; i < 60; ++i)
    {
        const MarchScene scene =
            test::randomScene(kGrids[i % std::size(kGrids)], kCounts[i % std::size(kCounts)], random);
        const BrickMasks masks = scene.model.masks();
        const MarchTable table(masks);
        for (const size_t count : kSpans)
        {
            std::vector<BrickRay> truth = makeRays(scene, count, random), found = truth;
            // advance to every voxel that the rays pass
            for (bool some = true; some;)
            {
                for (BrickRay& ray : truth)
                    ray = brickMarch(masks, ray);
                marchRays(table, found);
                some = false;
                for (size_t r = 0; r < count; ++r)
                {
                    expectSame(found[r], truth[r]);
                    if (HasFatalFailure())
                        return;
                    if (truth[r].inside == 0)
                        continue;
                    some = true;
                    ++hits;
                    truth[r] = found[r] = brickSkipVoxel(masks, truth[r]);
                }
            }
            rays_in_all += static_cast<uint32_t>(count);
        }
    }
    EXPECT_GT(hits, rays_in_all / 2);
}

TEST(MarchLanes, leaveRaysThatAreNotInTheGrid)
{
    std::mt19937 random(2);
    const MarchScene scene = test::randomScene({20, 20, 20}, 100, random);
    const BrickGrid grid = scene.model.masks().grid;
    const MarchTable table(scene.model.masks());
    std::vector<BrickRay> rays(50, brickRayInVoxels(grid, {-5, 3, 3}, {-1, 0, 0}, kBrickInfinity));
    marchRays(table, rays);
    for (const BrickRay& ray : rays)
        EXPECT_TRUE(ray.inside == 0 && ray.steps == 0);
    marchRays(table, {});
}

TEST(MarchLanes, endWhateverTheRaysAre)
{
    std::mt19937 random(3);
    const MarchScene scene = test::randomScene({50, 20, 33}, 40, random);
    const BrickMasks masks = scene.model.masks();
    std::vector<BrickRay> rays;
    for (uint32_t i = 0; i < 20000; ++i)
    {
        Float3 direction, origin;
        for (int axis = 0; axis < 3; ++axis)
        {
            const float any = std::bit_cast<float>(static_cast<uint32_t>(random()));
            direction[axis] = std::isfinite(any) ? any : 0;
            origin[axis] = static_cast<float>(random() % 60) - 5;
        }
        rays.push_back(brickRayInVoxels(masks.grid, origin, direction, kBrickInfinity));
    }
    marchRays(MarchTable(masks), rays);
    for (const BrickRay& ray : rays)
        ASSERT_LE(ray.steps, 50u + 20 + 33);
}

TEST(FaceLighting, gathersAsRaysDoOneByOne)
{
    std::mt19937 random(4);
    MarchScene scene = test::randomScene({30, 18, 40}, 600, random);
    test::BrickModel& model = scene.model;
    for (uint8_t& opacity : model.opacity)
        opacity = random() % 3 == 0 ? 255 : static_cast<uint8_t>(1 + random() % 254);
    for (uint32_t& light : model.lighting)
        light = encodeRadiance({static_cast<float>(random() % 64), 1, 2});
    const BrickView view{model.masks(), model.opacity,  model.albedo,
                         model.normals, model.emission, model.lighting};
    const Sky sky{.zenith = {1, 2, 3}, .horizon = {3, 2, 1}, .ground = {}};
    const SceneLighting lighting{.sky = sky, .lights = {}};
    for (const uint32_t rays : {1u, 16u, 300u})
    {
        FaceLighting lit(view);
        const FaceLighting before(view);
        lit.sweep(lighting, rays, 1);
        const std::vector<FaceLocation> places = faceLocations(view.masks);
        for (size_t face = 0; face < places.size(); face += rays)
        {
            const auto [x, y, z, side] = places[face];
            const BrickStart start =
                brickFaceStart(before.scene(), x, y, z, side, decodeFaceNormal(model.normals[face]),
                               brickFaceSurface(x, y, z, side, decodeFaceDepth(model.albedo[face])));
            const Float3 arrived =
                brickGather(before.scene(), sky, start, rays, brickFaceSeed(x, y, z, side));
            const BrickLight truth = encodeBrickLight(brickOutgoingRadiance(
                decodeRadiance(model.emission[face]), decodeAlbedo(model.albedo[face]), arrived));
            ASSERT_EQ(lit.faces()[face].code, truth.code) << face;
            ASSERT_EQ(lit.faces()[face].rest, truth.rest) << face;
        }
    }
}

} // namespace hearth::bricks

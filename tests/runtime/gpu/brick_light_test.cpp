// Tests lighting of brick faces on the device: ray march and iteration against the CPU, and light with known
// answers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/light/face_lighting.h"
#include "formats/codecs/vertex_codec.h"
#include "formats/gpu_shared/brick_codes.h"
#include "runtime/gpu/scene/scene_shading.h"
#include "tests/runtime/gpu/brick_scene.h"
#include "tests/runtime/shaders/test_shaders.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/lit_scene.h"

#include <cmath>
#include <limits>

namespace hearth::test
{

namespace
{

using namespace shared;

/// Ray as in brick_march.comp.
struct TestRay
{
    Float3 origin;
    float far = kBrickInfinity;
    Float3 direction;
    float reserved = 0;
};
struct TestHit
{
    uint32_t inside, x, y, z, face, face_index, distance_bits, steps;
    friend bool operator==(const TestHit&, const TestHit&) = default;
};

TestHit makeHit(const BrickMasks& masks, const BrickRay& ray)
{
    if (ray.inside == 0)
        return {0, 0, 0, 0, 0, 0, 0, ray.steps};
    return {1,
            static_cast<uint32_t>(ray.x),
            static_cast<uint32_t>(ray.y),
            static_cast<uint32_t>(ray.z),
            ray.face,
            brickFace(masks.bricks[ray.brick], ray.bit, ray.face),
            floatBits(brickDistance(masks.grid, ray)),
            ray.steps};
}

/// Solid with this probability, in clumps: some groups and bricks are empty.
auto scattered(uint32_t seed, double share)
{
    return [=](uint32_t x, uint32_t y, uint32_t z)
    {
        const auto at = [&](uint32_t size)
        { return brickRandomUnit(brickFaceSeed(x / size, y / size, z / size + seed, size)); };
        return at(16) < 0.7f && at(4) < 0.6f && static_cast<double>(at(1)) < share;
    };
}

/// Face of random colour; some faces emit light.
FaceLook colourful(std::array<uint32_t, 3> v, uint32_t side)
{
    const uint32_t seed = brickFaceSeed(v[0], v[1], v[2], side);
    const auto unit = [&](uint32_t i) { return brickRandomUnit(brickHash(seed + i)); };
    FaceLook look{{unit(0) * 0.9f, unit(1) * 0.9f, unit(2) * 0.9f}, {}};
    if (unit(3) < 0.05f)
        look.emission = {unit(4), unit(5) * 3, unit(6)};
    return look;
}

/// Random rays: from inside and outside, along axes, from corners and edges.
std::vector<TestRay> randomRays(const BrickGrid& grid, size_t count)
{
    std::mt19937 random(7);
    std::vector<TestRay> rays(count);
    const Float3 size = Float3{float(grid.voxels_x), float(grid.voxels_y), float(grid.voxels_z)};
    for (TestRay& ray : rays)
    {
        Float3 at, along;
        for (int axis = 0; axis < 3; ++axis)
        {
            at[axis] = uniform(random, -0.5f, 1.5f) * size[axis];
            along[axis] = uniform(random, -1, 1);
            if (random() % 4 == 0)
                at[axis] = std::floor(at[axis]);
            if (random() % 8 == 0)
                along[axis] = 0;
        }
        ray.direction = normalizeOr(along, {1, 0, 0});
        ray.origin = grid.origin + at * grid.voxel_size;
        if (random() % 4 == 0)
            ray.far = uniform(random, 0.1f, 20);
    }
    return rays;
}

class BrickLightTest : public GpuTest
{
protected:
    /// Load the model. Adds a triangle far away, since a scene must draw something.
    void load(const BrickModel& model, const gpu::BrickOptions& options = {})
    {
        model_ = model;
        test_.addInstance(test_.addMesh(withMaterial(makeQuad(1, 1), test_.addMaterial(plainMaterial()))),
                          translated({0, -1000, 0}));
        setBricks(test_, model);
        pack_.emplace(test_.build());
        lighting_ = gpu::makeLighting(*pack_);
        scene_ = upload(*pack_, {.bricks = options});
        targets_.emplace(makeTargets(64, 48));
    }

    void drawFrames(uint32_t count, const DrawOptions& more = {})
    {
        DrawOptions options = more;
        options.width = 64;
        options.height = 48;
        for (uint32_t i = 0; i < count; ++i)
            draw(*scene_, *targets_, {.position = {0, 0, 2}}, options);
    }

    std::vector<BrickLight> faces()
    {
        return read<BrickLight>(scene_->bricks->lighting, model_.albedo.size());
    }

    BrickModel model_;
    TestScene test_;
    std::optional<formats::PackView> pack_;
    shared::SceneLighting lighting_{};
    std::unique_ptr<gpu::Scene> scene_;
    std::optional<gpu::FrameTargets> targets_;
};

} // namespace

TEST_F(BrickLightTest, marchesLikeTheCpuToTheBit)
{
    BrickModel model = brickModel({60, 37, 50}, scattered(3, 0.3), colourful);
    model.grid.origin = {-7.3f, 2.1f, 11};
    model.grid.voxel_size = 0.37f;
    load(model);
    drawFrames(1); // fills the view of the bricks
    const std::vector<TestRay> rays = randomRays(model.masks().grid, 8000);

    const gpu::Device& device = renderer().device();
    gpu::MemoryArena arena(device);
    constexpr VkBufferUsageFlags kUsage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                          VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    const gpu::Buffer ray_buffer =
        arena.createBuffer(rays.size() * sizeof(TestRay), kUsage, gpu::MemoryKind::device).value();
    const gpu::Buffer hit_buffer =
        arena.createBuffer(2 * rays.size() * sizeof(TestHit), kUsage, gpu::MemoryKind::device).value();
    const gpu::DrawLayouts layouts = gpu::DrawLayouts::create(device, {}).value();
    const gpu::NumberedSet set_layouts[] = {{shared::kSetBricks, layouts.bricks.get()},
                                            {shared::kSetFreshLight, layouts.fresh_light.get()}};
    const gpu::ComputePipeline pipeline =
        gpu::createComputePipeline(device, shaders::brick_march_comp, set_layouts).value();
    const gpu::UniqueDescriptorPool pool = gpu::createDescriptorPool(device, 1, {.storages = 2}).value();
    const VkDescriptorSet set = gpu::allocateSet(device, pool.get(), layouts.fresh_light.get()).value();
    gpu::DescriptorWriter(set)
        .storage(shared::kFreshLightFaces, hit_buffer)
        .storage(shared::kFreshLightLocations, ray_buffer)
        .write(device);
    std::optional<gpu::Uploader> uploader;
    ASSERT_TRUE(host()
                    .run(
                        [&](VkCommandBuffer commands) -> Status
                        {
                            uploader.emplace(device, commands);
                            HEARTH_TRY(uploader->uploadRecords(ray_buffer, rays));
                            uploader->finish();
                            const VkDescriptorSet sets[] = {scene_->frame().brick_set, set};
                            device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE,
                                                        pipeline.pipeline.get());
                            device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE,
                                                              pipeline.layout.get(), shared::kSetBricks, 2,
                                                              sets, 0, nullptr);
                            device.vk.vkCmdDispatch(commands, uint32_t(rays.size() + 63) / 64, 1, 1);
                            return success();
                        })
                    .ok());
    const std::vector<TestHit> hits = read<TestHit>(hit_buffer, 2 * rays.size());

    const BrickMasks masks = model.masks();
    size_t found = 0;
    for (size_t i = 0; i < rays.size(); ++i)
    {
        BrickRay ray =
            brickMarch(masks, brickRay(masks.grid, rays[i].origin, rays[i].direction, rays[i].far));
        ASSERT_EQ(hits[2 * i], makeHit(masks, ray)) << i;
        found += ray.inside;
        if (ray.inside != 0)
            ray = brickMarch(masks, brickSkipVoxel(masks, ray));
        ASSERT_EQ(hits[2 * i + 1], makeHit(masks, ray)) << i << ", second";
    }
    EXPECT_GT(found, rays.size() / 8);
    EXPECT_LT(found, rays.size() * 7 / 8);
}

TEST_F(BrickLightTest, lightsFacesLikeTheSolver)
{
    BrickModel model = brickModel({20, 18, 22}, scattered(5, 0.4), colourful);
    model.grid.origin = {-2, -1, -3};
    model.grid.voxel_size = 0.25f;
    for (size_t i = 0; i < model.opacity.size(); i += 3)
        model.opacity[i] = static_cast<uint8_t>(40 + i % 200);
    test_.addLight(sun({0.3f, -1, 0.2f}));
    test_.addLight(light(formats::LightType::point, {0.5f, 4, 0.4f}, {0, -1, 0}, 3));
    test_.addLight(light(formats::LightType::spot, {2, 3, 2}, {-1, -1, -0.5f}, 9));
    const uint32_t below = formats::NormalCode<8>::encode({0, -1, 0});
    model.reflectors = {
        {}, {encodeRadiance({3, 2, 1}), below, {0x40206080, 0xFFFF8060, 0x10, 0}, {~0u, ~0u, 0x80FF, 0}}, {}};
    load(model, {.faces_per_frame = model.grid.face_count / 3, .rays = 8});
    const uint32_t period = scene_->bricks->period;
    ASSERT_EQ(period, 3u);

    bricks::FaceLighting solver(makeBrickView(model));
    for (uint32_t frame = 0; frame < 7; ++frame)
    {
        drawFrames(1);
        solver.light(lighting_, {.period = period, .rays = 8});
    }
    const std::vector<BrickLight> gpu_faces = faces();
    size_t alike = 0;
    float most = 0, brightest = 0;
    for (size_t i = 0; i < gpu_faces.size(); ++i)
    {
        const Float3 ours = decodeBrickLight(gpu_faces[i]), its = decodeBrickLight(solver.faces()[i]);
        alike += gpu_faces[i].code == solver.faces()[i].code ? 1u : 0u;
        for (int c = 0; c < 3; ++c)
        {
            most = std::max(most, std::abs(ours[c] - its[c]) / std::max(its[c], 0.05f));
            brightest = std::max(brightest, its[c]);
        }
    }
    EXPECT_GT(brightest, 0.5f);
    // equal up to rounding, which makes some codes differ by one
    EXPECT_LT(most, 0.002f);
    EXPECT_GT(alike, gpu_faces.size() * 99 / 100);
}

TEST_F(BrickLightTest, aFurnaceGoesToItsClosedForm)
{
    constexpr float kEmission = 0.25f;
    constexpr std::array<uint32_t, 3> kVoxels{10, 9, 12};
    for (const float albedo : {0.5f, 0.9f})
    {
        SetUp();
        test_ = TestScene();
        load(brickModel(kVoxels, makeShell(kVoxels),
                        [&](auto, uint32_t) {
                            return FaceLook{{albedo, albedo, albedo}, {kEmission, kEmission, kEmission}};
                        }));
        const float stored = decodeAlbedo(encodeAlbedo({albedo, 0, 0})).x;
        const float goal = kEmission / (1 - stored);
        drawFrames(static_cast<uint32_t>(std::ceil(std::log(0.005) / std::log(double{albedo}))));
        const std::vector<BrickLight> lit = faces();
        const std::vector<FaceLocation> places = faceLocations(model_);
        size_t inside = 0;
        for (size_t i = 0; i < lit.size(); ++i)
        {
            const FaceLocation& at = places[i];
            const bool outwards = at.voxel[at.side / 2] == (at.side % 2 == 0 ? 0 : kVoxels[at.side / 2] - 1);
            if (outwards)
                continue;
            ++inside;
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(decodeRadiance(lit[i].code)[c], goal, 0.02f * goal) << albedo << " face " << i;
        }
        EXPECT_EQ(inside, 2u * (8 * 7 + 8 * 10 + 7 * 10));
    }
}

TEST_F(BrickLightTest, aSealedRoomStaysDarkUnderTheSun)
{
    constexpr std::array<uint32_t, 3> kVoxels{9, 8, 11};
    test_.addLight(sun({0.4f, -1, 0.3f}));
    load(brickModel(kVoxels, makeShell(kVoxels),
                    [](auto, uint32_t) {
                        return FaceLook{{0.8f, 0.8f, 0.8f}, {}};
                    }));
    drawFrames(6);
    const std::vector<BrickLight> lit = faces();
    const std::vector<FaceLocation> places = faceLocations(model_);
    for (size_t i = 0; i < lit.size(); ++i)
    {
        const FaceLocation& at = places[i];
        if (at.voxel[at.side / 2] == (at.side % 2 == 0 ? 0 : kVoxels[at.side / 2] - 1))
            EXPECT_GT(lit[i].code, 0u) << i; // outside faces have at least the sky's light
        else
        {
            ASSERT_EQ(lit[i].code, 0u) << i;
            ASSERT_EQ(lit[i].rest, 0u) << i;
        }
    }
}

TEST_F(BrickLightTest, aLightThatGoesOutIsForgotten)
{
    constexpr std::array<uint32_t, 3> kVoxels{9, 9, 9};
    constexpr float kAlbedo = 0.8f;
    const formats::LightRecord lamp = light(formats::LightType::point, {4.5f, 4.5f, 4.5f}, {0, -1, 0}, 4);
    test_.addLight(lamp);
    load(brickModel(kVoxels, makeShell(kVoxels),
                    [](auto, uint32_t) {
                        return FaceLook{{kAlbedo, kAlbedo, kAlbedo}, {}};
                    }),
         {.faces_per_frame = 200});
    const uint32_t period = scene_->bricks->period;
    ASSERT_GT(period, 2u);
    const std::vector<FaceLocation> places = faceLocations(model_);
    const auto brightest = [&]
    {
        float most = 0;
        const std::vector<BrickLight> lit = faces();
        for (size_t i = 0; i < lit.size(); ++i)
            if (const FaceLocation& at = places[i];
                at.voxel[at.side / 2] != (at.side % 2 == 0 ? 0 : kVoxels[at.side / 2] - 1))
                most = std::max(most, decodeRadiance(lit[i].code).x);
        return most;
    };
    drawFrames(12 * period);
    const float before = brightest();
    EXPECT_GT(before, 0.05f);

    formats::LightRecord out = lamp;
    out.intensity = 0;
    const gpu::LightChange change = gpu::changeLight(*scene_, 0, out).value();
    drawFrames(1, {.lights = {&change, 1}});
    EXPECT_GT(scene_->bricks->quick_frames, 0u);
    const uint32_t sweeps = bricks::sweepsToDecay(kAlbedo, 0.01f);
    EXPECT_GT(brightest(), 0.2f * before);
    drawFrames(sweeps * period);
    EXPECT_LT(brightest(), 0.01f * before);
}

TEST_F(BrickLightTest, emissionChangesInABox)
{
    constexpr std::array<uint32_t, 3> kVoxels{8, 8, 8};
    load(brickModel(kVoxels, makeShell(kVoxels),
                    [](std::array<uint32_t, 3> v, uint32_t) {
                        return FaceLook{{0, 0, 0}, v[1] == 7 ? Float3{1, 1, 1} : Float3{}};
                    }));
    const auto ceilingLight = [&](uint32_t x)
    {
        const std::vector<FaceLocation> places = faceLocations(model_);
        const std::vector<BrickLight> lit = faces();
        for (size_t i = 0; i < places.size(); ++i)
            if (places[i].voxel == std::array<uint32_t, 3>{x, 7, 3} && places[i].side == 2)
                return decodeRadiance(lit[i].code).x;
        return -1.0f;
    };
    const gpu::EmissionScale half{{{0, 0, 0}, {4, 8, 8}}, 0.5f};
    drawFrames(1, {.emission = {&half, 1}});
    EXPECT_FLOAT_EQ(ceilingLight(2), 0.5f);
    EXPECT_FLOAT_EQ(ceilingLight(5), 1);
    drawFrames(1);
    EXPECT_FLOAT_EQ(ceilingLight(2), 1);
}

TEST_F(BrickLightTest, changesOfLightsAreChecked)
{
    test_.addLight(sun({0, -1, 0}));
    load(brickModel({4, 4, 4}, makeShell({4, 4, 4}), colourful));
    EXPECT_EQ(gpu::changeLight(*scene_, 128, sun({0, -1, 0})).error().issue, Issue::usage);
    formats::LightRecord other = sun({0, -1, 0});
    other.type = 3;
    EXPECT_EQ(gpu::changeLight(*scene_, 0, other).error().issue, Issue::usage);
    EXPECT_TRUE(gpu::changeLight(*scene_, 0, light(formats::LightType::point, {}, {0, -1, 0}, 1)).ok());
    formats::LightRecord endless = sun({0, -1, 0});
    endless.intensity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(gpu::changeLight(*scene_, 0, endless).error().issue, Issue::usage);
    EXPECT_TRUE(gpu::changeLight(*scene_, 0, sun({0, -1, 1})).ok());
}

} // namespace hearth::test

// Draws rooms with receivers of baked light, and compares them with live light, with the CPU twin, and among
// all light methods.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/texels/shared_exponent.h"
#include "runtime/pack/receivers/receiver_light.h"
#include "tests/runtime/gpu/brick_scene.h"
#include "tests/runtime/gpu/frame/read_radiance.h"
#include "tests/runtime/gpu/frame/stage_spy.h"
#include "tests/runtime/gpu/lights/all_lights_test.h"
#include "tests/runtime/gpu/receivers/receiver_room.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hearth::test
{

namespace
{

using formats::LightRecord;
using formats::LightType;

constexpr uint32_t kWidth = 96, kHeight = 72;
constexpr shared::Camera kCamera{.position = {1.6f, 1.7f, 3.2f}, .target = {-0.4f, 1.2f, -1}};

LightRecord lamp(Float3 position, float intensity, Float3 color = {1, 1, 1})
{
    LightRecord record = light(LightType::point, position, {0, -1, 0}, intensity);
    record.color = color;
    record.range = 9;
    return record;
}

/// Changes of a frame.
struct Changes
{
    std::vector<gpu::InstanceMove> moves{};
    std::vector<gpu::LightChange> lights{};
    std::vector<gpu::LampWeight> weights{};
    std::optional<gpu::DaylightChange> daylight{};
};

class ReceiverDrawTest : public AllLightsTest
{
protected:
    std::unique_ptr<gpu::Scene> load(const formats::PackView& pack, const gpu::SceneOptions& options = {})
    {
        auto scene = upload(pack, options);
        EXPECT_EQ(scene->lights->exposure(), 1) << "baked light of this room has no exposure";
        return scene;
    }

    /// Draw a frame; return its linear colours.
    std::vector<Float3> drawRadiance(const gpu::Scene& scene, const Changes& changes = {},
                                     const shared::Camera& camera = kCamera)
    {
        auto targets = renderer().createTargets({kWidth, kHeight}, {.keeps_radiance = true});
        HEARTH_ASSERT(targets.ok());
        const gpu::FrameInput input{.view = makeView(scene, camera, {.width = kWidth, .height = kHeight}),
                                    .moves = changes.moves,
                                    .lights = changes.lights,
                                    .daylight = changes.daylight ? &*changes.daylight : nullptr,
                                    .lamp_weights = changes.weights};
        const Status status = host().run(
            [&](VkCommandBuffer commands)
            {
                renderer().record(commands, scene, *targets, input);
                return success();
            });
        HEARTH_ASSERT(status.ok());
        return readRadiance(host(), renderer(), *targets);
    }

    /// Return the instance of each pixel; kInvalidIndex for the background.
    std::vector<uint32_t> drawInstances(const gpu::Scene& scene)
    {
        std::vector<uint32_t> instances;
        for (const auto& seen : draw(scene, kCamera, {.width = kWidth, .height = kHeight}).seen())
            instances.push_back(seen[0]);
        return instances;
    }

    /// Compare radiances of the pixels of instances.
    /// share  the largest difference over the largest value
    static void expectNear(const std::vector<Float3>& radiance, const std::vector<Float3>& expected,
                           const std::vector<uint32_t>& instances, uint32_t first, uint32_t end, double share)
    {
        double largest = 0, off = 0;
        size_t count = 0;
        for (size_t i = 0; i < radiance.size(); ++i)
        {
            if (instances[i] < first || instances[i] >= end)
                continue;
            ++count;
            for (int c = 0; c < 3; ++c)
            {
                largest = std::max<double>(largest, expected[i][c]);
                off = std::max<double>(off, std::abs(radiance[i][c] - expected[i][c]));
            }
        }
        EXPECT_GT(count, 100u);
        EXPECT_GT(largest, 0.01);
        EXPECT_LE(off, share * largest);
    }

    static std::vector<Float3> difference(std::vector<Float3> a, const std::vector<Float3>& b)
    {
        for (size_t i = 0; i < a.size(); ++i)
            a[i] = a[i] - b[i];
        return a;
    }

    static std::vector<Float3> scaled(std::vector<Float3> a, Float3 factor)
    {
        for (Float3& value : a)
            value = value * factor;
        return a;
    }

    /// Return the light of lamps on a scene without receivers: what is there without them is taken away.
    std::vector<Float3> drawLamps(const gpu::Scene& live, uint32_t lamps)
    {
        const std::vector<Float3> lit = drawRadiance(live);
        Changes dark;
        for (uint32_t i = 0; i < lamps; ++i)
            dark.weights.push_back(gpu::weighLight(live, i, {}).value());
        return difference(lit, drawRadiance(live, dark));
    }

    /// Let a probe of white light from everywhere surround the room.
    /// irradiance      of its surroundings
    /// lamp_irradiance  of lamps, the same about every normal, as a share of that
    static void setProbe(ReceiverRoom& room, float irradiance, float lamp_irradiance = 0)
    {
        constexpr float kRadiance = 1 / std::numbers::pi_v<float>;
        const float constant = kRadiance * std::sqrt(4 * std::numbers::pi_v<float>);
        formats::ProbeRecord probe{};
        probe.face_size = 4;
        probe.mip_count = 3;
        probe.format = static_cast<uint32_t>(formats::TexelFormat::rgb9e5_float);
        probe.flags = formats::kProbeIsLocal;
        probe.irradiance = {irradiance, irradiance, irradiance};
        probe.irradiance_luminance = irradiance;
        std::fill_n(probe.harmonics, 3, constant);
        probe.lamp_harmonics[0] = lamp_irradiance * constant;
        probe.texels.count = static_cast<uint32_t>(formats::cubeTexelCount(4, 3));
        probe.position = {0, 1, 0};
        probe.box_min = probe.influence_min = {-10, -10, -10};
        probe.box_max = probe.influence_max = {10, 10, 10};
        probe.fade = 1;
        PackModel& model = room.scene().model();
        model.probes = {probe};
        model.probe_texels.assign(
            probe.texels.count,
            formats::encodeSharedExponent({double{kRadiance}, double{kRadiance}, double{kRadiance}}));
    }

    static void polish(ReceiverRoom& room)
    {
        room.scene().model().materials[0].metallic = 1;
        room.scene().model().materials[0].roughness = 0.4f;
    }

    static void addTwoLamps(ReceiverRoom& room)
    {
        room.addLamp(lamp({0.6f, 2.2f, 0.8f}, 1.5f, {1, 0.7f, 0.4f}));
        room.addLamp(lamp({-0.5f, 1.1f, 0.3f}, 0.7f, {0.3f, 0.6f, 1}));
    }
};

} // namespace

TEST_F(ReceiverDrawTest, wallsShowBakedLampsAsLiveOnes)
{
    for (const uint32_t uv_set : {0u, 1u})
    {
        ReceiverRoom room;
        addTwoLamps(room);
        const auto live = load(room.buildLive());
        const auto instances = drawInstances(*live);
        const std::vector<Float3> lamps = drawLamps(*live, 2);
        const auto baked = load(room.build(uv_set));
        expectNear(drawRadiance(*baked), lamps, instances, 0, ReceiverRoom::kWalls, 0.01);
    }
}

TEST_F(ReceiverDrawTest, aSurfaceWithoutRectangleIsLitAsEver)
{
    ReceiverRoom room;
    addTwoLamps(room);
    const auto live = load(room.buildLive());
    const auto instances = drawInstances(*live);
    const std::vector<Float3> expected = drawRadiance(*live);
    const auto baked = load(room.build());
    expectNear(drawRadiance(*baked), expected, instances, ReceiverRoom::kSheet, ReceiverRoom::kSheet + 1, 0);
}

TEST_F(ReceiverDrawTest, weightsScaleBakedAndLiveLightAtOnce)
{
    ReceiverRoom room;
    room.addLamp(lamp({0.2f, 2, 0.8f}, 1.2f));
    const auto live = load(room.buildLive());
    const auto instances = drawInstances(*live);
    const auto baked = load(room.build());
    const std::vector<Float3> full = drawRadiance(*baked);
    const Float3 weight{0.5f, 0.25f, 0};
    const Changes dim{.weights = {gpu::weighLight(*baked, 0, weight).value()}};
    const std::vector<Float3> dimmed = drawRadiance(*baked, dim);
    expectNear(dimmed, scaled(full, weight), instances, 0, ReceiverRoom::kWalls, 0.004);
    expectNear(dimmed, drawRadiance(*live, {.weights = {gpu::weighLight(*live, 0, weight).value()}}),
               instances, ReceiverRoom::kSheet, ReceiverRoom::kSheet + 1, 0);
    // the weight stays with the light, whatever changes
    EXPECT_EQ(drawRadiance(*baked), dimmed);
    LightRecord brighter = room.scene().model().lights[0];
    brighter.intensity *= 2;
    const Changes flicker{.lights = {gpu::changeLight(*baked, 0, brighter).value()}};
    expectNear(drawRadiance(*baked, flicker), scaled(full, weight * 2.0f), instances, 0, ReceiverRoom::kWalls,
               0.004);
}

TEST_F(ReceiverDrawTest, weightsOfManyFramesAreThoseOfOne)
{
    ReceiverRoom room;
    addTwoLamps(room);
    const auto pack = room.build();
    const auto slow = load(pack), fast = load(pack);
    // small enough a change that each frame updates a quarter of the texels
    constexpr Float3 kWeight{1.03f, 0.97f, 1};
    drawRadiance(*slow);
    const Changes changes{
        .weights = {gpu::weighLight(*slow, 0, kWeight).value(), gpu::weighLight(*slow, 1, kWeight).value()}};
    std::vector<Float3> last = drawRadiance(*slow, changes);
    const std::vector<Float3> expected = drawRadiance(*fast, changes);
    EXPECT_NE(last, expected) << "three quarters of the texels are old";
    for (int frame = 0; frame < 3; ++frame)
    {
        EXPECT_NE(slow->receivers->updatedGroups(), 15u);
        last = drawRadiance(*slow);
    }
    EXPECT_EQ(last, expected);
}

TEST_F(ReceiverDrawTest, pointsDrawTheSameImage)
{
    ReceiverRoom room;
    addTwoLamps(room);
    const auto pack = room.build();
    const std::vector<Float3> expected = drawRadiance(*load(pack));
    gpu::RendererOptions options = testRendererOptions();
    options.deferred = true;
    options.receiver_update = gpu::ReceiverUpdate::points;
    replaceRenderer(options);
    {
        const auto scene = load(pack);
        EXPECT_EQ(drawRadiance(*scene), expected);
        EXPECT_EQ(scene->receivers->updatedGroups(), 0b1111u);
        drawRadiance(*scene);
        EXPECT_EQ(scene->receivers->updatedGroups(), 0u) << "nothing has changed";
    }
    options.receiver_update = gpu::ReceiverUpdate::compute;
    replaceRenderer(options);
}

TEST_F(ReceiverDrawTest, aMovedInstanceLosesItsRectangle)
{
    ReceiverRoom room;
    addTwoLamps(room);
    const auto live = load(room.buildLive());
    const auto instances = drawInstances(*live);
    const auto baked = load(room.build());
    const std::vector<Float3> at_rest = drawRadiance(*baked);
    Affine3 moved = room.wall(1);
    moved.m[2][3] -= 0.01f;
    const auto move = [&](const gpu::Scene& scene, const Affine3& to)
    { return Changes{.moves = {gpu::moveInstance(scene, 1, to).value()}}; };
    expectNear(drawRadiance(*baked, move(*baked, moved)), drawRadiance(*live, move(*live, moved)), instances,
               1, 2, 0);
    EXPECT_EQ(drawRadiance(*baked, move(*baked, room.wall(1))), at_rest);
}

TEST_F(ReceiverDrawTest, aMovedLampIsLiveUntilItIsBack)
{
    ReceiverRoom room;
    room.addLamp(lamp({0.2f, 2, 0.8f}, 1.2f));
    const auto live = load(room.buildLive());
    const auto instances = drawInstances(*live);
    const auto baked = load(room.build());
    const std::vector<Float3> at_rest = drawRadiance(*baked);
    LightRecord elsewhere = room.scene().model().lights[0];
    elsewhere.world_from_light = translated({-0.8f, 1.5f, 0.5f});
    const auto change = [&](const gpu::Scene& scene, const LightRecord& to)
    { return Changes{.lights = {gpu::changeLight(scene, 0, to).value()}}; };
    const std::vector<Float3> lit = drawRadiance(*live, change(*live, elsewhere));
    const std::vector<Float3> dark =
        drawRadiance(*live, {.weights = {gpu::weighLight(*live, 0, {}).value()}});
    expectNear(drawRadiance(*baked, change(*baked, elsewhere)), difference(lit, dark), instances, 0,
               ReceiverRoom::kWalls, 0.002);
    EXPECT_EQ(drawRadiance(*baked, change(*baked, room.scene().model().lights[0])), at_rest);
}

TEST_F(ReceiverDrawTest, aFlatWallShowsTheTexelsOfTheTwin)
{
    ReceiverRoom room;
    room.setSteady({0.3f, 1.7f, 0.9f});
    room.addLamp(lamp({0.2f, 2, 9}, 0)); // without light, so that the sun of empty scenes is not there
    const auto baked = load(room.build());
    pack::ReceiverLight twin(room.tables());
    twin.update();
    const formats::ReceiverRectRecord& rect = room.tables().rects[1];
    const uint32_t word = twin.texels()[size_t{rect.y + 9} * room.tables().atlas.width + rect.x + 9];
    const Float3 irradiance = shared::decodeSharedExponentWord(word) * room.tables().atlas.scale;
    const std::vector<Float3> radiance = drawRadiance(*baked);
    const std::vector<uint32_t> instances = drawInstances(*baked);
    constexpr Float3 kAlbedo{0.5f, 0.6f, 0.7f};
    const Float3 expected = irradiance * kAlbedo / std::numbers::pi_v<float>;
    size_t count = 0;
    for (size_t i = 0; i < radiance.size(); ++i)
        for (int c = 0; c < 3 && instances[i] < ReceiverRoom::kWalls; ++c, ++count)
            EXPECT_NEAR(radiance[i][c], expected[c], 0.002f * expected[c]);
    EXPECT_GT(count, 1000u);
}

/// Return the irradiance of level ground, over pi: the mean of random directions by the cosine.
Float3 sampleLevelGround(const shared::Sky& sky)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(0, 1);
    Float3 sum;
    constexpr int kDirections = 20000;
    for (int i = 0; i < kDirections; ++i)
    {
        const float height = std::sqrt(unit(random)), turn = 6.2831853f * unit(random);
        const float aside = std::sqrt(1 - height * height);
        sum +=
            shared::skyRadiance(sky, {aside * std::cos(turn), height, aside * std::sin(turn)}) / kDirections;
    }
    return sum;
}

TEST_F(ReceiverDrawTest, lightOfTheSkyFollowsTheDaylight)
{
    ReceiverRoom room;
    room.setSteady({0.3f, 1.7f, 0.9f});
    room.addLamp(lamp({0.2f, 2, 9}, 0)); // without light, so that the sun of empty scenes is not there
    const auto scene = load(room.build());
    const auto instances = drawInstances(*scene);
    const std::vector<Float3> before = drawRadiance(*scene);
    const gpu::DaylightChange evening =
        gpu::changeDaylight(*scene, shared::Daylight{.elevation_deg = 8}).value();
    const Float3 now = sampleLevelGround(evening.sky), then = sampleLevelGround(scene->lights->loadedSky());
    const Float3 ratio{now.x / then.x, now.y / then.y, now.z / then.z};
    EXPECT_LT(ratio.y, 0.7f);
    expectNear(drawRadiance(*scene, {.daylight = evening}), scaled(before, ratio), instances, 0,
               ReceiverRoom::kWalls, 0.01);
    EXPECT_EQ(drawRadiance(*scene, {.daylight = gpu::changeDaylight(*scene, std::nullopt).value()}), before);
}

TEST_F(ReceiverDrawTest, emissionHasTheWeightOfItsLamp)
{
    ReceiverRoom room;
    room.addLamp(lamp({0.2f, 2, 9}, 0));
    PackModel& model = room.scene().model();
    model.materials[0].emissive = {0.8f, 0.4f, 0.2f};
    room.addMeshLamp(ReceiverRoom::kSheet, {1, 1, 1});
    const auto baked = load(room.build());
    const std::vector<uint32_t> instances = drawInstances(*baked);
    const std::vector<Float3> full = drawRadiance(*baked);
    const Changes off{.weights = {gpu::weighEmission(*baked, ReceiverRoom::kSheet, {0, 0, 0}).value()}};
    const std::vector<Float3> dark = drawRadiance(*baked, off);
    const Changes half{
        .weights = {gpu::weighEmission(*baked, ReceiverRoom::kSheet, {0.5f, 0.5f, 0.5f}).value()}};
    const std::vector<Float3> dimmed = drawRadiance(*baked, half);
    expectNear(scaled(difference(dimmed, dark), {2, 2, 2}), difference(full, dark), instances, 0, 4, 0.004);
    const size_t sheet = static_cast<size_t>(
        std::find(instances.begin(), instances.end(), ReceiverRoom::kSheet) - instances.begin());
    EXPECT_NEAR(full[sheet].x - dark[sheet].x, 0.8f, 0.002f);
}

TEST_F(ReceiverDrawTest, bricksGiveDiffuseLightOnlyWhereNoRectangleIs)
{
    ReceiverRoom room;
    addTwoLamps(room);
    const auto without = load(room.build());
    const auto instances = drawInstances(*without);
    const std::vector<Float3> expected = drawRadiance(*without);
    ReceiverRoom bright;
    addTwoLamps(bright);
    constexpr std::array<uint32_t, 3> kVoxels{8, 8, 8};
    BrickModel bricks =
        brickModel(kVoxels, makeShell(kVoxels), [](std::array<uint32_t, 3>, uint32_t) { return FaceLook{}; });
    bricks.grid.origin = {-4, -1, -4};
    bricks.grid.voxel_size = 1;
    setBricks(bright.scene(), bricks);
    const auto with = load(bright.build());
    ASSERT_NE(with->bricks, nullptr);
    const std::vector<Float3> radiance = drawRadiance(*with);
    expectNear(radiance, expected, instances, 0, ReceiverRoom::kWalls, 0);
    const size_t sheet = static_cast<size_t>(
        std::find(instances.begin(), instances.end(), ReceiverRoom::kSheet) - instances.begin());
    EXPECT_NE(radiance[sheet], expected[sheet]) << "its diffuse light is no longer the sky's";
}

TEST_F(ReceiverDrawTest, reflectionsOfAProbeFollowTheBakedLamps)
{
    ReceiverRoom room(false);
    addTwoLamps(room);
    polish(room);
    setProbe(room, 0.8f);
    const auto baked = load(room.build());
    const auto instances = drawInstances(*baked);
    const std::vector<Float3> full = drawRadiance(*baked);
    Changes dim;
    for (uint32_t i = 0; i < 2; ++i)
        dim.weights.push_back(gpu::weighLight(*baked, i, {0.5f, 0.5f, 0.5f}).value());
    expectNear(drawRadiance(*baked, dim), scaled(full, {0.5f, 0.5f, 0.5f}), instances, 0,
               ReceiverRoom::kWalls, 0.004);

    // a probe in brighter surroundings, of which the walls have the light that they had
    setProbe(room, 1.6f);
    const std::vector<Float3> brighter = drawRadiance(*load(room.build()));
    expectNear(brighter, full, instances, 0, ReceiverRoom::kWalls, 0);
    EXPECT_NE(brighter, full) << "the sheet has no baked light";

    // as much light of lamps at the probe as from all that it sees
    setProbe(room, 0.8f, 1);
    expectNear(drawRadiance(*load(room.build())), scaled(full, {0.5f, 0.5f, 0.5f}), instances, 0,
               ReceiverRoom::kWalls, 0.002);
}

TEST_F(ReceiverDrawTest, aSurfaceWithTheLightOfTheProbeHasPlainImageBasedLight)
{
    for (const float metallic : {0.0f, 1.0f})
    {
        ReceiverRoom room(false);
        room.setSteady({0.8f, 0.8f, 0.8f});
        room.addLamp(lamp({0.2f, 2, 9}, 0)); // without light, so that the sun of empty scenes is not there
        room.scene().model().materials[0].metallic = metallic;
        room.scene().model().materials[0].roughness = 0.3f;
        setProbe(room, 0.8f);
        const auto live = load(room.buildLive());
        const auto instances = drawInstances(*live);
        const auto baked = load(room.build());
        expectNear(drawRadiance(*baked), drawRadiance(*live), instances, 0, ReceiverRoom::kWalls, 0.01);
    }
}

TEST_F(ReceiverDrawTest, allMethodsDrawOneImage)
{
    for (const bool has_shadows : {false, true})
    {
        ReceiverRoom room(false);
        addTwoLamps(room);
        room.addLamp(sun({0.3f, -1, -0.4f}));
        room.scene().model().lights[2].intensity = 0.2f;
        room.scene().addLight(lamp({1, 0.6f, 0}, 0.4f)); // of the game: not baked
        const auto scene =
            load(room.build(), {.shadows = {.max_maps = has_shadows ? 8u : 0u, .texels = 256}});
        Image expected;
        for (size_t method = gpu::kLightMethodCount; method-- > 0;)
            ASSERT_TRUE(renderer().prepareLightMethod(*scene, static_cast<gpu::LightMethod>(method)).ok());
        expected = draw(*scene, kCamera, {.light_method = gpu::LightMethod::all});
        for (size_t method = 0; method < gpu::kLightMethodCount; ++method)
        {
            const gpu::LightMethodFacts& facts = gpu::kLightMethods[method];
            const Image image =
                draw(*scene, kCamera, {.light_method = static_cast<gpu::LightMethod>(method)});
            double sum = 0;
            int largest = 0;
            for (size_t i = 0; i < image.color.size(); ++i)
                for (int c = 0; c < 3; ++c)
                {
                    const int off = std::abs(channel(image.color[i], c) - channel(expected.color[i], c));
                    largest = std::max(largest, off);
                    sum += off;
                }
            EXPECT_TRUE(facts.approximates || largest <= 2) << facts.name;
            EXPECT_LE(sum / (3.0 * static_cast<double>(image.color.size())), facts.approximates ? 4 : 0.2)
                << facts.name;
        }
    }
}

TEST_F(ReceiverDrawTest, nothingIsRecordedUnlessAWeightChanges)
{
    ReceiverRoom room;
    addTwoLamps(room);
    const auto pack = room.build();
    auto spied = gpu::Renderer::create(spyOnStages(host().description()), {});
    ASSERT_TRUE(spied.ok());
    std::unique_ptr<gpu::Scene> scene;
    ASSERT_TRUE(host()
                    .run(
                        [&](VkCommandBuffer commands) -> Status
                        {
                            HEARTH_ASSIGN_OR_RETURN(scene, (*spied)->upload(pack, commands));
                            return success();
                        })
                    .ok());
    auto targets = (*spied)->createTargets({kWidth, kHeight});
    ASSERT_TRUE(targets.ok());
    const auto countUpdates = [&](std::span<const gpu::LampWeight> weights)
    {
        forgetCommands();
        const gpu::FrameInput input{.view = makeView(*scene, kCamera, {.width = kWidth, .height = kHeight}),
                                    .lamp_weights = weights};
        EXPECT_TRUE(host()
                        .run(
                            [&](VkCommandBuffer commands)
                            {
                                (*spied)->record(commands, *scene, *targets, input);
                                return success();
                            })
                        .ok());
        return std::count_if(spiedCommands().begin(), spiedCommands().end(),
                             [](const SpiedCommand& command) { return command.label == "update receivers"; });
    };
    EXPECT_EQ(countUpdates({}), 4) << "a dispatch for each group";
    EXPECT_EQ(countUpdates({}), 0);
    const gpu::LampWeight same[] = {gpu::weighLight(*scene, 0, {1, 1, 1}).value()};
    EXPECT_EQ(countUpdates(same), 0);
    const gpu::LampWeight dim[] = {gpu::weighLight(*scene, 0, {0.2f, 1, 1}).value()};
    EXPECT_EQ(countUpdates(dim), 4);
    EXPECT_EQ(countUpdates({}), 0);
}

/// The view of texels changes them where they drop lamps, and the next frame without it brings them back.
TEST_F(ReceiverDrawTest, theViewOfTexelsUpdatesThemAsItComesAndGoes)
{
    ReceiverRoom room;
    addTwoLamps(room);
    const auto scene = load(room.build());
    const DrawOptions final{.width = kWidth, .height = kHeight};
    DrawOptions view = final;
    view.debug_view = shared::kViewReceivers;
    const Image before = draw(*scene, kCamera, final);
    draw(*scene, kCamera, view);
    EXPECT_EQ(scene->receivers->updatedGroups(), 0b1111u);
    draw(*scene, kCamera, view);
    EXPECT_EQ(scene->receivers->updatedGroups(), 0u);
    EXPECT_EQ(draw(*scene, kCamera, final).color, before.color);
    EXPECT_EQ(scene->receivers->updatedGroups(), 0b1111u);
}

TEST_F(ReceiverDrawTest, weightsThatAreNoneAreErrors)
{
    ReceiverRoom room;
    addTwoLamps(room);
    const auto scene = load(room.buildLive(), {.max_lights = 2});
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(gpu::weighLight(*scene, 2, {1, 1, 1}).ok());
    EXPECT_FALSE(gpu::weighLight(*scene, 0, {1, -1, 1}).ok());
    EXPECT_FALSE(gpu::weighLight(*scene, 0, {1, 1, kNaN}).ok());
    EXPECT_FALSE(gpu::weighEmission(*scene, 0, {1, 1, 1}).ok()) << "the pack has no receivers";
}

} // namespace hearth::test

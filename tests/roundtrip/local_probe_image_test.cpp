// Draws metal and paint in a room with a local probe, beside paths through the room.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/light/scene_light.h"
#include "cook/bricks/light/settled_light.h"
#include "cook/bricks/voxels/grid_part.h"
#include "cook/probes/probe.h"
#include "cook/receivers/select/atlas.h"
#include "cook/reflections/capture/capture.h"
#include "tests/environments/environments.h"
#include "tests/reference/flip.h"
#include "tests/reference/tracer/path_tracer.h"
#include "tests/roundtrip/traced_pictures.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/lit_scene.h"
#include "tests/support/shapes.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace hearth::test
{

namespace
{

using environment::Environment;
using environment::Layout;
using formats::LightType;

constexpr uint32_t kSide = 48;           ///< of an image, in pixels
constexpr uint32_t kSamples = 4;         ///< of a drawn pixel, along each axis
constexpr uint32_t kPaths = 512;         ///< of each pixel, traced twice
constexpr Float3 kAt{0.2f, 1.4f, -0.3f}; ///< position of the probe, in the middle of the ball

// Mean of the pixels that show a mirror 2 m away from the probe: .095, of which the noise of paths is a part,
// and .553 without parallax.
constexpr double kMaxMirrorFlip = 0.11;

Affine3 withAxes(Float3 right, Float3 up, Float3 center)
{
    Affine3 t = translated(center);
    const Float3 columns[] = {right, up, cross(right, up)};
    for (size_t c = 0; c < 3; ++c)
        for (int row = 0; row < 3; ++row)
            t.m[row][c] = columns[c][row];
    return t;
}

double meanChannel(const Image& image)
{
    double sum = 0;
    for (const uint32_t color : image.color)
        sum += channel(color, 1);
    return sum / static_cast<double>(image.color.size());
}

int largestDifference(const Image& a, const Image& b)
{
    int largest = 0;
    for (size_t i = 0; i < a.color.size(); ++i)
        for (int c = 0; c < 3; ++c)
            largest = std::max(largest, std::abs(channel(a.color[i], c) - channel(b.color[i], c)));
    return largest;
}

class LocalProbeImageTest : public GpuTest
{
protected:
    uint32_t addPaint(Float3 color, float metallic = 0, float roughness = 1)
    {
        formats::MaterialRecord material = plainMaterial();
        material.base_color = {color.x, color.y, color.z, 1};
        material.metallic = metallic;
        material.roughness = roughness;
        return test_.addMaterial(material);
    }

    void addWall(Float3 color, Float3 right, Float3 up, Float3 center, float width, float height)
    {
        test_.addInstance(test_.addMesh(withMaterial(makeQuad(width, height), addPaint(color))),
                          withAxes(right, up, center));
    }

    /// Add a room of 4 x 3 x 5 m with a wall of each colour, a white block, and a lamp.
    void addRoom()
    {
        addWall({0.5f, 0.5f, 0.5f}, {1, 0, 0}, {0, 0, -1}, {0, 0, 0}, 4, 5);
        addWall({0.8f, 0.8f, 0.8f}, {1, 0, 0}, {0, 0, 1}, {0, 3, 0}, 4, 5);
        addWall({0.7f, 0.1f, 0.1f}, {0, 0, -1}, {0, 1, 0}, {-2, 1.5f, 0}, 5, 3);
        addWall({0.1f, 0.6f, 0.15f}, {0, 0, 1}, {0, 1, 0}, {2, 1.5f, 0}, 5, 3);
        addWall({0.15f, 0.2f, 0.7f}, {1, 0, 0}, {0, 1, 0}, {0, 1.5f, -2.5f}, 4, 3);
        addWall({0.7f, 0.6f, 0.1f}, {-1, 0, 0}, {0, 1, 0}, {0, 1.5f, 2.5f}, 4, 3);
        test_.addLight(light(LightType::point, {0.6f, 2.4f, 0.8f}, {0, -1, 0}, 5));
    }

    uint32_t addBall(float radius, Float3 center, uint32_t material)
    {
        mesh::SourceMesh ball = shapes::rock(24, 0);
        for (Float3& p : ball.positions)
            p = normalizeOr(p, {});
        ball.normals = ball.positions;
        for (Float3& p : ball.positions)
            p = p * radius;
        test_.addInstance(test_.addMesh(withMaterial(ball, material)), translated(center));
        return static_cast<uint32_t>(test_.model().instances.size() - 1);
    }

    /// Capture the scene as it is.
    probes::Probe capture(Float3 position)
    {
        const formats::PackView pack = test_.build();
        const std::vector<bricks::SourceParts> sources{{pack, pack, pack}};
        const bricks::StaticScene scene = bricks::collectStaticScene(sources).value();
        const auto surfaces = reflections::Surfaces::read(scene).value();
        const reflections::Capture seen = reflections::captureRadiance(
            surfaces, bricks::makeSceneLighting(scene), {}, position, formats::kMaxLocalProbeSide);
        probes::Probe probe = probes::cookProbe(seen.radiance, "room", formats::kMaxLocalProbeSide).value();
        place(probe, position, reflections::findBox(surfaces, position), 0.2f);
        return probe;
    }

    static void place(probes::Probe& probe, Float3 position, const Box3& box, float fade)
    {
        probe.record.flags = formats::kProbeIsLocal;
        probe.record.position = position;
        probe.record.box_min = box.min;
        probe.record.box_max = box.max;
        probe.record.influence_min = box.min - Float3{fade, fade, fade};
        probe.record.influence_max = box.max + Float3{fade, fade, fade};
        probe.record.fade = fade;
    }

    void setProbes(const std::vector<probes::Probe>& probes)
    {
        PackModel& model = test_.model();
        model.probes.clear();
        model.probe_texels.clear();
        for (const probes::Probe& probe : probes)
        {
            model.probes.push_back(probe.record);
            model.probes.back().texels.first = static_cast<uint32_t>(model.probe_texels.size());
            model.probe_texels.insert(model.probe_texels.end(), probe.texels.begin(), probe.texels.end());
        }
    }

    Image drawScene(const shared::Camera& camera, uint32_t side = kSamples * kSide)
    {
        const formats::PackView pack = test_.build();
        const auto scene = upload(pack);
        return draw(*scene, camera, {.width = side, .height = side});
    }

    /// Cook bricks of the scene as it is, and light them; the light of each lamp is apart as well.
    void setBricks()
    {
        const formats::PackView pack = test_.build();
        const std::vector<bricks::SourceParts> sources{{pack, pack, pack}};
        const bricks::StaticScene scene = bricks::collectStaticScene(sources).value();
        bricks::GridSettings settings;
        settings.voxel_size = 0.1;
        settings.seeds = {kAt};
        const bricks::BrickTables tables = bricks::cookGrid(scene, settings).value().tables;
        const bricks::SettledLight light =
            bricks::settleLight(bricks::makeBrickView(tables), bricks::makeSceneLighting(scene));
        PackModel& model = test_.model();
        bricks::LampSources lamp_sources;
        model.receiver_lamps = {{0, 0}};
        for (uint32_t i = 0; i < pack.lights().size(); ++i)
        {
            model.receiver_lamps.push_back({static_cast<uint32_t>(formats::ReceiverLampKind::light), i});
            lamp_sources.lamps_of_lights.push_back(lamp_sources.count++);
        }
        const std::vector<Float3> lamps = bricks::settleLamps(bricks::makeBrickView(tables),
                                                              bricks::makeSceneLighting(scene), lamp_sources);
        const receivers::Atlas faces =
            receivers::packFaces(model.receiver_lamps, lamps, tables.grid.face_count, {});
        model.face_atlases = {faces.record};
        model.face_blocks = faces.blocks;
        model.face_words = faces.words;
        model.brick_grids = {tables.grid};
        model.bricks = {tables.grid,    tables.groups,   tables.bricks, tables.opacity,   tables.albedo,
                        tables.normals, tables.emission, light.codes,   tables.reflectors};
    }

    /// Return the mean linear colour of an instance's pixels, after light has been gathered for some frames.
    reference::Double3 measureColor(const gpu::Scene& scene, uint32_t instance, const shared::Camera& camera,
                                    bool gi, std::span<const gpu::LampWeight> weights = {})
    {
        gpu::FrameTargets targets = makeTargets(kSamples * kSide, kSamples * kSide);
        Image image;
        for (int frame = 0; frame < (gi ? 24 : 1); ++frame)
            image = draw(scene, targets, camera,
                         {.width = kSamples * kSide,
                          .height = kSamples * kSide,
                          .lamp_weights = frame == 0 ? weights : std::span<const gpu::LampWeight>{},
                          .gi = gi});
        const auto seen = image.seen();
        reference::Double3 sum;
        double pixels = 0;
        for (size_t i = 0; i < seen.size(); ++i)
            if (seen[i][0] == instance)
            {
                sum += readRadiance(image.color[i]);
                pixels += 1;
            }
        return sum / pixels;
    }

    /// Picture of all paths, and of each half of them: their difference is the noise of the oracle.
    struct Traced
    {
        reference::Image all, first, second;
    };

    Traced trace(const shared::Camera& camera)
    {
        const formats::PackView pack = test_.build();
        const reference::PackGeometry geometry = reference::PackGeometry::decode(pack).value();
        const reference::TextureSet textures = reference::TextureSet::load(pack).value();
        const reference::ShadedScene scene(geometry, textures, nullptr);
        const auto traceHalf = [&](uint64_t seed)
        {
            return reference::tracePaths(
                scene, {.camera = camera, .width = kSide, .height = kSide, .samples = kPaths, .seed = seed});
        };
        const std::vector<reference::Double3> first = traceHalf(1), second = traceHalf(2);
        std::vector<reference::Double3> all;
        for (size_t i = 0; i < first.size(); ++i)
            all.push_back((first[i] + second[i]) / 2);
        return {showRadiance(all, kSide), showRadiance(first, kSide), showRadiance(second, kSide)};
    }

    /// Return the mean FLIP over the pixels that count.
    static double compare(reference::Image a, reference::Image b, const std::vector<bool>& counts)
    {
        for (uint32_t i = 0; i < kSide * kSide; ++i)
            for (size_t c = 0; c < 3 && !counts[i]; ++c)
                a.at(i % kSide, i / kSide)[c] = b.at(i % kSide, i / kSide)[c] = 0;
        const reference::FlipMap map = reference::flip(a, b);
        double sum = 0, pixels = 0;
        for (uint32_t i = 0; i < kSide * kSide; ++i)
        {
            sum += counts[i] ? double{map.error[i]} : 0;
            pixels += counts[i] ? 1 : 0;
        }
        EXPECT_GT(pixels, 500);
        return sum / pixels;
    }

    /// Return the mean FLIP over pixels all of whose samples show an instance.
    static double compare(const std::string& name, uint32_t instance, const Image& drawn,
                          const Traced& traced)
    {
        const reference::Image picture = averageSamples(drawn, kSide, kSamples);
        const auto seen = drawn.seen();
        std::vector<bool> counts;
        for (uint32_t i = 0; i < kSide * kSide; ++i)
        {
            bool shows = true;
            for (uint32_t sample = 0; sample < kSamples * kSamples; ++sample)
                shows = shows && seen[(kSamples * (i / kSide) + sample / kSamples) * drawn.width +
                                      kSamples * (i % kSide) + sample % kSamples][0] == instance;
            counts.push_back(shows);
        }
        if (const char* folder = std::getenv("HEARTH_TEST_IMAGES"))
        {
            EXPECT_TRUE(reference::writePng(std::string(folder) + "/" + name + "-drawn.png", picture).ok());
            EXPECT_TRUE(
                reference::writePng(std::string(folder) + "/" + name + "-traced.png", traced.all).ok());
        }
        const double difference = compare(traced.all, picture, counts);
        std::printf("%s: FLIP %.4f, of the halves of the paths %.4f\n", name.c_str(), difference,
                    compare(traced.first, traced.second, counts));
        return difference;
    }

    TestScene test_;
};

/// Bright above, dim below, with colours: no detail finer than the texels of a local probe.
Float3 makeSmoothSky(Double3 d)
{
    return {static_cast<float>(0.5 + 0.3 * d.x), static_cast<float>(0.5 + 0.4 * d.y),
            static_cast<float>(0.5 - 0.3 * d.z)};
}

} // namespace

TEST_F(LocalProbeImageTest, ballAtTheProbeLooksAsPathsShowIt)
{
    addRoom();
    const probes::Probe probe = capture(kAt);
    const TestScene room = test_;
    struct Look
    {
        const char* name;
        float metallic, roughness, radius;
        double max_flip;
    };
    // A small ball has no shadow to speak of, and hides nothing of the room from its walls.
    for (const Look& look :
         {Look{"metal-05", 1, 0.05f, 0.15f, 0.05}, Look{"metal-30", 1, 0.3f, 0.15f, 0.062},
          Look{"metal-60", 1, 0.6f, 0.15f, 0.065}, Look{"paint-90", 0, 0.9f, 0.15f, 0.053},
          Look{"metal-60-small", 1, 0.6f, 0.0075f, 0.052}, Look{"paint-90-small", 0, 0.9f, 0.0075f, 0.03}})
    {
        test_ = room;
        const uint32_t ball =
            addBall(look.radius, kAt, addPaint({0.9f, 0.8f, 0.6f}, look.metallic, look.roughness));
        setProbes({probe});
        const shared::Camera camera{.position = kAt + Float3{10, 4, 12} * (look.radius / 3),
                                    .target = kAt,
                                    .y_fov_rad = 0.5f,
                                    .z_near = look.radius / 3};
        EXPECT_LT(compare(std::string("ball-") + look.name, ball, drawScene(camera), trace(camera)),
                  look.max_flip);
    }
}

/// Frames with the light of bricks reflect what frames without it have from the probe, in a pack with both.
TEST_F(LocalProbeImageTest, agreesWithTheLobesOfBricks)
{
    addRoom();
    setProbes({capture(kAt)});
    setBricks();
    const TestScene room = test_;
    for (const auto& [metallic, roughness] :
         {std::pair(1.0f, 0.05f), std::pair(1.0f, 0.3f), std::pair(1.0f, 0.6f), std::pair(0.0f, 0.9f)})
    {
        test_ = room;
        const uint32_t ball = addBall(0.15f, kAt, addPaint({0.9f, 0.8f, 0.6f}, metallic, roughness));
        const formats::PackView pack = test_.build();
        const auto scene = upload(pack);
        const shared::Camera camera{
            .position = kAt + Float3{0.5f, 0.2f, 0.6f}, .target = kAt, .y_fov_rad = 0.5f, .z_near = 0.05f};
        const reference::Double3 by_probe = measureColor(*scene, ball, camera, false);
        const reference::Double3 by_bricks = measureColor(*scene, ball, camera, true);
        std::printf("metallic %.0f, roughness %.2f: bricks over probe %.3f %.3f %.3f\n", double{metallic},
                    double{roughness}, by_bricks.x / by_probe.x, by_bricks.y / by_probe.y,
                    by_bricks.z / by_probe.z);
        EXPECT_GT(by_probe.x, 0.05);
        EXPECT_NEAR(by_bricks.x / by_probe.x, 1, 0.05);
        EXPECT_NEAR(by_bricks.y / by_probe.y, 1, 0.05);
        EXPECT_NEAR(by_bricks.z / by_probe.z, 1, 0.05);
    }
}

/// A probe shows the room under all lamps; its light follows theirs, as a probe would show it that was
/// captured under the dimmed lamps.
TEST_F(LocalProbeImageTest, followsTheWeightsOfLamps)
{
    addRoom();
    formats::LightRecord red = light(LightType::point, {-1.2f, 1, -1.5f}, {0, -1, 0}, 6);
    red.color = {1, 0.2f, 0.1f};
    test_.addLight(red);
    for (formats::LightRecord& lamp : test_.model().lights)
        lamp.intensity *= 0.3f; // so dim that there is no exposure, which would follow them, too
    setProbes({capture(kAt)});
    setBricks();
    const TestScene room = test_;
    const shared::Camera camera{
        .position = kAt + Float3{0.5f, 0.2f, 0.6f}, .target = kAt, .y_fov_rad = 0.5f, .z_near = 0.05f};
    const auto measure = [&](std::span<const float> weights, bool captures)
    {
        test_ = room;
        if (captures)
        {
            for (size_t i = 0; i < weights.size(); ++i)
                test_.model().lights[i].intensity *= weights[i];
            setProbes({capture(kAt)});
        }
        const uint32_t ball = addBall(0.15f, kAt, addPaint({0.9f, 0.9f, 0.9f}, 1, 0.9f));
        const formats::PackView pack = test_.build();
        const auto scene = upload(pack);
        std::vector<gpu::LampWeight> lamps;
        for (uint32_t i = 0; i < weights.size() && !captures; ++i)
            lamps.push_back(gpu::weighLight(*scene, i, {weights[i], weights[i], weights[i]}).value());
        return measureColor(*scene, ball, camera, false, lamps);
    };
    const reference::Double3 all = measure({}, false);
    for (const std::array<float, 2>& weights : {std::array{0.1f, 1.0f}, std::array{1.0f, 0.05f}})
    {
        const reference::Double3 weighed = measure(weights, false), captured = measure(weights, true);
        std::printf("weights %.2f, %.2f: %.3f %.3f %.3f of a new capture; unchanged: %.3f %.3f %.3f\n",
                    double{weights[0]}, double{weights[1]}, weighed.x / captured.x, weighed.y / captured.y,
                    weighed.z / captured.z, all.x / captured.x, all.y / captured.y, all.z / captured.z);
        // one factor for all directions: the ball shows the far side of the room
        for (const double ratio : {weighed.x / captured.x, weighed.y / captured.y, weighed.z / captured.z})
        {
            EXPECT_GT(ratio, 0.85);
            EXPECT_LT(ratio, 1.4);
        }
    }
}

TEST_F(LocalProbeImageTest, mirrorShowsTheCornersOfTheRoom)
{
    addRoom();
    const probes::Probe probe = capture(kAt);
    mesh::SourceMesh glass = withMaterial(makeQuad(1.6f, 1.6f), addPaint({0.95f, 0.95f, 0.95f}, 1, 0.05f));
    test_.addInstance(test_.addMesh(glass), translated({0.9f, 1.3f, -2.45f}));
    const auto mirror = static_cast<uint32_t>(test_.model().instances.size() - 1);
    const shared::Camera camera{
        .position = {-0.6f, 1.6f, 0.4f}, .target = {0.9f, 1.3f, -2.45f}, .y_fov_rad = 0.6f, .z_near = 0.05f};
    setProbes({probe});
    const Traced traced = trace(camera);
    const double corrected = compare("mirror", mirror, drawScene(camera), traced);
    probes::Probe far = probe;
    far.record.box_min = {-1000, -1000, -1000};
    far.record.box_max = {1000, 1000, 1000};
    setProbes({far});
    const double uncorrected = compare("mirror-far", mirror, drawScene(camera), traced);
    EXPECT_LT(corrected, kMaxMirrorFlip);
    EXPECT_LT(corrected, 0.3 * uncorrected);
}

TEST_F(LocalProbeImageTest, isPlainImageBasedLightUnderAnOpenSky)
{
    const Environment sky = makeEnvironment(Layout::lat_long, 64, makeSmoothSky);
    for (size_t i = 0; i < 4; ++i)
        addBall(1, {3 * static_cast<float>(i), 0, 0},
                addPaint({0.9f, 0.7f, 0.5f}, i < 3 ? 1 : 0, std::array{0.1f, 0.4f, 0.9f, 0.7f}[i]));
    test_.addLight(light(LightType::point, {0, 50, 0}, {0, -1, 0}, 1)); // no default sun
    const shared::Camera camera{
        .position = {4.5f, 1, 9}, .target = {4.5f, 0, 0}, .y_fov_rad = 0.9f, .z_near = 0.05f};
    probes::Probe of_sky = probes::cookProbe(sky, "sky").value();
    of_sky.record.flags = formats::kProbeIsSky;
    setProbes({of_sky});
    const Image expected = drawScene(camera);
    probes::Probe local = probes::cookProbe(sky, "sky", 64).value();
    place(local, {4.5f, 0, 0}, {{-5000, -5000, -5000}, {5000, 5000, 5000}}, 1);
    setProbes({of_sky, local});
    const Image found = drawScene(camera);
    EXPECT_LE(largestDifference(found, expected), 3) << "of 255: 1 %";
    EXPECT_NE(found.color, expected.color) << "the probe is drawn";

    // brighter by its irradiance alone, which no byte of its texels and harmonics shows
    local.record.irradiance_luminance *= 2;
    setProbes({of_sky, local});
    EXPECT_GT(meanChannel(drawScene(camera)), 1.01 * meanChannel(expected)) << "most of it is sky";
}

TEST_F(LocalProbeImageTest, halfTheWeightIsHalfTheLight)
{
    // two probes of one light whose influences fade against each other, beside one probe
    const Environment light_all_around = makeEnvironment(Layout::cube, 32,
                                                         [](Double3) {
                                                             return Float3{0.4f, 0.3f, 0.2f};
                                                         });
    addBall(1, {}, addPaint({0.9f, 0.7f, 0.5f}, 1, 0.4f));
    test_.addLight(light(LightType::point, {0, 50, 0}, {0, -1, 0}, 1));
    const shared::Camera camera{.position = {0, 0, 4}, .target = {}, .y_fov_rad = 0.6f, .z_near = 0.05f};
    probes::Probe probe = probes::cookProbe(light_all_around, "room", 64).value();
    place(probe, {}, {{-10, -10, -10}, {10, 10, 10}}, 1);
    setProbes({probe});
    const Image one = drawScene(camera);
    probes::Probe left = probe, right = probe;
    left.record.position.x = -5;
    left.record.influence_max.x = 2;
    left.record.fade = 4;
    right.record.position.x = 5;
    right.record.influence_min.x = -2;
    right.record.fade = 4;
    setProbes({left, right});
    EXPECT_LE(largestDifference(drawScene(camera), one), 1);
}

TEST_F(LocalProbeImageTest, changesNothingOutsideOfItsInfluence)
{
    addRoom();
    addBall(0.3f, kAt, addPaint({0.9f, 0.8f, 0.6f}, 1, 0.2f));
    addBall(0.3f, {8, 1, 0}, addPaint({0.9f, 0.8f, 0.6f}, 1, 0.2f));
    const shared::Camera outside{
        .position = {8, 1.2f, 3}, .target = {8, 1, 0}, .y_fov_rad = 0.6f, .z_near = 0.05f};
    const shared::Camera inside{
        .position = {0.2f, 1.5f, 2}, .target = kAt, .y_fov_rad = 0.6f, .z_near = 0.05f};
    const Image dark_outside = drawScene(outside), dark_inside = drawScene(inside);
    probes::Probe probe =
        probes::cookProbe(makeEnvironment(Layout::cube, 32, makeSmoothSky), "room", 64).value();
    place(probe, kAt, {{-2, 0, -2.5f}, {2, 3, 2.5f}}, 0.2f);
    setProbes({probe});
    EXPECT_EQ(drawScene(outside).color, dark_outside.color);
    EXPECT_NE(drawScene(inside).color, dark_inside.color);
}

TEST_F(LocalProbeImageTest, allLightMethodsDrawIt)
{
    gpu::RendererOptions options = testRendererOptions();
    options.deferred = true;
    replaceRenderer(options);
    addRoom();
    addBall(0.3f, kAt, addPaint({0.9f, 0.8f, 0.6f}, 1, 0.2f));
    probes::Probe probe =
        probes::cookProbe(makeEnvironment(Layout::cube, 32, makeSmoothSky), "room", 64).value();
    place(probe, kAt, {{-2, 0, -2.5f}, {2, 3, 2.5f}}, 0.2f);
    const shared::Camera camera{
        .position = {0.2f, 1.5f, 2}, .target = kAt, .y_fov_rad = 0.6f, .z_near = 0.05f};
    const auto drawAll = [&]
    {
        const formats::PackView pack = test_.build();
        const auto scene = upload(pack);
        std::vector<Image> images;
        for (size_t i = 0; i < gpu::kLightMethodCount; ++i)
        {
            const auto method = static_cast<gpu::LightMethod>(i);
            EXPECT_TRUE(renderer().prepareLightMethod(*scene, method).ok());
            images.push_back(draw(*scene, camera, {.light_method = method}));
        }
        return images;
    };
    const std::vector<Image> dark = drawAll();
    setProbes({probe});
    const std::vector<Image> lit = drawAll();
    const auto all = static_cast<size_t>(gpu::LightMethod::all);
    for (size_t i = 0; i < lit.size(); ++i)
    {
        const gpu::LightMethodFacts& facts = gpu::kLightMethods[i];
        EXPECT_NE(lit[i].color, dark[i].color) << facts.name;
        if (!facts.approximates)
            EXPECT_LE(largestDifference(lit[i], lit[all]), 2) << facts.name;
    }
}

} // namespace hearth::test

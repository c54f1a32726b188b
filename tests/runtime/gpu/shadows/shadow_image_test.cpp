// Tests images with shadows: they match ray tracing except for a rim of a few texels, have no acne at any
// angle and for any levels of the casters, and lights beyond the capacity are counted.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/tracer/reference_renderer.h"
#include "tests/runtime/gpu/shadows/depth_filtering.h"
#include "tests/runtime/scene_proxies.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/lit_scene.h"
#include "tests/support/shapes.h"

#include "runtime/gpu/scene/scene_shadows.h"
#include "runtime/viewer/compare/flip.h"

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <numbers>

namespace hearth::test
{

namespace
{

using namespace formats;

constexpr uint32_t kSize = 192;
constexpr double kDegree = std::numbers::pi / 180;

/// Build a floor of 8 m with rocks of about a metre on it and above it.
formats::PackView buildRocks(TestScene& test, uint32_t detail, const LightRecord& record)
{
    const uint32_t white = test.addMaterial(plainMaterial());
    const uint32_t floor = test.addMesh(withMaterial(makeQuad(8, 8), white));
    const uint32_t rock = test.addMesh(withMaterial(shapes::rock(detail, 0.25f), white));
    test.addInstance(floor, lying({0, 0, 0}));
    test.addInstance(rock, scaled(0.5f, {-0.8f, 0.4f, 0.5f}));
    test.addInstance(rock, scaled(0.35f, {0.9f, 1.2f, -0.3f}));
    test.addInstance(rock, scaled(0.2f, {0.3f, 0.2f, 1.3f}));
    test.addLight(record);
    return test.build();
}

shared::Camera roomCamera()
{
    return {.position = {2.2f, 2.6f, 4.2f}, .target = {0, 0.3f, 0}, .y_fov_rad = 0.8f, .z_near = 0.05f};
}

class ShadowImageTest : public GpuTest
{
protected:
    Image drawShadowed(const PackView& pack, const gpu::ShadowOptions& shadows, const DrawOptions& options,
                       const shared::Camera& camera = roomCamera())
    {
        const auto scene = upload(pack, {.shadows = shadows});
        Image image = draw(*scene, camera, options);
        statistics_ = scene->shadows->statistics();
        depth_ = scene->shadows->depth().depth;
        map_bytes_ = scene->shadows->image().bytes;
        return image;
    }

    /// Clusters and triangles of proxies in the maps of the last frame.
    std::pair<uint32_t, uint32_t> countCasters(const gpu::Scene& scene)
    {
        const auto counters = host().read(renderer().device(), scene.shadows->casters());
        const auto words = host().read(renderer().device(), scene.shadows->proxyTriangles());
        HEARTH_ASSERT(counters.ok() && words.ok());
        std::pair<uint32_t, uint32_t> sums{0, 0};
        for (uint32_t map = 0; map < scene.shadows->statistics().maps; ++map)
        {
            const size_t layer = scene.shadows->plan().block.maps[map].layer;
            shared::FrameCounters clusters{};
            uint32_t triangles = 0;
            std::memcpy(&clusters, counters->data() + layer * sizeof(clusters), sizeof(clusters));
            std::memcpy(&triangles, words->data() + layer * sizeof(triangles), sizeof(triangles));
            sums.first += clusters.drawn_clusters;
            sums.second += triangles;
        }
        return sums;
    }

    gpu::ShadowStatistics statistics_;
    gpu::ShadowDepth depth_{};
    VkDeviceSize map_bytes_ = 0;
};

reference::Image traced(const PackView& pack, bool shadows)
{
    const auto image = reference::renderReference(
        pack,
        {.camera = roomCamera(), .width = kSize, .height = kSize, .samples_per_side = 1, .shadows = shadows});
    HEARTH_ASSERT(image.ok());
    return *image;
}

/// Write an image for inspection if HEARTH_KEEP_IMAGES names a folder.
void keep(const Image& image, const std::string& name)
{
    const char* const folder = std::getenv("HEARTH_KEEP_IMAGES");
    if (folder == nullptr)
        return;
    reference::Image copy(image.width, image.height);
    for (size_t i = 0; i < image.color.size(); ++i)
        for (int c = 0; c < 3; ++c)
            copy.rgb[3 * i + static_cast<size_t>(c)] = static_cast<uint8_t>(channel(image.color[i], c));
    EXPECT_TRUE(reference::writePng(std::string(folder) + "/" + name + ".png", copy).ok());
}

struct Comparison
{
    size_t shadowed = 0; ///< pixels that are shadowed according to the rays
    size_t rim = 0;      ///< pixels near the edge of a shadow, which are not compared
    size_t wrong = 0;    ///< other pixels whose brightness differs by more than a twentieth
};

/// reach  distance in pixels that counts as near an edge
Comparison compare(const PackView& pack, const Image& drawn, int reach)
{
    const reference::Image with = traced(pack, true);
    const reference::Image without = traced(pack, false);
    const auto lost = [&](int x, int y)
    {
        const auto at = [&](const reference::Image& p)
        { return int{*p.at(static_cast<size_t>(x), static_cast<size_t>(y))}; };
        return at(without) - at(with) > 8;
    };
    Comparison result;
    const int size = static_cast<int>(kSize);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
        {
            result.shadowed += lost(x, y);
            bool rim = false;
            for (int v = std::max(y - reach, 0); v <= std::min(y + reach, size - 1); ++v)
                for (int u = std::max(x - reach, 0); u <= std::min(x + reach, size - 1); ++u)
                    rim = rim || lost(u, v) != lost(x, y);
            result.rim += rim;
            const int expected = *with.at(static_cast<size_t>(x), static_cast<size_t>(y));
            const int got = channel(drawn.at(static_cast<uint32_t>(x), static_cast<uint32_t>(y)), 0);
            result.wrong += !rim && std::abs(expected - got) > 12;
        }
    return result;
}

constexpr Float3 kSeamLamp{0.3f, -0.2f, 0.1f};

/// Build a lamp in a closed room whose walls are not parallel to the faces of the lamp, with or without a
/// shell around it that lets no light out.
PackView buildSeamRoom(TestScene& test, float intensity, bool shell)
{
    const uint32_t white = test.addMaterial(plainMaterial());
    const uint32_t wall = test.addMesh(withMaterial(makeQuad(20, 20), white));
    const Affine3 turned = shining({}, {0.48f, -0.36f, 0.8f});
    for (int side = 0; side < 6; ++side)
    {
        Float3 out{};
        (side / 2 == 0 ? out.x : side / 2 == 1 ? out.y : out.z) = side % 2 == 0 ? 1.0f : -1.0f;
        const Float3 normal{dot({turned.m[0][0], turned.m[0][1], turned.m[0][2]}, out),
                            dot({turned.m[1][0], turned.m[1][1], turned.m[1][2]}, out),
                            dot({turned.m[2][0], turned.m[2][1], turned.m[2][2]}, out)};
        test.addInstance(wall, shining(normal * 4, normal));
    }
    if (shell)
        test.addInstance(test.addMesh(withMaterial(shapes::rock(6, 0.0f), white)), scaled(0.5f, kSeamLamp));
    test.addLight(light(LightType::point, kSeamLamp, {0, -1, 0}, intensity));
    return test.build();
}

/// Return the middles of the edges of a cube, and its corners.
std::vector<Float3> seamDirections()
{
    std::vector<Float3> directions;
    for (int i = 0; i < 27; ++i)
    {
        const Float3 direction{static_cast<float>(i % 3 - 1), static_cast<float>(i / 3 % 3 - 1),
                               static_cast<float>(i / 9 - 1)};
        if (dot(direction, direction) > 1)
            directions.push_back(direction);
    }
    return directions;
}

size_t countDifferent(const Image& a, const Image& b)
{
    size_t count = 0;
    for (size_t i = 0; i < a.color.size(); ++i)
        count += std::abs(channel(a.color[i], 0) - channel(b.color[i], 0)) > 1;
    return count;
}

void expectTraced(const Comparison& comparison)
{
    EXPECT_GT(comparison.shadowed, 1000u);
    EXPECT_LT(comparison.rim, size_t{kSize} * kSize / 3);
    // silhouettes, whose pixels both methods find with different rounding
    EXPECT_LE(comparison.wrong, 40u);
}

constexpr gpu::ShadowOptions kFour{
    .max_maps = 4, .texels = 512, .splits = 4, .split_range = {.near = 2, .far = 12, .blend = 0.5f}};
constexpr DrawOptions kSource{.width = kSize, .height = kSize, .error_pixels = 0};

} // namespace

TEST_F(ShadowImageTest, thoseOfASunAreThoseOfRays)
{
    for (const Float3 direction : {Float3{0.3f, -1, -0.4f}, Float3{-1, -0.5f, 0.2f}, Float3{0, -1, 0}})
    {
        TestScene test;
        const PackView pack = buildRocks(test, 12, sun(direction));
        const Image image = drawShadowed(pack, kFour, kSource);
        keep(image, "sun");
        expectTraced(compare(pack, image, 3));
        EXPECT_EQ(statistics_.maps, 4u);
    }
}

TEST_F(ShadowImageTest, thoseOfASpotAreThoseOfRays)
{
    TestScene test;
    const PackView pack = buildRocks(test, 12, light(LightType::spot, {-2, 4, 1}, {2, -4, -1}, 30));
    const Image image = drawShadowed(pack, {.max_maps = 1, .texels = 512}, kSource);
    keep(image, "spot");
    expectTraced(compare(pack, image, 3));
}

/// The lamp hangs between the rocks, so that shadows of one rock cross seams of its faces.
TEST_F(ShadowImageTest, thoseOfAPointLightAreThoseOfRays)
{
    for (const Float3 place : {Float3{0.1f, 1.6f, 0.4f}, Float3{-0.3f, 0.7f, -0.4f}, Float3{-2, 4, 1}})
    {
        TestScene test;
        const PackView pack = buildRocks(test, 12, light(LightType::point, place, {0, -1, 0}, 30));
        const Image image = drawShadowed(pack, {.max_maps = 6, .texels = 512}, kSource);
        keep(image, "point");
        expectTraced(compare(pack, image, 3));
        EXPECT_EQ(statistics_.maps + statistics_.unseen_maps, 6u);
        EXPECT_EQ(statistics_.shadowed_lights, 1u);
        EXPECT_EQ(statistics_.unshadowed_lights, 0u);
    }
}

TEST_F(ShadowImageTest, aPointLightHasNoSeams)
{
    for (const uint32_t kernel : {0u, 1u, 3u})
    {
        const gpu::ShadowOptions shadows{.max_maps = 6, .texels = 64, .kernel = kernel};
        TestScene open, closed, unlit;
        const PackView open_pack = buildSeamRoom(open, 30, false);
        const PackView closed_pack = buildSeamRoom(closed, 30, true);
        const PackView unlit_pack = buildSeamRoom(unlit, 0, false);
        const auto unshadowed = upload(open_pack);
        const auto shadowed = upload(open_pack, {.shadows = shadows});
        const auto enclosed = upload(closed_pack, {.shadows = shadows});
        const auto without_light = upload(unlit_pack);
        for (const Float3& direction : seamDirections())
        {
            // from the lamp itself, past the shell around it
            const shared::Camera camera{.position = kSeamLamp,
                                        .target = kSeamLamp + direction,
                                        .up =
                                            std::abs(direction.y) < 0.9f ? Float3{0, 1, 0} : Float3{1, 0, 0},
                                        .y_fov_rad = 0.6f,
                                        .z_near = 0.8f};
            const DrawOptions options{.width = 96, .height = 96, .error_pixels = 0};
            const Image lit = draw(*unshadowed, camera, options);
            EXPECT_EQ(countDifferent(draw(*shadowed, camera, options), lit), 0u) << "dark, kernel " << kernel;
            const Image dark = draw(*without_light, camera, options);
            EXPECT_EQ(countDifferent(draw(*enclosed, camera, options), dark), 0u) << "lit, kernel " << kernel;
            EXPECT_GT(countDifferent(lit, dark), lit.color.size() * 9 / 10);
        }
    }
}

/// Bilinear compares count the same texels as one compare for each texel: half weights are exact. lavapipe
/// makes them without saying so, which the validation layer would report.
TEST_F(ShadowImageTest, filteringOfTheDeviceShowsTheSame)
{
    auto created = viewer::VulkanHost::create({.device_name = "", .validate = false});
    ASSERT_TRUE(created.ok());
    std::unique_ptr<viewer::VulkanHost> host = std::move(*created);
    std::unique_ptr<gpu::Renderer> renderers[2];
    for (const bool filters : {false, true})
    {
        auto renderer = gpu::Renderer::create(sayDepthFiltering(host->description(), filters));
        ASSERT_TRUE(renderer.ok());
        EXPECT_EQ((*renderer)->device().filters_d16, filters);
        EXPECT_EQ((*renderer)->device().filters_d32, filters);
        renderers[filters ? 1 : 0] = std::move(*renderer);
    }
    const auto drawOn = [&](std::unique_ptr<gpu::Renderer>& renderer, const PackView& pack,
                            const gpu::ShadowOptions& shadows, const DrawOptions& options)
    {
        exchangeDevice(host, renderer);
        Image image = drawShadowed(pack, shadows, options);
        exchangeDevice(host, renderer);
        return image;
    };
    for (const LightRecord& record :
         {sun({0.3f, -1, -0.4f}), light(LightType::point, {0.1f, 1.6f, 0.4f}, {0, -1, 0}, 30)})
        for (const uint32_t kernel : {0u, 1u, 2u, 3u})
            for (const uint32_t debug_view : {shared::kViewFinal, shared::kViewShadowMaps})
            {
                TestScene test;
                const PackView pack = buildRocks(test, 12, record);
                const gpu::ShadowOptions shadows{
                    .max_maps = 6, .texels = 128, .kernel = kernel, .split_range = {.near = 2, .far = 12}};
                DrawOptions options = kSource;
                options.debug_view = debug_view;
                const Image compared = drawOn(renderers[0], pack, shadows, options);
                const Image filtered = drawOn(renderers[1], pack, shadows, options);
                EXPECT_EQ(filtered.color, compared.color) << "kernel " << kernel;
                keep(filtered, "filtered" + std::to_string(kernel));
            }
}

TEST_F(ShadowImageTest, spheresMakeThemFinerWhereTheyAre)
{
    for (const LightRecord& record :
         {sun({0.3f, -1, -0.4f}), light(LightType::spot, {-2, 4, 1}, {2, -4, -1}, 30)})
    {
        TestScene test;
        const PackView pack = buildRocks(test, 12, record);
        // so coarse that the error of the shadows is far larger than the rim
        const gpu::ShadowOptions coarse{
            .max_maps = 2, .texels = 64, .splits = 1, .split_range = {.near = 2, .far = 30}};
        gpu::ShadowOptions two = coarse;
        two.texels = 512;
        const gpu::ShadowSphere sphere{.center = {0, 0.5f, 0}, .radius = 2};
        DrawOptions options = kSource;
        options.shadow_spheres = {&sphere, 1};
        const Comparison without = compare(pack, drawShadowed(pack, coarse, kSource), 2);
        const Comparison with = compare(pack, drawShadowed(pack, two, options), 2);
        EXPECT_EQ(statistics_.maps, 2u);
        EXPECT_GT(without.wrong, 100u);
        EXPECT_LE(with.wrong, without.wrong / 4);
    }
}

TEST_F(ShadowImageTest, spheresOfThePackAreThoseOfEveryFrame)
{
    TestScene test;
    const gpu::ShadowSphere sphere{.center = {0, 0.5f, 0}, .radius = 2, .light = 0, .texels = 128};
    const gpu::ShadowOptions shadows{.max_maps = 2, .texels = 256, .splits = 1};
    DrawOptions options = kSource;
    options.shadow_spheres = {&sphere, 1};
    const PackView plain = buildRocks(test, 12, sun({0.3f, -1, -0.4f}));
    const Image given = drawShadowed(plain, shadows, options);
    const Image without = drawShadowed(plain, shadows, kSource);
    test.model().shadow_spheres.push_back({.node = 0,
                                           .light = sphere.light,
                                           .center = sphere.center,
                                           .radius = sphere.radius,
                                           .texels = sphere.texels,
                                           .reserved = 0});
    const Image placed = drawShadowed(test.build(), shadows, kSource);
    EXPECT_EQ(statistics_.maps, 2u);
    EXPECT_EQ(placed.color, given.color);
    EXPECT_NE(placed.color, without.color);
}

/// The casters' levels are coarser than those of the frame, and neither shadows the other.
TEST_F(ShadowImageTest, coarserCastersShadowNothingThatIsLit)
{
    for (const float bias : {1.0f, 4.0f})
    {
        TestScene test;
        const PackView pack = buildRocks(test, 40, sun({0.3f, -1, -0.4f}));
        gpu::ShadowOptions options = kFour;
        options.error_bias = bias;
        DrawOptions coarse = kSource;
        coarse.error_pixels = 1;
        const Image image = drawShadowed(pack, options, coarse);
        keep(image, "bias" + std::to_string(static_cast<int>(bias)));
        const Comparison comparison = compare(pack, image, 4);
        EXPECT_GT(comparison.shadowed, 1000u);
        EXPECT_LE(comparison.wrong, 150u) << bias;
    }
}

/// Surfaces that no level has simplified have no error, whatever the threshold allows: their shadows are the
/// same, those of things as low as a pixel too.
TEST_F(ShadowImageTest, theThresholdMovesNoShadowOfASourceTriangle)
{
    TestScene test;
    const uint32_t white = test.addMaterial(plainMaterial());
    test.addInstance(test.addMesh(withMaterial(makeQuad(8, 8), white)), lying({0, 0, 0}));
    const uint32_t tile = test.addMesh(withMaterial(makeQuad(0.5f, 0.5f), white));
    for (int i = 0; i < 5; ++i)
        test.addInstance(tile, lying({static_cast<float>(i) - 2, 0.02f * static_cast<float>(i + 1), 0}));
    test.addInstance(tile, translated({0, 0.25f, 1}));
    test.addLight(sun({0.5f, -0.6f, -0.4f}));
    test.addLight(light(LightType::point, {1, 1.5f, 1.2f}, {0, -1, 0}, 10));
    const PackView pack = test.build();
    gpu::ShadowOptions options = kFour;
    options.max_maps = 10;
    DrawOptions coarse = kSource;
    coarse.error_pixels = 4;
    const Image image = drawShadowed(pack, options, kSource);
    EXPECT_EQ(drawShadowed(pack, options, coarse).color, image.color);
    EXPECT_GT(countDifferent(draw(*upload(pack), roomCamera(), kSource), image), 500u);
}

/// If a sphere moves while the cut stays the same, its map moves by whole texels and shows the same: shadows
/// do not shimmer.
TEST_F(ShadowImageTest, aMapThatMovesShowsTheSame)
{
    TestScene test;
    const PackView pack = buildRocks(test, 20, sun({0.3f, -1, -0.4f}));
    const auto scene = upload(pack, {.shadows = {.max_maps = 1, .texels = 128, .splits = 0}});
    std::mt19937 random(3);
    shared::ShadowMap first{};
    std::vector<float> expected;
    size_t compared = 0;
    for (int i = 0; i < 12; ++i)
    {
        const auto along = [&] { return uniform(random, -0.7f, 0.7f); };
        const gpu::ShadowSphere sphere{.center = {along(), along(), along()}, .radius = 2};
        DrawOptions options{.width = 16, .height = 16, .error_pixels = 0};
        options.shadow_spheres = {&sphere, 1};
        draw(*scene, roomCamera(), options);
        const shared::ShadowMap map = scene->shadows->plan().block.maps[0];
        const auto depths = host().readDepth(renderer().device(), scene->shadows->image(), 0);
        ASSERT_TRUE(depths.ok());
        if (i == 0)
        {
            first = map;
            expected = *depths;
        }
        EXPECT_EQ(map.scale_x, first.scale_x);
        const int dx = static_cast<int>(map.offset_x - first.offset_x);
        const int dy = static_cast<int>(map.offset_y - first.offset_y);
        EXPECT_EQ(static_cast<float>(dx), map.offset_x - first.offset_x);
        for (int y = std::max(0, dy); y < std::min(128, 128 + dy); ++y)
            for (int x = std::max(0, dx); x < std::min(128, 128 + dx); ++x, ++compared)
                ASSERT_NEAR((*depths)[static_cast<size_t>(y * 128 + x)],
                            expected[static_cast<size_t>((y - dy) * 128 + x - dx)], shared::kDepthMargin)
                    << x << " " << y << " moved by " << dx << " " << dy;
    }
    EXPECT_GT(compared, 100000u);
}

/// Add five sides of a room of 4 x 3 x 4 m, whose fronts look inwards: all but the one at its largest z.
void addBox(TestScene& test, uint32_t material)
{
    const uint32_t side = test.addMesh(withMaterial(makeQuad(4, 4), material));
    const uint32_t wall = test.addMesh(withMaterial(makeQuad(4, 3), material));
    test.addInstance(side, lying({0, 0, 0}));
    test.addInstance(side, {{{1, 0, 0, 0}, {0, 0, -1, 3}, {0, 1, 0, 0}}});
    test.addInstance(wall, {{{1, 0, 0, 0}, {0, 1, 0, 1.5f}, {0, 0, 1, -2}}});
    test.addInstance(wall, {{{0, 0, 1, -2}, {0, 1, 0, 1.5f}, {-1, 0, 0, 0}}});
    test.addInstance(wall, {{{0, 0, -1, 2}, {0, 1, 0, 1.5f}, {1, 0, 0, 0}}});
}

void addRoom(TestScene& test, uint32_t material)
{
    addBox(test, material);
    const uint32_t wall = test.addMesh(withMaterial(makeQuad(4, 3), material));
    test.addInstance(wall, {{{-1, 0, 0, 0}, {0, 1, 0, 1.5f}, {0, 0, -1, 2}}});
}

/// No sun shines into a room without windows, although its walls have no thickness and meet in lines.
TEST_F(ShadowImageTest, aClosedRoomIsDarkUnderEverySun)
{
    constexpr int kSuns = 120;
    const shared::Camera inside{
        .position = {1.5f, 1.4f, 1.7f}, .target = {-0.6f, 0.9f, -0.8f}, .y_fov_rad = 1.5f, .z_near = 0.05f};
    const DrawOptions drawn{.width = 160, .height = 120, .error_pixels = 0};
    const auto drawUnder = [&](const LightRecord& record)
    {
        TestScene test;
        addRoom(test, test.addMaterial(plainMaterial()));
        test.addLight(record);
        const PackView pack = test.build();
        return drawShadowed(pack, kFour, drawn, inside);
    };
    LightRecord night = sun({0, -1, 0});
    night.intensity = 0;
    const Image dark = drawUnder(night);
    size_t lit = 0;
    for (int i = 0; i < kSuns; ++i)
    {
        // a spiral over the sphere
        const double height = 1 - (2.0 * i + 1) / kSuns, turn = i * 2.39996322972865332;
        const double across = std::sqrt(1 - height * height);
        const Image image =
            drawUnder(sun({static_cast<float>(across * std::cos(turn)), static_cast<float>(height),
                           static_cast<float>(across * std::sin(turn))}));
        for (size_t pixel = 0; pixel < image.color.size(); ++pixel)
            lit += channel(image.color[pixel], 0) > channel(dark.color[pixel], 0) + 1;
    }
    std::printf("%zu of %d pixels are lit\n", lit, kSuns * 160 * 120);
    // texels that rounding moves across a corner's line
    EXPECT_LE(lit, 3u);
}

/// No sun shines through the corners of a box that is open to the front, beside rays. Its walls have no
/// thickness; some of the suns are within half a degree of a wall's plane.
TEST_F(ShadowImageTest, anOpenBoxIsDarkAlongItsClosedCorners)
{
    constexpr uint32_t kWidth = 160, kHeight = 120, kRim = 3; // the filter's, in pixels
    const shared::Camera front{
        .position = {0, 1.5f, 5.2f}, .target = {0, 1.5f, 0}, .y_fov_rad = 0.8f, .z_near = 0.05f};
    std::vector<Float3> suns{{-0.961f, 0.007f, 0.278f},  {-0.805f, 0.001f, -0.593f},
                             {0.994f, -0.001f, -0.107f}, {0.193f, 0.003f, 0.981f},
                             {-0.556f, -0.831f, 0.004f}, {0.001f, -0.903f, 0.430f},
                             {-0.070f, 0.105f, -0.992f}, {0.970390856f, -0.017f, 0.240940928f}};
    for (int i = 0; i < 30; ++i)
    {
        const double height = 1 - (2.0 * i + 1) / 30, turn = i * 2.39996322972865332;
        const double across = std::sqrt(1 - height * height);
        suns.push_back({static_cast<float>(across * std::cos(turn)), static_cast<float>(height),
                        static_cast<float>(across * std::sin(turn))});
    }
    for (const Float3 direction : suns)
    {
        TestScene test;
        addBox(test, test.addMaterial(plainMaterial()));
        test.addLight(sun(direction));
        const PackView pack = test.build();
        const Image image =
            drawShadowed(pack, kFour, {.width = kWidth, .height = kHeight, .error_pixels = 0}, front);
        const auto expected = reference::renderReference(
            pack,
            {.camera = front, .width = kWidth, .height = kHeight, .samples_per_side = 1, .shadows = true});
        ASSERT_TRUE(expected.ok());
        const auto findBrightest = [&](uint32_t x, uint32_t y)
        {
            int brightest = 0;
            for (uint32_t v = y - kRim; v <= y + kRim; ++v)
                for (uint32_t u = x - kRim; u <= x + kRim; ++u)
                    brightest = std::max(brightest, int{expected->at(u, v)[0]});
            return brightest;
        };
        size_t lit = 0;
        for (uint32_t y = kRim; y + kRim < kHeight; ++y)
            for (uint32_t x = kRim; x + kRim < kWidth; ++x)
                lit += channel(image.color[y * kWidth + x], 0) > findBrightest(x, y) + 2;
        EXPECT_EQ(lit, 0u) << direction.x << ' ' << direction.y << ' ' << direction.z;
    }
}

viewer::Image withoutAlpha(const Image& image)
{
    viewer::Image result(image.width, image.height);
    for (size_t i = 0; i < image.color.size(); ++i)
        for (int c = 0; c < 3; ++c)
            result.rgb[3 * i + static_cast<size_t>(c)] = static_cast<uint8_t>(channel(image.color[i], c));
    return result;
}

/// Depths of 16 bits take half the memory, and no one sees them where steps are small beside texels.
TEST_F(ShadowImageTest, thoseOf16BitsShowTheSameFromHalfTheMemory)
{
    for (const LightRecord& record :
         {sun({0.3f, -1, -0.4f}), light(LightType::spot, {-2, 4, 1}, {2, -4, -1}, 30),
          light(LightType::point, {-0.3f, 0.9f, -0.4f}, {0, -1, 0}, 30)})
    {
        TestScene test;
        const PackView pack = buildRocks(test, 12, record);
        gpu::ShadowOptions options = kFour;
        options.max_maps = 6;
        options.spot_near = 0.2f;
        const Image floats = drawShadowed(pack, options, kSource);
        const VkDeviceSize float_bytes = map_bytes_;
        options.depth = gpu::ShadowDepth::d16;
        const Image fixed = drawShadowed(pack, options, kSource);
        EXPECT_EQ(depth_, gpu::ShadowDepth::d16);
        EXPECT_EQ(2 * map_bytes_, float_bytes);
        keep(fixed, "d16");
        expectTraced(compare(pack, fixed, 3));
        const double shown = viewer::flip(withoutAlpha(floats), withoutAlpha(fixed)).mean();
        const size_t different = countDifferent(floats, fixed);
        std::printf("FLIP %.5f, %zu of %zu pixels differ\n", shown, different, fixed.color.size());
        EXPECT_LE(shown, 0.002);
        EXPECT_GT(different, 0u) << "the steps are there";
    }
}

TEST_F(ShadowImageTest, thoseOf16BitsHave32InASceneThatIsTooDeep)
{
    TestScene test;
    const uint32_t white = test.addMaterial(plainMaterial());
    const uint32_t tile = test.addMesh(withMaterial(makeQuad(0.5f, 0.5f), white));
    test.addInstance(test.addMesh(withMaterial(makeQuad(8, 8), white)), lying({0, 0, 0}));
    test.addInstance(tile, lying({0, 0.3f, 0}));
    test.addInstance(tile, lying({0, -3000, 0}));
    test.addLight(sun({0.3f, -1, -0.4f}));
    const PackView pack = test.build();
    gpu::ShadowOptions options = kFour;
    const Image floats = drawShadowed(pack, options, kSource);
    options.depth = gpu::ShadowDepth::d16;
    const Image asked = drawShadowed(pack, options, kSource);
    EXPECT_EQ(depth_, gpu::ShadowDepth::d32);
    EXPECT_EQ(asked.color, floats.color);
}

/// A plane without casters looks the same with and without shadows.
TEST_F(ShadowImageTest, aPlaneIsFreeOfAcneAtAllAngles)
{
    for (const auto& [spot, depth] : {std::pair{false, gpu::ShadowDepth::d32},
                                      {true, gpu::ShadowDepth::d32},
                                      {false, gpu::ShadowDepth::d16},
                                      {true, gpu::ShadowDepth::d16}})
        for (const uint32_t kernel : {0u, 1u, 2u})
            for (int degrees = 1; degrees <= 89; degrees += 11)
            {
                TestScene test;
                const uint32_t white = test.addMaterial(plainMaterial());
                const uint32_t plane = test.addMesh(withMaterial(makeQuad(40, 40), white));
                test.addInstance(plane, lying({0, 0, 0}));
                // so deep that a step of 16 bits is a third of a texel
                if (depth == gpu::ShadowDepth::d16 && !spot)
                    test.addInstance(plane, lying({0, -1000, 0}));
                const double angle = degrees * kDegree;
                const Float3 shine{static_cast<float>(0.8 * std::sin(angle)),
                                   static_cast<float>(-std::cos(angle)),
                                   static_cast<float>(0.6 * std::sin(angle))};
                test.addLight(spot ? light(LightType::spot, shine * -4.0f, shine, 100) : sun(shine));
                const PackView pack = test.build();
                gpu::ShadowOptions options = kFour;
                options.texels = 128;
                options.kernel = kernel;
                options.depth = depth;
                options.spot_near = depth == gpu::ShadowDepth::d16 ? 0.15f : options.spot_near;
                const DrawOptions drawn{.width = 96, .height = 96, .error_pixels = 0};
                const auto plain = upload(pack);
                const Image shadowed = drawShadowed(pack, options, drawn);
                EXPECT_EQ(depth_, depth) << degrees;
                const Image lit = draw(*plain, roomCamera(), drawn);
                size_t darker = 0;
                for (size_t i = 0; i < lit.color.size(); ++i)
                    darker += channel(shadowed.color[i], 0) < channel(lit.color[i], 0) - 1;
                EXPECT_EQ(darker, 0u) << degrees << " degrees, kernel " << kernel << (spot ? ", spot" : "");
            }
}

/// Rocks whose proxies are the rocks themselves, beside a floor without one.
TEST_F(ShadowImageTest, thoseOfProxiesAreThoseOfRays)
{
    for (const LightRecord& record :
         {sun({0.3f, -1, -0.4f}), light(LightType::point, {0.1f, 1.6f, 0.4f}, {0, -1, 0}, 30)})
    {
        TestScene test;
        addProxy(test.model(), 1, shapes::rock(12, 0.25f), 0, true);
        const PackView pack = buildRocks(test, 12, record);
        gpu::ShadowOptions options = kFour;
        options.max_maps = 6;
        options.casters = gpu::Casters::proxies;
        const auto scene = upload(pack, {.shadows = options});
        const Image image = draw(*scene, roomCamera(), kSource);
        keep(image, "proxies");
        expectTraced(compare(pack, image, 3));
        const auto [clusters, triangles] = countCasters(*scene);
        EXPECT_GT(triangles, 0u);
        EXPECT_EQ(triangles % (12 * 12 * 12), 0u) << "whole rocks";
        EXPECT_LE(clusters, scene->shadows->statistics().maps) << "the floor alone";
    }
}

/// More maps are stale at once than have lists of their own.
TEST_F(ShadowImageTest, thoseOfProxiesAreDrawnInRounds)
{
    TestScene test;
    addProxy(test.model(), 1, shapes::rock(12, 0.25f), 0, true);
    for (int i = 0; i < 12; ++i)
    {
        const float across = 0.5f * static_cast<float>(i) - 3;
        test.addLight(light(LightType::spot, {across, 3, 2}, {-0.3f * across, -3, -2}, 10));
    }
    const PackView pack = buildRocks(test, 12, light(LightType::spot, {-2, 4, 1}, {2, -4, -1}, 30));
    gpu::ShadowOptions options{.max_maps = 13, .texels = 256};
    const Image expected = drawShadowed(pack, options, kSource);
    EXPECT_EQ(statistics_.drawn_maps, 13u);
    options.casters = gpu::Casters::proxies;
    const auto scene = upload(pack, {.shadows = options});
    const Image image = draw(*scene, roomCamera(), kSource);
    EXPECT_LE(countCasters(*scene).second, 13u * 3 * 12 * 12 * 12) << "three rocks a map";
    size_t different = 0;
    for (size_t i = 0; i < image.color.size(); ++i)
        different += std::abs(channel(image.color[i], 0) - channel(expected.color[i], 0)) > 4;
    EXPECT_LE(different, 60u);
    EXPECT_GT(countDifferent(draw(*upload(pack), roomCamera(), kSource), image), 1000u);
}

/// A proxy lies around its ball, whose lit half must not be in its shadow, and a mirrored one's either.
TEST_F(ShadowImageTest, aProxyDoesNotShadowItsOwnSurface)
{
    constexpr float kDistance = 0.1f;
    for (const bool is_closed : {true, false})
        for (const float mirror : {1.0f, -1.0f})
            for (const LightRecord& record :
                 {sun({0.6f, -1, -1}), light(LightType::spot, {-1.5f, 3, 3}, {0.5f, -1, -1}, 60)})
            {
                TestScene test;
                const uint32_t white = test.addMaterial(plainMaterial());
                const uint32_t ball = test.addMesh(withMaterial(shapes::rock(24, 0), white));
                mesh::SourceMesh around = shapes::rock(10, 0);
                for (Float3& position : around.positions)
                    position = position * (1 + kDistance);
                addProxy(test.model(), ball, around, kDistance, is_closed);
                test.addInstance(ball, Affine3{{{mirror, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}});
                test.addLight(record);
                const PackView pack = test.build();
                gpu::ShadowOptions options = kFour;
                const Image lit = draw(*upload(pack), roomCamera(), kSource);
                const Image own = drawShadowed(pack, options, kSource);
                options.casters = gpu::Casters::proxies;
                const Image image = drawShadowed(pack, options, kSource);
                keep(image, "ball");
                size_t darker = 0, bright = 0;
                for (size_t i = 0; i < lit.color.size(); ++i)
                {
                    bright += channel(own.color[i], 0) > 128;
                    darker += channel(image.color[i], 0) < channel(own.color[i], 0) - 4;
                }
                EXPECT_GT(bright, 1500u);
                EXPECT_EQ(darker, 0u) << is_closed << mirror;
            }
}

/// The back of a closed proxy stays where it is: a tile that is thinner than its proxy's distance casts its
/// whole shadow on a floor that is nearer than that.
TEST_F(ShadowImageTest, shadowsOfThinProxiesStayAttached)
{
    const auto drawTile = [&](gpu::Casters casters, uint32_t maps = 4)
    {
        TestScene test;
        const uint32_t white = test.addMaterial(plainMaterial());
        test.addInstance(test.addMesh(withMaterial(makeQuad(8, 8), white)), lying({0, 0, 0}));
        mesh::SourceMesh tile = shapes::rock(1, 0);
        const float reach =
            tile.positions.front().x > 0 ? tile.positions.front().x : -tile.positions.front().x;
        for (Float3& position : tile.positions)
            position = position * (0.5f / reach);
        for (Float3& position : tile.positions)
            position.y = 0.5f + 0.1f * position.y;
        const uint32_t mesh = test.addMesh(withMaterial(tile, white));
        addProxy(test.model(), mesh, tile, 0.5f, true);
        test.addInstance(mesh, Affine3{});
        test.addLight(sun({0.3f, -1, -1}));
        gpu::ShadowOptions options = kFour;
        options.casters = casters;
        const PackView pack = test.build();
        return maps == 0 ? draw(*upload(pack), roomCamera(), kSource) : drawShadowed(pack, options, kSource);
    };
    const Image expected = drawTile(gpu::Casters::clusters);
    const Image drawn = drawTile(gpu::Casters::proxies);
    keep(drawn, "tile");
    EXPECT_LE(countDifferent(expected, drawn), 150u);
    EXPECT_GT(countDifferent(drawTile(gpu::Casters::clusters, 0), drawn), 400u) << "or there is no shadow";
}

TEST_F(ShadowImageTest, holesOfAMaskCastNone)
{
    const auto drawUnder = [&](float alpha)
    {
        TestScene test;
        const uint32_t white = test.addMaterial(plainMaterial());
        MaterialRecord masked = plainMaterial();
        masked.alpha_mode = static_cast<uint32_t>(AlphaMode::mask);
        masked.base_color.w = alpha;
        test.addInstance(test.addMesh(withMaterial(makeQuad(8, 8), white)), lying({0, 0, 0}));
        const uint32_t sheet = test.addMesh(withMaterial(makeQuad(2, 2), test.addMaterial(masked)));
        test.addInstance(sheet, lying({0, 4, 0})); // outside the frame, above the visible region
        test.addLight(sun({0, -1, 0}));
        const PackView pack = test.build();
        return channel(drawShadowed(pack, kFour, kSource).at(kSize / 2, kSize / 2), 0);
    };
    EXPECT_LT(drawUnder(0.6f), drawUnder(0.4f) - 40);
}

TEST_F(ShadowImageTest, unlitSurfacesCastNone)
{
    const auto drawUnder = [&](uint32_t flags)
    {
        TestScene test;
        MaterialRecord sky = plainMaterial();
        sky.flags = kMaterialDoubleSided | flags;
        test.addInstance(test.addMesh(withMaterial(makeQuad(8, 8), test.addMaterial(plainMaterial()))),
                         lying({0, 0, 0}));
        test.addInstance(test.addMesh(withMaterial(makeQuad(8, 8), test.addMaterial(sky))), lying({0, 4, 0}));
        test.addLight(sun({0, -1, 0}));
        const PackView pack = test.build();
        return channel(drawShadowed(pack, kFour, kSource).at(kSize / 2, kSize / 2), 0);
    };
    EXPECT_LT(drawUnder(0), drawUnder(kMaterialUnlit) - 40);
}

TEST_F(ShadowImageTest, whatIsBeyondTheCapacityIsCounted)
{
    TestScene test;
    const uint32_t white = test.addMaterial(plainMaterial());
    test.addInstance(test.addMesh(withMaterial(makeQuad(8, 8), white)), lying({0, 0, 0}));
    for (uint32_t i = 0; i < 20; ++i)
        test.addLight(light(LightType::spot, {0, 3, 0}, {0, -1, 0}, 1));
    test.addLight(light(LightType::point, {0, 3, 0}, {0, -1, 0}, 1));
    test.addLight(sun({0, -1, 0}));
    const PackView pack = test.build();
    const DrawOptions small{.width = 16, .height = 16};
    gpu::ShadowOptions options{.max_maps = 6, .texels = 32, .splits = 3};
    drawShadowed(pack, options, small);
    // The sun takes three layers, the first three spots one each. The lamp is the last.
    EXPECT_EQ(statistics_.maps, 6u);
    EXPECT_EQ(statistics_.drawn_maps, 6u);
    EXPECT_EQ(statistics_.dropped_maps, 17u + 6u);
    EXPECT_EQ(statistics_.unshadowed_lights, 17u + 1u);
}

} // namespace hearth::test

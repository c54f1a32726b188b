// Tests exposure, bloom, photo filter and the final pass against a twin on the CPU that begins with the
// frame's linear colours.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/half.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/shapes.h"
#include "tests/support/test_scene.h"

#include <array>
#include <cmath>
#include <numeric>

namespace hearth::test
{

namespace
{

using namespace formats;
using gpu::PostSettings;
using gpu::PostSupport;

/// Linear colours in doubles.
struct Picture
{
    int width = 0, height = 0;
    std::vector<std::array<double, 3>> texels;

    Picture(int w, int h) : width(w), height(h), texels(static_cast<size_t>(w * h)) {}
    std::array<double, 3>& at(int x, int y) { return texels[static_cast<size_t>(y * width + x)]; }
    const std::array<double, 3>& clamped(int x, int y) const
    {
        const int cx = std::clamp(x, 0, width - 1), cy = std::clamp(y, 0, height - 1);
        return texels[static_cast<size_t>(cy * width + cx)];
    }

    /// Bilinear; coordinates from 0 to 1.
    std::array<double, 3> sample(double u, double v) const
    {
        const double x = u * width - 0.5, y = v * height - 0.5;
        const double fx = x - std::floor(x), fy = y - std::floor(y);
        const int ix = static_cast<int>(std::floor(x)), iy = static_cast<int>(std::floor(y));
        std::array<double, 3> sum{};
        for (int j = 0; j < 2; ++j)
            for (int i = 0; i < 2; ++i)
                for (size_t c = 0; c < 3; ++c)
                    sum[c] += (i == 0 ? 1 - fx : fx) * (j == 0 ? 1 - fy : fy) * clamped(ix + i, iy + j)[c];
        return sum;
    }

    std::array<double, 3> mean() const
    {
        std::array<double, 3> sum{};
        for (const auto& texel : texels)
            for (size_t c = 0; c < 3; ++c)
                sum[c] += texel[c] / static_cast<double>(texels.size());
        return sum;
    }
};

double twinLuminance(const std::array<double, 3>& c)
{
    return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
}

Picture twinDown(const Picture& source, bool dims_fireflies)
{
    Picture level(std::max(source.width / 2, 1), std::max(source.height / 2, 1));
    // the five squares by their corners, in texels of the source from the middle
    constexpr struct
    {
        double x, y, side, weight;
    } kSquares[] = {
        {-1, -1, 2, 0.5}, {-2, -2, 2, 0.125}, {0, -2, 2, 0.125}, {-2, 0, 2, 0.125}, {0, 0, 2, 0.125}};
    for (int y = 0; y < level.height; ++y)
        for (int x = 0; x < level.width; ++x)
        {
            const double u = (x + 0.5) / level.width, v = (y + 0.5) / level.height;
            std::array<double, 3> sum{};
            double weights = 0;
            for (const auto& square : kSquares)
            {
                std::array<double, 3> mean{};
                for (int corner = 0; corner < 4; ++corner)
                {
                    const auto tap =
                        source.sample(u + (square.x + (corner & 1) * square.side) / source.width,
                                      v + (square.y + (corner >> 1) * square.side) / source.height);
                    for (size_t c = 0; c < 3; ++c)
                        mean[c] += tap[c] / 4;
                }
                const double weight =
                    dims_fireflies ? square.weight / (1 + twinLuminance(mean)) : square.weight;
                weights += weight;
                for (size_t c = 0; c < 3; ++c)
                    sum[c] += weight * mean[c];
            }
            for (size_t c = 0; c < 3; ++c)
                level.at(x, y)[c] = sum[c] / weights;
        }
    return level;
}

/// Add the levels: each has a fifth of the weight.
Picture twinBloom(const Picture& radiance)
{
    std::vector<Picture> levels = {twinDown(radiance, true)};
    while (levels.size() < 5)
        levels.push_back(twinDown(levels.back(), false));
    Picture sum = levels[4];
    for (size_t level = 4; level-- > 0;)
    {
        Picture next = levels[level];
        for (int y = 0; y < next.height; ++y)
            for (int x = 0; x < next.width; ++x)
                for (int j = -1; j <= 1; ++j)
                    for (int i = -1; i <= 1; ++i)
                    {
                        const auto tap = sum.sample((x + 0.5) / next.width + double(i) / sum.width,
                                                    (y + 0.5) / next.height + double(j) / sum.height);
                        for (size_t c = 0; c < 3; ++c)
                            next.at(x, y)[c] += tap[c] * (2 - std::abs(i)) * (2 - std::abs(j)) / 16 *
                                                static_cast<double>(4 - level);
                    }
        for (auto& texel : next.texels)
            for (double& value : texel)
                value /= static_cast<double>(5 - level);
        sum = next;
    }
    return sum;
}

double twinCurve(double radiance)
{
    const double x = std::max(0.0, radiance - 0.004);
    return std::pow(x * (6.2 * x + 0.5) / (x * (6.2 * x + 1.7) + 0.06), 2.2);
}

double srgb(double linear)
{
    const double c = std::clamp(linear, 0.0, 1.0);
    return 255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055);
}

/// Return the bytes of a pixel, not rounded.
std::array<double, 3> twinFinish(const std::array<double, 3>& color, double stops,
                                 const gpu::PhotoFilter& filter)
{
    std::array<double, 3> display{}, filtered{};
    const double glass[] = {double{filter.color.x}, double{filter.color.y}, double{filter.color.z}};
    for (size_t c = 0; c < 3; ++c)
    {
        display[c] = twinCurve(color[c] * std::exp2(stops));
        filtered[c] = display[c] * (1 - double{filter.density} + double{filter.density} * glass[c]);
    }
    const double before = twinLuminance(display), after = twinLuminance(filtered);
    for (size_t c = 0; c < 3; ++c)
        filtered[c] = srgb(after > 0 ? filtered[c] * before / after : 0);
    return filtered;
}

class PostTest : public GpuTest
{
protected:
    static constexpr uint32_t kWidth = 64, kHeight = 48;

    static void TearDownTestSuite()
    {
        for (auto& renderer : renderers_)
            renderer.reset();
        GpuTest::TearDownTestSuite();
    }

    static gpu::Renderer& rendererWith(PostSupport support)
    {
        auto& renderer = renderers_[static_cast<size_t>(support)];
        if (renderer == nullptr)
        {
            gpu::RendererOptions options = testRendererOptions();
            options.post = support;
            auto created = gpu::Renderer::create(host().description(), options);
            HEARTH_ASSERT(created.ok() && (*created)->prepareOverdraw().ok());
            renderer = std::move(*created);
        }
        return *renderer;
    }

    static void run(const std::function<void(VkCommandBuffer)>& record)
    {
        HEARTH_ASSERT(host()
                          .run(
                              [&](VkCommandBuffer commands)
                              {
                                  record(commands);
                                  return success();
                              })
                          .ok());
    }

    static std::unique_ptr<gpu::Scene> uploadTo(gpu::Renderer& r, const PackView& pack)
    {
        std::unique_ptr<gpu::Scene> scene;
        run(
            [&](VkCommandBuffer commands)
            {
                auto uploaded = r.upload(pack, commands, {});
                HEARTH_ASSERT(uploaded.ok());
                scene = std::move(*uploaded);
            });
        scene->staging.reset();
        return scene;
    }

    static gpu::FrameTargets createTargets(const gpu::Renderer& r, gpu::TargetOptions options)
    {
        options.keeps_visibility = true;
        auto targets = r.createTargets({kWidth, kHeight}, options);
        HEARTH_ASSERT(targets.ok());
        return std::move(*targets);
    }

    /// Draw a frame.
    static void drawTo(const gpu::Renderer& r, const gpu::Scene& scene, gpu::FrameTargets& targets,
                       const PostSettings& post, uint32_t view = shared::kViewFinal, bool in_parts = false)
    {
        gpu::FrameInput input{.view = makeView(scene, camera(), {.width = kWidth, .height = kHeight}),
                              .shading = {.debug_view = view, .post = post}};
        run(
            [&](VkCommandBuffer commands)
            {
                if (!in_parts)
                    return r.record(commands, scene, targets, input);
                r.recordCull(commands, scene, targets, input);
                r.recordVisibility(commands, scene, targets, input);
                r.recordMaterials(commands, scene, targets, input);
            });
    }

    static std::vector<uint32_t> readColor(const gpu::Renderer& r, const gpu::FrameTargets& targets)
    {
        const auto bytes = host().read(r.device(), targets.color(), 4);
        HEARTH_ASSERT(bytes.ok());
        std::vector<uint32_t> colors(bytes->size() / 4);
        std::memcpy(colors.data(), bytes->data(), bytes->size());
        return colors;
    }

    /// Read an image of half or packed floats.
    static Picture readLinear(const gpu::Renderer& r, const gpu::Image& image)
    {
        const bool packed = image.format == VK_FORMAT_B10G11R11_UFLOAT_PACK32;
        const auto bytes = host().readSampled(r.device(), image, packed ? 4 : 8);
        HEARTH_ASSERT(bytes.ok());
        Picture picture(static_cast<int>(image.extent.width), static_cast<int>(image.extent.height));
        for (size_t i = 0; i < picture.texels.size(); ++i)
        {
            std::array<uint16_t, 4> halves{};
            if (packed)
            {
                // a half float without sign, and with 6, 6 and 5 of its 10 bits of fraction
                uint32_t word;
                std::memcpy(&word, &(*bytes)[4 * i], 4);
                halves = {static_cast<uint16_t>((word & 0x7FF) << 4),
                          static_cast<uint16_t>((word >> 11 & 0x7FF) << 4),
                          static_cast<uint16_t>((word >> 22) << 5), 0};
            }
            else
                std::memcpy(halves.data(), &(*bytes)[8 * i], 8);
            for (size_t c = 0; c < 3; ++c)
                picture.texels[i][c] = double{floatFromHalf(halves[c])};
        }
        return picture;
    }

    static shared::Camera camera()
    {
        return {.position = {0, 0, 4}, .target = {}, .y_fov_rad = 0.8f, .z_near = 0.01f};
    }

    /// Rocks under the sky, and lamps of unlike colour and brightness; dark at the sides.
    static void fill(TestScene& test)
    {
        std::mt19937 random(5);
        for (uint32_t i = 0; i < 8; ++i)
        {
            MaterialRecord material = plainMaterial();
            material.base_color = {uniform(random, 0, 1), uniform(random, 0, 1), uniform(random, 0, 1), 1};
            if (i % 2 == 1)
                material.emissive =
                    Float3{uniform(random, 0, 1), uniform(random, 0, 1), uniform(random, 0, 1)} *
                    static_cast<float>(i * i);
            test.addInstance(
                test.addMesh(withMaterial(shapes::rock(8, 0.2f, i + 1), test.addMaterial(material))),
                randomAffine(random, 1.5f));
        }
    }

    /// Largest step between a finished image and that of the twin.
    static double compareWithTwin(const std::vector<uint32_t>& colors, const Picture& radiance,
                                  VkExtent2D output, const PostSettings& post)
    {
        const Picture bloom = twinBloom(radiance);
        const double strength = double{post.bloom.strength};
        double largest = 0;
        for (uint32_t y = 0; y < output.height; ++y)
            for (uint32_t x = 0; x < output.width; ++x)
            {
                const double u = (x + 0.5) / output.width, v = (y + 0.5) / output.height;
                std::array<double, 3> color = radiance.sample(u, v);
                const std::array<double, 3> glow = bloom.sample(u, v);
                for (size_t c = 0; c < 3; ++c)
                    color[c] = post.bloom.mode == gpu::BloomMode::add
                                   ? color[c] + strength * glow[c]
                                   : (1 - strength) * color[c] + strength * glow[c];
                const auto want = twinFinish(color, double{post.exposure_stops}, post.photo_filter);
                for (int c = 0; c < 3; ++c)
                    largest = std::max(largest, std::abs(channel(colors[y * output.width + x], c) -
                                                         want[static_cast<size_t>(c)]));
            }
        return largest;
    }

    static int largestStep(const std::vector<uint32_t>& a, const std::vector<uint32_t>& b)
    {
        HEARTH_ASSERT(a.size() == b.size());
        int largest = 0;
        for (size_t i = 0; i < a.size(); ++i)
            for (int c = 0; c < 3; ++c)
                largest = std::max(largest, std::abs(channel(a[i], c) - channel(b[i], c)));
        return largest;
    }

    static std::array<std::unique_ptr<gpu::Renderer>, 4> renderers_;
};

std::array<std::unique_ptr<gpu::Renderer>, 4> PostTest::renderers_;

} // namespace

TEST_F(PostTest, theFinalPassIsItsTwin)
{
    TestScene test;
    fill(test);
    const PackView pack = test.build();
    gpu::Renderer& r = rendererWith(PostSupport::half);
    const auto scene = uploadTo(r, pack);
    for (const VkExtent2D output : {VkExtent2D{kWidth, kHeight}, VkExtent2D{90, 30}})
    {
        gpu::FrameTargets targets =
            createTargets(r, {.may_bloom = true, .output = output, .keeps_radiance = true});
        for (const PostSettings& post : {PostSettings{}, PostSettings{.exposure_stops = 1.5f},
                                         PostSettings{.photo_filter = {{0.8f, 0.3f, 0.05f}, 0.6f}},
                                         PostSettings{.bloom = {0.25f, gpu::BloomMode::mix}},
                                         PostSettings{.exposure_stops = -1,
                                         .photo_filter = {{0.1f, 0.3f, 1}, 0.3f},
                                         .bloom = {0.2f, gpu::BloomMode::add}}})
        {
            drawTo(r, *scene, targets, post);
            const Picture radiance = readLinear(r, targets.post().radiance());
            EXPECT_LE(compareWithTwin(readColor(r, targets), radiance, output, post), 1)
                << output.width << " " << post.bloom.strength << " " << post.exposure_stops;
        }
    }
}

TEST_F(PostTest, inTheTileIsTheSameAsInAFinalPass)
{
    TestScene test;
    fill(test);
    const PackView pack = test.build();
    gpu::Renderer& in_tile = rendererWith(PostSupport::in_tile);
    gpu::Renderer& finished = rendererWith(PostSupport::half);
    gpu::Renderer& packed = rendererWith(PostSupport::packed);
    const auto plain_scene = upload(pack), tile_scene = uploadTo(in_tile, pack),
               finished_scene = uploadTo(finished, pack), packed_scene = uploadTo(packed, pack);
    gpu::FrameTargets tile = createTargets(in_tile, {}),
                      final_targets = createTargets(finished, {.keeps_radiance = true}),
                      packed_targets = createTargets(packed, {.keeps_radiance = true});
    const Image plain = draw(*plain_scene, camera(), {.width = kWidth, .height = kHeight});
    for (const PostSettings& post :
         {PostSettings{}, PostSettings{.exposure_stops = 2, .photo_filter = {{0.8f, 0.3f, 0.05f}, 0.6f}}})
    {
        drawTo(in_tile, *tile_scene, tile, post);
        drawTo(finished, *finished_scene, final_targets, post);
        drawTo(packed, *packed_scene, packed_targets, post);
        const std::vector<uint32_t> colors = readColor(in_tile, tile);
        EXPECT_LE(largestStep(colors, readColor(finished, final_targets)), 1);
        EXPECT_LE(largestStep(colors, readColor(packed, packed_targets)), 4) << "6 bits of fraction";
        if (isNeutral(post))
            EXPECT_LE(largestStep(colors, plain.color), 1) << "sums may be contracted otherwise";
        else
            EXPECT_GT(largestStep(colors, plain.color), 20);
    }
    // a renderer with final passes draws frames without one, too
    gpu::FrameTargets free_targets = createTargets(packed, {.may_bloom = true});
    drawTo(packed, *packed_scene, free_targets, {.bloom = {0.3f}});
    const std::vector<uint32_t> blooming = readColor(packed, free_targets);
    drawTo(packed, *packed_scene, free_targets, {});
    EXPECT_LE(largestStep(readColor(packed, free_targets), plain.color), 1);
    EXPECT_GT(largestStep(blooming, plain.color), 5);
    drawTo(packed, *packed_scene, free_targets, {.bloom = {0.3f}}, shared::kViewFinal, true);
    EXPECT_EQ(readColor(packed, free_targets), blooming) << "in parts";
}

TEST_F(PostTest, bloomKeepsTheMean)
{
    TestScene test;
    fill(test);
    const PackView pack = test.build();
    for (const PostSupport support : {PostSupport::packed, PostSupport::half})
    {
        gpu::Renderer& r = rendererWith(support);
        const auto scene = uploadTo(r, pack);
        gpu::FrameTargets targets = createTargets(r, {.may_bloom = true, .keeps_radiance = true});
        drawTo(r, *scene, targets, {.bloom = {0.1f}});
        // the first level dims fireflies, by intent; from there on the sum has its light
        const auto level = readLinear(r, targets.post().image(gpu::bloomLevel(1))).mean();
        const auto sum = readLinear(r, targets.post().image(gpu::bloomSum(1))).mean();
        for (size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(sum[c] / level[c], 1, 0.005) << c;
    }
}

TEST_F(PostTest, bloomKeepsAFlatImage)
{
    TestScene test;
    MaterialRecord material = plainMaterial();
    material.flags = kMaterialUnlit;
    material.base_color = {0.3f, 0.6f, 0.9f, 1};
    test.addInstance(test.addMesh(withMaterial(makeQuad(9, 9), test.addMaterial(material))), Affine3{});
    const PackView pack = test.build();
    for (const PostSupport support : {PostSupport::packed, PostSupport::half})
    {
        gpu::Renderer& r = rendererWith(support);
        const auto scene = uploadTo(r, pack);
        gpu::FrameTargets targets = createTargets(r, {.may_bloom = true, .keeps_radiance = true});
        drawTo(r, *scene, targets, {.bloom = {0.5f}});
        const Picture radiance = readLinear(r, targets.post().radiance());
        const Picture sum = readLinear(r, targets.post().image(gpu::bloomSum(1)));
        for (const auto& texel : sum.texels)
            for (size_t c = 0; c < 3; ++c)
                ASSERT_NEAR(texel[c] / radiance.texels[0][c], 1, 0.0005);
        drawTo(r, *scene, targets, {});
        for (const uint32_t color : readColor(r, targets))
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(channel(color, c), srgb(0.3 * (c + 1)), support == PostSupport::half ? 1 : 2);
    }
}

TEST_F(PostTest, unlitColoursPassAllWaysUnchanged)
{
    // a ramp of all bytes
    std::vector<uint32_t> texels(256);
    for (uint32_t i = 0; i < 256; ++i)
        texels[i] = 0xFF000000u | (255 - i) << 16 | i << 8 | i;
    TestScene test;
    MaterialRecord material = plainMaterial();
    material.flags = kMaterialUnlit;
    material.base_color_texture = makeTextureRef(test.addImage(TexelFormat::rgba8_srgb, 256, 1, texels));
    material.base_color_texture.nearest = 1;
    test.addInstance(test.addMesh(withMaterial(makeQuad(4, 4), test.addMaterial(material))), Affine3{});
    const PackView pack = test.build();
    const auto plain_scene = upload(pack);
    const Image plain = draw(*plain_scene, camera(), {.width = kWidth, .height = kHeight});
    gpu::Renderer& in_tile = rendererWith(PostSupport::in_tile);
    const auto tile_scene = uploadTo(in_tile, pack);
    gpu::FrameTargets tile = createTargets(in_tile, {});
    drawTo(in_tile, *tile_scene, tile, {});
    EXPECT_EQ(readColor(in_tile, tile), plain.color);
    for (const PostSupport support : {PostSupport::packed, PostSupport::half})
    {
        gpu::Renderer& r = rendererWith(support);
        const auto scene = uploadTo(r, pack);
        gpu::FrameTargets targets = createTargets(r, {.keeps_radiance = true});
        drawTo(r, *scene, targets, {});
        EXPECT_LE(largestStep(readColor(r, targets), plain.color), support == PostSupport::half ? 1 : 2);
    }
}

TEST_F(PostTest, debugViewsPassUnchanged)
{
    TestScene test;
    fill(test);
    const PackView pack = test.build();
    const auto plain_scene = upload(pack);
    gpu::Renderer& r = rendererWith(PostSupport::half);
    const auto scene = uploadTo(r, pack);
    for (const uint32_t view : {shared::kViewNormals, shared::kViewClusters, shared::kViewOverdraw})
    {
        // new ones: overdraw depends on the depth of an earlier frame
        gpu::FrameTargets targets = createTargets(r, {.may_bloom = true, .keeps_radiance = true});
        const Image plain =
            draw(*plain_scene, camera(), {.width = kWidth, .height = kHeight, .debug_view = view});
        drawTo(r, *scene, targets,
               {.exposure_stops = 2, .automatic_exposure = gpu::AutomaticExposure{}, .bloom = {0.5f}}, view);
        EXPECT_LE(largestStep(readColor(r, targets), plain.color), 1) << view;
    }
}

TEST_F(PostTest, automaticExposureGoesToTheKeyAndRepeats)
{
    TestScene test;
    fill(test);
    const PackView pack = test.build();
    gpu::Renderer& r = rendererWith(PostSupport::packed);
    const auto scene = uploadTo(r, pack);
    const auto drawFrames = [&]
    {
        gpu::FrameTargets targets = createTargets(r, {.may_bloom = true, .keeps_radiance = true});
        std::vector<float> stops;
        const auto draw = [&](float key)
        {
            drawTo(r, *scene, targets,
                   {.automatic_exposure =
                        gpu::AutomaticExposure{.key = key, .time_constant = 0.5f, .time_step = 0.1f}});
            const auto bytes =
                host().readSampled(r.device(), targets.post().image(gpu::FrameResource::exposure), 4);
            HEARTH_ASSERT(bytes.ok());
            stops.emplace_back();
            std::memcpy(&stops.back(), bytes->data(), 4);
        };
        draw(0.18f);
        draw(0.18f);
        for (int frame = 0; frame < 40; ++frame)
            draw(0.72f);
        // the formula, of the last level
        const Picture level = readLinear(r, targets.post().image(gpu::bloomLevel(5)));
        double sum = 0;
        for (const auto& texel : level.texels)
            sum += std::log2(std::max(twinLuminance(texel), std::exp2(-10)));
        const double wanted = std::log2(0.18) - sum / static_cast<double>(level.texels.size());
        EXPECT_EQ(stops[0], 0) << "no light before the first frame";
        EXPECT_NEAR(stops[1], wanted, 1e-4) << "at once, for want of a history";
        for (size_t frame = 2; frame < stops.size(); ++frame)
            EXPECT_NEAR(stops[frame],
                        wanted + 2 * (1 - std::exp(-0.1 / 0.5 * static_cast<double>(frame - 1))), 1e-3);
        EXPECT_NEAR(stops.back(), wanted + 2, 1e-3);
        return std::pair(stops, readColor(r, targets));
    };
    const auto first = drawFrames();
    EXPECT_EQ(drawFrames(), first) << "bit for bit";
}

TEST_F(PostTest, anotherWayDrawsTheSameBloom)
{
    TestScene test;
    fill(test);
    const PackView pack = test.build();
    const auto drawBy = [&](gpu::Renderer& r)
    {
        const auto scene = uploadTo(r, pack);
        gpu::FrameTargets targets = createTargets(r, {.may_bloom = true, .output = {80, 60}});
        drawTo(r, *scene, targets, {.exposure_stops = 1, .bloom = {0.2f}});
        return readColor(r, targets);
    };
    gpu::Renderer& r = rendererWith(PostSupport::packed);
    const gpu::FrameWay other =
        r.way() == gpu::FrameWay::separate ? gpu::FrameWay::merged : gpu::FrameWay::separate;
    auto created = gpu::Renderer::create(host().description(), {.way = other, .post = PostSupport::packed});
    ASSERT_TRUE(created.ok());
    EXPECT_EQ(drawBy(**created), drawBy(r));
}

} // namespace hearth::test

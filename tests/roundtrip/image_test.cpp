// Tests final images: every view shows something, and the final one matches ray tracing with the
// specification's formulas.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/scene/animation.h"
#include "runtime/pack/pack.h"
#include "tests/reference/flip.h"
#include "tests/reference/tracer/reference_renderer.h"
#include "tests/roundtrip/draw_fixture.h"

#include <cstdio>
#include <cstdlib>
#include <set>

namespace hearth::roundtrip
{
namespace
{

using ImageTest = DrawTest;
using reference::Image;

size_t colorCount(const Image& image)
{
    std::set<std::array<uint8_t, 3>> colors;
    for (size_t i = 0; i < image.rgb.size(); i += 3)
        colors.insert({image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]});
    return colors.size();
}

/// Mean of two by two pixels in linear light.
Image halved(const Image& image)
{
    Image half(image.width / 2, image.height / 2);
    for (size_t y = 0; y < half.height; ++y)
        for (size_t x = 0; x < half.width; ++x)
            for (size_t c = 0; c < 3; ++c)
            {
                double sum = 0;
                for (const size_t dy : {0u, 1u})
                    for (const size_t dx : {0u, 1u})
                        sum += reference::linearFromSrgb(image.at(2 * x + dx, 2 * y + dy)[c] / 255.0);
                half.at(x, y)[c] = static_cast<uint8_t>(reference::srgbFromLinear(sum / 4) * 255 + 0.5);
            }
    return half;
}

/// Write an image for inspection if HEARTH_KEEP_IMAGES names a folder.
void keep(const Image& image, const std::string& name)
{
    const char* const folder = std::getenv("HEARTH_KEEP_IMAGES");
    if (folder == nullptr)
        return;
    EXPECT_TRUE(reference::writePng(std::string(folder) + "/" + name + ".png", image).ok());
}

TEST_F(ImageTest, everyViewShowsItsOwn)
{
    const CookedSample& sample = cookedSample({"room"});
    const GpuScene scene = device().upload(sample.pack());
    const NamedView named = makeViews(sample.pack())[3];
    std::vector<Image> images;
    for (const uint32_t view : {shared::kViewFinal, shared::kViewClusters, shared::kViewLod,
                                shared::kViewTriangles, shared::kViewNormals, shared::kViewDepth})
    {
        const DrawnFrame drawn = scene.draw(named.frame(sample.pack()), view);
        EXPECT_GT(colorCount(drawn.image), 30u) << "view " << view;
        for (const Image& other : images)
            EXPECT_NE(other.rgb, drawn.image.rgb) << "view " << view;
        images.push_back(drawn.image);
        keep(drawn.image, "view_" + std::to_string(view));
    }
}

TEST_F(ImageTest, theFinalViewIsWhatRaysGive)
{
    for (const SampleSpec& spec : {SampleSpec{"rock", 40000, 256},
                                   {"room", 0, 256},
                                   {"character", 20000},
                                   {"transforms", 3000},
                                   {"terrain", 30000, 256},
                                   {"grass", 60000}})
    {
        const CookedSample& sample = cookedSample(spec);
        const GpuScene scene = device().upload(sample.pack());
        NamedView named = makeViews(sample.pack())[spec.kind == "room" ? 3 : 0];
        named.view.width = 384;
        named.view.height = 384;
        named.view.error_pixels = 1;
        const Image drawn = halved(scene.draw(named.frame(sample.pack())).image);

        reference::ReferenceOptions options;
        options.camera = named.view.camera;
        options.width = 192;
        options.height = 192;
        const auto expected = reference::renderReference(sample.pack(), options);
        ASSERT_TRUE(expected.ok()) << formatMessage(expected.error());
        const reference::FlipMap map = reference::flip(*expected, drawn);
        keep(drawn, spec.kind + "_gpu");
        keep(*expected, spec.kind + "_rays");
        keep(reference::makeFlipImage(map), spec.kind + "_flip");
        std::printf("%-10s FLIP %.4f\n", spec.kind.c_str(), map.mean());
        EXPECT_LT(map.mean(), 0.05) << spec.kind;
    }
}

/// Pose of a pack's clip at a time.
formats::ScenePose poseAt(const formats::PackView& pack, uint32_t clip, double seconds)
{
    const formats::AnimationTables tables = formats::animationTables(pack);
    formats::ScenePose pose = formats::restPose(tables);
    formats::sampleAnimation(tables, tables.animations[clip], seconds, pose);
    return pose;
}

struct PosedImage
{
    std::string name;
    uint32_t clip = 0;
    std::string seconds;
    std::array<float, 7> camera; ///< as in hearth-render's option
};

/// Draw a pose with hearth-render and with rays, and compare.
void expectWhatRaysGive(const std::string& file, const formats::PackView& pack, const PosedImage& posed,
                        const ScratchFolder& folder)
{
    SCOPED_TRACE(posed.name);
    const std::string image = folder.path(posed.name + ".png");
    std::string camera;
    for (const float number : posed.camera)
        camera += (camera.empty() ? "" : ",") + std::to_string(number);
    const auto end = runProgram(Program::render,
                                {file, "-o", image, "--samples", "1", "--size", "512x512", "--camera", camera,
                                 "--animation", std::to_string(posed.clip), "--time", posed.seconds});
    ASSERT_EQ(end.exit_code, 0) << end.errors;
    const auto drawn = reference::readPng(image);
    ASSERT_TRUE(drawn.ok());

    const formats::ScenePose pose = poseAt(pack, posed.clip, std::stod(posed.seconds));
    const auto& c = posed.camera;
    reference::ReferenceOptions options;
    options.camera = {.position = {c[0], c[1], c[2]},
                      .target = {c[3], c[4], c[5]},
                      .y_fov_rad = c[6] * 0.017453293f,
                      .z_near = 0.01f};
    options.pose = &pose;
    options.width = options.height = 256;
    const auto expected = reference::renderReference(pack, options);
    ASSERT_TRUE(expected.ok()) << formatMessage(expected.error());
    options.pose = nullptr;
    const auto at_rest = reference::renderReference(pack, options);
    ASSERT_TRUE(at_rest.ok());
    const reference::FlipMap map = reference::flip(*expected, halved(*drawn));
    const double moved = reference::flip(*expected, *at_rest).mean();
    keep(*drawn, posed.name + "_gpu");
    keep(*expected, posed.name + "_rays");
    keep(reference::makeFlipImage(map), posed.name + "_flip");
    std::printf("%-10s FLIP %.4f, the scene at rest %.4f\n", posed.name.c_str(), map.mean(), moved);
    EXPECT_LT(map.mean(), 0.03);
    EXPECT_GT(moved, 2 * map.mean()) << "the pose must show";
}

TEST_F(ImageTest, posesAreWhatRaysGive)
{
    const ScratchFolder folder;
    const CookedSample& sample = cookedSample({"character", 20000});
    expectWhatRaysGive(sample.packPath(), sample.pack(),
                       {"walk", 0, "0.3", {1.2f, 1.3f, 2.4f, 0, 0.9f, 0, 45}}, folder);
    expectWhatRaysGive(sample.packPath(), sample.pack(), {"wave", 1, "0.7", {-1, 1.5f, 2.2f, 0, 1, 0, 45}},
                       folder);

    const char* assets = std::getenv("HEARTH_ASSETS");
    if (assets == nullptr)
        GTEST_SKIP() << "HEARTH_ASSETS is not set";
    const auto expectOfAsset = [&](const std::string& source, const PosedImage& posed)
    {
        const std::string cooked = folder.path(posed.name + ".hearth");
        const auto end = runProgram(Program::hearth, {"cook", assets + ("/good/" + source), "-o", cooked});
        ASSERT_EQ(end.exit_code, 0) << end.errors;
        const auto opened = pack::Pack::open(cooked);
        ASSERT_TRUE(opened.ok());
        expectWhatRaysGive(cooked, opened->view(), posed, folder);
    };
    expectOfAsset("skinned/fox/Fox.glb", {"fox", 2, "0.4", {150, 110, 170, 0, 40, 0, 40}});
    expectOfAsset("morph/animated_morph_sphere/AnimatedMorphSphere.glb",
                  {"morph", 0, "1.3", {2, 2, 4, 0, 0, 0, 45}});
}

} // namespace
} // namespace hearth::roundtrip

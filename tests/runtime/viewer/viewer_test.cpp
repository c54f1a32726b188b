// Tests the command line of hearth-render, its camera and its files. No device is needed.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/half.h"
#include "formats/gpu_shared/shading.h"
#include "pipelines/import/images/decode.h"
#include "runtime/viewer/camera_fit.h"
#include "runtime/viewer/camera_path.h"
#include "runtime/viewer/exr_output.h"
#include "runtime/viewer/file_output.h"
#include "runtime/viewer/render/options.h"
#include "runtime/viewer/report/cull_report.h"
#include "runtime/viewer/sample_sum.h"
#include "tests/support/limits/time_limit.h"
#include "tests/support/shapes.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_scene.h"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <set>
#include <sys/stat.h>

namespace hearth::test
{

namespace
{

using viewer::PyramidStart;
using viewer::RenderOptions;

Result<RenderOptions> parse(std::vector<const char*> arguments)
{
    return viewer::parseRenderOptions(arguments);
}

void expectUsage(const std::vector<const char*>& arguments, const std::string& mention)
{
    const auto options = parse(arguments);
    ASSERT_FALSE(options.ok()) << mention;
    EXPECT_EQ(exitCode(options.error()), 2);
    EXPECT_NE(formatMessage(options.error()).find(mention), std::string::npos)
        << formatMessage(options.error());
}

} // namespace

TEST(RenderOptions, defaultsFitTheScene)
{
    const auto options = parse({"a.hearth", "-o", "a.png"});
    ASSERT_TRUE(options.ok());
    EXPECT_EQ(options->pack, "a.hearth");
    EXPECT_EQ(options->output, "a.png");
    EXPECT_EQ(options->width, 1280u);
    EXPECT_EQ(options->height, 720u);
    EXPECT_FALSE(options->camera.has_value());
    EXPECT_EQ(options->settings.error_pixels, 1);
    EXPECT_EQ(options->settings.cull_flags, shared::kCullEverything);
    EXPECT_EQ(options->memory_budget, 0u) << "all is resident";
    EXPECT_GT(options->shadows.options.max_maps, 0u) << "shadows";
    EXPECT_TRUE(options->shadows.fit_maps);
    EXPECT_EQ(options->shadows.options.casters, gpu::Casters::clusters);
}

TEST(RenderOptions, ofWhatFollowsTheLightingAreRead)
{
    const auto plain = parse({"a.hearth", "-o", "a.png"});
    EXPECT_TRUE(gpu::isNeutral(plain->settings.post));
    EXPECT_EQ(viewer::rendererOptions(plain->settings).post, gpu::PostSupport::none);
    const auto graded = parse({"a.hearth", "-o", "a.png", "--exposure=-1.5", "--photo-filter", "ff8000,0.5"});
    ASSERT_TRUE(graded.ok());
    EXPECT_EQ(graded->settings.post.exposure_stops, -1.5f);
    EXPECT_EQ(graded->settings.post.photo_filter.color.x, 1);
    EXPECT_NEAR(graded->settings.post.photo_filter.color.y, 0.2159f, 1e-4f) << "linear";
    EXPECT_EQ(graded->settings.post.photo_filter.density, 0.5f);
    EXPECT_EQ(viewer::rendererOptions(graded->settings).post, gpu::PostSupport::in_tile);
    const auto blooming = parse({"a.hearth", "-o", "a.png", "--exposure", "auto,-2", "--bloom", "0.1,add"});
    ASSERT_TRUE(blooming.ok());
    EXPECT_TRUE(blooming->settings.post.automatic_exposure.has_value());
    EXPECT_EQ(blooming->settings.post.exposure_stops, -2);
    EXPECT_EQ(parse({"a.hearth", "-o", "a.png", "--exposure", "auto"})->settings.post.exposure_stops, 0);
    EXPECT_EQ(blooming->settings.post.bloom.strength, 0.1f);
    EXPECT_EQ(blooming->settings.post.bloom.mode, gpu::BloomMode::add);
    EXPECT_EQ(viewer::rendererOptions(blooming->settings).post, gpu::PostSupport::packed);
    const auto small = parse({"a.hearth", "-o", "a.png", "--render-size", "320x180"});
    EXPECT_EQ(small->settings.render_size->width, 320u);
    EXPECT_EQ(viewer::rendererOptions(small->settings).post, gpu::PostSupport::packed);
    const auto linear = parse({"a.hearth", "-o", "a.exr"});
    EXPECT_TRUE(linear->settings.keeps_radiance);
    EXPECT_EQ(viewer::rendererOptions(linear->settings).post, gpu::PostSupport::half);
    for (const auto& [option, value] :
         std::initializer_list<std::pair<const char*, const char*>>{{"--exposure", "bright"},
                                                                    {"--exposure", "99"},
                                                                    {"--exposure", "1,2"},
                                                                    {"--bloom", "2"},
                                                                    {"--bloom", "0.1,more"},
                                                                    {"--photo-filter", "warm"},
                                                                    {"--photo-filter", "ff8000,2"},
                                                                    {"--render-size", "320"}})
        expectUsage({"a.hearth", "-o", "a.png", option, value}, option);
    expectUsage({"a.hearth", "-o", "a.exr", "--view", "lod"}, "linear colours");
}

TEST(RenderOptions, weightsOfLampsAreReadByName)
{
    const auto options = parse({"a.hearth", "-o", "a.png", "--light", "lamp=0.5", "--light=a=b=0,2,1e1"});
    ASSERT_TRUE(options.ok()) << formatMessage(options.error());
    ASSERT_EQ(options->lamps.size(), 2u);
    EXPECT_EQ(options->lamps[0].name, "lamp");
    EXPECT_EQ(options->lamps[0].weight, (Float3{0.5f, 0.5f, 0.5f}));
    EXPECT_EQ(options->lamps[1].name, "a=b");
    EXPECT_EQ(options->lamps[1].weight, (Float3{0, 2, 10}));
    for (const char* wrong : {"lamp", "lamp=", "=1", "lamp=-1", "lamp=1,2", "lamp=1,2,3,4", "lamp=nan"})
        expectUsage({"a.hearth", "-o", "a.png", "--light", wrong}, "--light");
}

TEST(RenderOptions, takeFourSamplesUnlessToldOtherwise)
{
    EXPECT_EQ(parse({"a.hearth", "-o", "a.png"})->samples, 4u);
    EXPECT_EQ(parse({"a.hearth", "-o", "a.png", "--samples", "64"})->samples, 64u);
    EXPECT_EQ(parse({"a.hearth", "-o", "a.png", "--dump-visibility", "v"})->samples, 1u);
    EXPECT_FALSE(parse({"a.hearth", "-o", "a.png", "--anti-aliasing", "samples"})->is_filtered);
    const auto filtered = parse({"a.hearth", "-o", "a.png", "--anti-aliasing", "temporal"});
    EXPECT_TRUE(filtered->is_filtered && filtered->settings.is_filtered && filtered->samples == 1);
}

TEST(RenderOptions, everyOptionIsRead)
{
    const auto options = parse({"--size=64x32",
                                "--camera",
                                "1,2,3,4,5,-6.5,45",
                                "--error-pixels",
                                "0",
                                "--view",
                                "lod",
                                "--samples",
                                "1",
                                "--device",
                                "llvm",
                                "--stats",
                                "s.json",
                                "--frames",
                                "3",
                                "--dump-visibility",
                                "v.bin",
                                "--cull",
                                "cone,occlusion",
                                "--lod-curve",
                                "0:1,50:0.5",
                                "--hzb",
                                "noise:7",
                                "--shaded-area",
                                "tiles",
                                "--ambient-occlusion",
                                "smoothstep",
                                "--specular-occlusion=table",
                                "--budget",
                                "3M",
                                "--shadows",
                                "texels=512,bias=3,splits=2,kernel=0,maps=7,far=20,depth=16",
                                "--shadow-sphere",
                                "1,2,3,4",
                                "--shadow-sphere=-1,0,0,0.5,6",
                                "--shadow-casters",
                                "proxies",
                                "--validate",
                                "-v",
                                "--output=b.png",
                                "b.hearth"});
    ASSERT_TRUE(options.ok()) << formatMessage(options.error());
    EXPECT_EQ(options->width, 64u);
    EXPECT_EQ(options->height, 32u);
    ASSERT_TRUE(options->camera.has_value());
    EXPECT_EQ(options->camera->position, (Float3{1, 2, 3}));
    EXPECT_EQ(options->camera->target, (Float3{4, 5, -6.5f}));
    EXPECT_NEAR(options->camera->y_fov_rad, 0.785398f, 1e-5f);
    EXPECT_EQ(options->settings.error_pixels, 0);
    EXPECT_EQ(options->settings.view, shared::kViewLod);
    EXPECT_EQ(options->samples, 1u);
    EXPECT_EQ(options->device, "llvm");
    EXPECT_EQ(options->stats, "s.json");
    EXPECT_EQ(options->frames, 3u);
    EXPECT_EQ(options->visibility, "v.bin");
    EXPECT_EQ(options->settings.cull_flags, shared::kCullCone | shared::kCullOcclusion);
    EXPECT_EQ(options->pyramid, PyramidStart::noise);
    EXPECT_EQ(options->noise_seed, 7u);
    EXPECT_EQ(options->settings.shaded_area, gpu::ShadedArea::tiles);
    EXPECT_EQ(options->settings.ambient_occlusion, shared::kAmbientOcclusionSmoothstep);
    EXPECT_EQ(options->settings.specular_occlusion, shared::kSpecularOcclusionTable);
    EXPECT_EQ(options->memory_budget, 3u << 20);
    ASSERT_EQ(options->settings.lod_curve.size(), 2u);
    EXPECT_EQ(options->settings.lod_curve[1].distance, 50);
    EXPECT_EQ(options->settings.lod_curve[1].factor, 0.5f);
    const gpu::ShadowOptions& shadows = options->shadows.options;
    EXPECT_EQ(shadows.texels, 512u);
    EXPECT_EQ(shadows.error_bias, 3);
    EXPECT_EQ(shadows.splits, 2u);
    EXPECT_EQ(shadows.kernel, 0u);
    EXPECT_EQ(shadows.max_maps, 7u);
    EXPECT_EQ(shadows.split_range.far, 20);
    EXPECT_EQ(shadows.depth, gpu::ShadowDepth::d16);
    EXPECT_EQ(shadows.casters, gpu::Casters::proxies);
    ASSERT_EQ(options->shadows.spheres.size(), 2u);
    EXPECT_EQ(options->shadows.spheres[0].center, (Float3{1, 2, 3}));
    EXPECT_EQ(options->shadows.spheres[0].light, gpu::ShadowSphere::kAllLights);
    EXPECT_EQ(options->shadows.spheres[1].radius, 0.5f);
    EXPECT_EQ(options->shadows.spheres[1].light, 6u);
    EXPECT_TRUE(options->validate);
    EXPECT_TRUE(options->verbose);
}

TEST(CullReport, everythingIsCountedAtTheFirstTestThatItFails)
{
    shared::CullStatistics statistics{};
    statistics.empty_instances = 1;
    statistics.outside_instances = 2;
    statistics.occluded_instances = 3;
    statistics.late_instances = 4;
    statistics.visible_instances = 5;
    for (uint32_t i = 0; i < shared::kOutcomeCount; ++i)
    {
        statistics.clusters[i] = 10 * (i + 1);
        statistics.triangles_low[i] = 1000 * (i + 1);
    }
    statistics.triangles_high[shared::kOutcomeLod] = 1;
    // 20 of 50 clusters of instances that were visible at once are drawn early; at the end 70 of all 110 are
    // drawn.
    const viewer::CullReport report = viewer::makeCullReport(statistics, {70, 0, 20, 0}, 2000, 7000);
    EXPECT_EQ(viewer::formatCullReport(report),
              "{\"instances\":{\"tested\":15,\"empty\":1,\"frustum\":2,\"occlusion_early\":7,\"occlusion\":3,"
              "\"drawn\":9},\n"
              "  \"clusters\":{\"tested\":210,\"instance\":10,\"lod\":20,\"frustum\":30,\"cone\":40,"
              "\"occlusion_early\":30,\"occlusion\":40,\"drawn\":70},\n"
              "  \"triangles\":{\"tested\":4294988296,\"instance\":1000,\"lod\":4294969296,\"frustum\":3000,"
              "\"cone\":4000,\"occlusion_early\":3000,\"occlusion\":4000,\"drawn\":7000}}");
}

TEST(RenderOptions, mistakesAreNamed)
{
    expectUsage({}, "no pack");
    expectUsage({"a.hearth"}, "no output");
    expectUsage({"a.hearth", "b.hearth", "-o", "a.png"}, "b.hearth");
    expectUsage({"a.hearth", "-o"}, "-o needs a value");
    expectUsage({"a.hearth", "--bogus", "1"}, "--bogus");
    for (const char* size : {"0x5", "5", "5x", "5x5x5", "99999x1", "-1x5", "5.0x5"})
        expectUsage({"a.hearth", "-o", "a.png", "--size", size}, size);
    for (const char* camera :
         {"1,2,3", "0,0,0,0,0,0,45", "0,0,0,1,0,0,0", "0,0,0,1,0,nan,45", "0,0,0,1,0,0,171"})
        expectUsage({"a.hearth", "-o", "a.png", "--camera", camera}, camera);
    expectUsage({"a.hearth", "-o", "a.png", "--error-pixels", "-1"}, "-1");
    expectUsage({"a.hearth", "-o", "a.png", "--shaded-area", "half"}, "half");
    expectUsage({"a.hearth", "-o", "a.png", "--ambient-occlusion", "table"}, "smoothstep");
    expectUsage({"a.hearth", "-o", "a.png", "--specular-occlusion", "exact"}, "table");
    expectUsage({"a.hearth", "-o", "a.png", "--view", "pretty"}, "pretty");
    expectUsage({"a.hearth", "-o", "a.png", "--samples", "2"}, "2");
    expectUsage({"a.hearth", "-o", "a.png", "--samples", "4", "--dump-visibility", "v"}, "--samples 1");
    expectUsage({"a.hearth", "-o", "a.png", "--anti-aliasing", "fxaa"}, "neither samples nor temporal");
    expectUsage({"a.hearth", "-o", "a.png", "--anti-aliasing", "temporal", "--samples", "4"},
                "--samples and");
    expectUsage({"a.hearth", "-o", "a.exr", "--anti-aliasing", "temporal"}, "linear colours");
    expectUsage({"a.hearth", "-o", "a.png", "--anti-aliasing", "temporal", "--render-size", "9x9"},
                "--render-size");
    for (const char* shadows : {"", "yes", "on,maps=4", "maps=0", "maps=65", "texels=1000", "kernel=4",
                                "bias=0.5", "depth=24", "far=-1", "near=3,far=2", "size=5"})
        expectUsage({"a.hearth", "-o", "a.png", "--shadows", shadows}, "--shadows");
    expectUsage({"a.hearth", "-o", "a.png", "--shadow-casters", "meshes"}, "neither clusters nor proxies");
    for (const char* sphere : {"", "1,2,3", "1,2,3,0", "1,2,3,4,x", "1,2,3,4,5,6"})
        expectUsage({"a.hearth", "-o", "a.png", "--shadow-sphere", sphere}, "--shadow-sphere");
    expectUsage({"a.hearth", "-o", "a.png", "--view", "shadow-maps", "--shadows", "off"}, "--shadows");
    expectUsage({"a.hearth", "-o", "a.png", "--lights", "deferred", "--materials", "depth"},
                "--materials id");
    for (const char* budget : {"", "0", "M", "-1", "1.5M", "1T", "1025G", "99999999999999999999"})
        expectUsage({"a.hearth", "-o", "a.png", "--budget", budget}, "--budget");
    for (const char* tests : {"", "some", "cone,", "all,cone"})
        expectUsage({"a.hearth", "-o", "a.png", "--cull", tests}, "--cull");
    for (const char* curve : {"", "1", "1:2:3", "1:x", "1:1,2:3"})
        expectUsage({"a.hearth", "-o", "a.png", "--lod-curve", curve}, "--lod-curve");
    expectUsage({"a.hearth", "-o", "a.png", "--camera-path", "p.txt", "--frames", "2"}, "--camera-path");
    for (const char* meshes : {"", "1,", "x", "1,-2"})
        expectUsage({"a.hearth", "-o", "a.png", "--meshes", meshes}, "--meshes");
    expectUsage({"a.hearth", "-o", "a.png", "--meshes", "1", "--camera-path", "p.txt"}, "--meshes");
    for (const char* views : {"", "final,", "final,nothing", "overdraw"})
        expectUsage({"a.hearth", "-o", "a.png", "--views", views}, "--views");
    expectUsage({"a.hearth", "-o", "a.png", "--views", "lod", "--frames", "2"}, "--views");
    expectUsage({"a.hearth", "-o", "a.png", "--sheet", "yes"}, "--sheet");
    for (const char* other : {"--frames=2", "--meshes=0", "--camera-path=p.txt", "--animation=Walk",
                              "--scene-camera=0", "--dump-visibility=v", "--view=bricks", "--views=final,gi"})
        expectUsage({"a.hearth", "-o", "a.png", "--sheet", "on", other}, "--sheet on excludes");
    for (const char* start : {"", "noise", "noise:", "noise:x", "noise:-1", "last"})
        expectUsage({"a.hearth", "-o", "a.png", "--hzb", start}, "--hzb");
}

TEST(CameraPath, isACameraALine)
{
    const std::string file = testing::TempDir() + "camera_path.txt";
    const auto written = [&](const std::string& text)
    {
        std::ofstream(file, std::ios::binary) << text;
        return viewer::readCameraPath(file);
    };
    const auto cameras = written("# eye, target, angle\r\n\n1,2,3,4,5,6,45\r\n0,0,0,0,0,-1,90\n");
    ASSERT_TRUE(cameras.ok());
    ASSERT_EQ(cameras->size(), 2u);
    EXPECT_EQ((*cameras)[0].position, (Float3{1, 2, 3}));
    EXPECT_EQ((*cameras)[1].target, (Float3{0, 0, -1}));
    const auto wrong = written("1,2,3,4,5,6,45\n1,2,3\n");
    ASSERT_FALSE(wrong.ok());
    EXPECT_EQ(wrong.error().where, "line 2");
    EXPECT_EQ(wrong.error().issue, Issue::camera_path);
    EXPECT_EQ(written("# nothing\n").error().issue, Issue::camera_path);
    EXPECT_EQ(viewer::readCameraPath(file + ".none").error().issue, Issue::input_missing);
}

TEST(CameraPath, isNoPipe)
{
    const TemporaryFolder folder;
    ASSERT_EQ(::mkfifo(folder.file("pipe").c_str(), 0600), 0);
    const TimeLimit limit(20);
    EXPECT_EQ(viewer::readCameraPath(folder.file("pipe")).error().issue, Issue::input_missing);
}

TEST(CameraPath, readsWhatItWrites)
{
    std::mt19937 random(4);
    for (int i = 0; i < 100; ++i)
    {
        const shared::Camera camera = randomCamera(random, 100);
        const auto read = viewer::parseCamera(viewer::formatCamera(camera));
        ASSERT_TRUE(read) << viewer::formatCamera(camera);
        EXPECT_EQ(read->position, camera.position);
        EXPECT_EQ(read->target, camera.target);
        EXPECT_NEAR(read->y_fov_rad, camera.y_fov_rad, 1e-6f);
    }
}

TEST(CameraPath, numbersItsFiles)
{
    EXPECT_EQ(viewer::numberedFile("a.png", 0), "a-0000.png");
    EXPECT_EQ(viewer::numberedFile("x.y/a", 12), "x.y/a-0012");
    EXPECT_EQ(viewer::numberedFile("x.y/.a", 12345), "x.y/.a-12345");
}

TEST(FitCamera, showsEveryVertexBetweenTheSides)
{
    std::mt19937 random(9);
    const mesh::SourceMesh rock = withMaterial(shapes::rock(24, 0.2f), kInvalidIndex);
    for (const float aspect : {0.4f, 1.0f, 1.78f})
        for (const uint32_t count : {1u, 4u})
        {
            TestScene test;
            const uint32_t mesh = test.addMesh(rock);
            for (uint32_t i = 0; i < count; ++i)
                test.addInstance(mesh, randomAffine(random, 20));
            const formats::PackView pack = test.build();
            const shared::Camera camera = viewer::fitCamera(pack, aspect);
            const auto width = static_cast<uint32_t>(1000 * aspect);
            const shared::FrameView view = shared::makeFrameView(camera, width, 1000, 1, count);
            float left = 0, right = 0, bottom = 0, top = 0;
            for (const formats::InstanceRecord& instance : pack.instances())
                for (const Float3 position : rock.positions)
                {
                    const Float3 p = transformPoint(instance.world_from_object, position);
                    const Float4 clip = shared::clipPosition(view, p - camera.position);
                    EXPECT_GT(clip.w, camera.z_near);
                    right = std::max(right, clip.x / clip.w);
                    left = std::max(left, -clip.x / clip.w);
                    top = std::max(top, clip.y / clip.w);
                    bottom = std::max(bottom, -clip.y / clip.w);
                }
            const float reach = std::max({left, right, bottom, top});
            EXPECT_LT(reach, 1);
            EXPECT_GT(reach, 0.8f);
            // equally far from the two sides that are nearest
            const bool wide = std::max(left, right) > std::max(bottom, top);
            EXPECT_LT(std::abs(wide ? left - right : top - bottom), 0.2f);
        }
}

TEST(SceneCamera, anOrthographicOneIsAsHighAsItSays)
{
    TestScene test;
    test.addInstance(test.addMesh(withMaterial(shapes::rock(4, 0.2f), kInvalidIndex)), Affine3{});
    formats::CameraRecord record{};
    record.node = 0;
    record.type = static_cast<uint32_t>(formats::CameraType::orthographic);
    record.x_magnification = 3;
    record.y_magnification = -2; // glTF does not forbid it
    record.z_far = 50;
    record.world_from_camera = translated({1, 2, 3});
    test.model().cameras = {record};
    const formats::PackView pack = test.build();
    const shared::Camera camera = viewer::sceneCamera(pack, 0);
    EXPECT_GT(camera.z_near, 0);
    const shared::FrameView view = shared::makeFrameView(camera, 400, 200, 1, 1);
    ASSERT_TRUE(shared::isOrthographic(view));
    // the middle of the image's upper edge, and its right edge, near and far
    for (const float distance : {camera.z_near, 49.0f})
    {
        const Float4 top = shared::clipPosition(view, {0, 2, -distance});
        const Float4 right = shared::clipPosition(view, {4, 0, -distance});
        EXPECT_NEAR(top.x, 0, 1e-6f);
        EXPECT_NEAR(top.y, -1, 1e-6f);
        EXPECT_NEAR(right.x, 1, 1e-6f);
        EXPECT_NEAR(top.z, (50 - distance) / (50 - camera.z_near), 1e-6f);
        EXPECT_EQ(top.w, 1);
    }
}

TEST(FitCamera, standsSomewhereSensibleInAnEmptyScene)
{
    TestScene test;
    const shared::Camera camera = viewer::fitCamera(test.build(), 1);
    EXPECT_TRUE(isFinite(camera.position));
    EXPECT_GT(length(camera.position - camera.target), 0.1f);
}

TEST(WriteFile, leavesNothingBehindWhereItCannotWrite)
{
    const TemporaryFolder folder;
    const std::byte bytes[] = {std::byte{1}};
    const Status status = viewer::writeFile(folder.file("missing/a.png"), bytes);
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(exitCode(status.error()), 73);
    // a folder has the name of the file
    std::filesystem::create_directory(folder.file("taken"));
    EXPECT_FALSE(viewer::writeFile(folder.file("taken"), bytes).ok());
    EXPECT_EQ(folder.files(), std::set<std::string>{"taken"});
}

TEST(SampleSum, averagesInLinearLight)
{
    std::vector<std::byte> pixels(2 * 2 * 4, std::byte{0});
    for (int i = 0; i < 8; ++i) // the upper two are white
        pixels[static_cast<size_t>(i)] = std::byte{255};
    viewer::SampleSum sum(1, 1, 2);
    sum.add(pixels);
    const auto half = sum.average();
    ASSERT_EQ(half.size(), 4u);
    EXPECT_EQ(std::to_integer<int>(half[0]), 188) << "half of the light, not half of the code";
    sum.add(std::vector<std::byte>(2 * 2 * 4, std::byte{255}));
    EXPECT_EQ(std::to_integer<int>(sum.average()[0]), 225) << "three quarters of the light";
}

TEST(Exr, holdsWhatAHalfFloatHolds)
{
    const float numbers[] = {0, 0.25f, 1,     2.0f / 3, 1000, 1e9f, 0.004f, 12.5f, 3,
                             7, 0.1f,  60000, 1,        1,    1,    2,      2,     2};
    const auto file = viewer::encodeExr(numbers, 3, 2);
    ASSERT_TRUE(file.ok());
    const auto image = import::decodeImage(*file, "a.exr", {});
    ASSERT_TRUE(image.ok()) << formatMessage(image.error());
    ASSERT_EQ(image->width, 3u);
    ASSERT_EQ(image->height, 2u);
    ASSERT_EQ(image->type, import::ChannelType::float16);
    for (size_t i = 0; i < std::size(numbers); ++i)
    {
        uint16_t half;
        std::memcpy(&half, &image->texels[(i / 3 * 4 + i % 3) * sizeof(half)], sizeof(half));
        EXPECT_EQ(half, halfFromFloat(std::min(numbers[i], kHalfMax))) << i;
    }
}

TEST(SampleSum, averagesLinearColours)
{
    const uint16_t halves[] = {halfFromFloat(1), halfFromFloat(3), halfFromFloat(200), 0,
                               halfFromFloat(2), halfFromFloat(5), halfFromFloat(0),   0};
    std::vector<uint16_t> samples(2 * 2 * 4);
    std::copy(std::begin(halves), std::end(halves), samples.begin());
    viewer::SampleSum sum(1, 1, 2);
    sum.addLinear(std::as_bytes(std::span(samples)));
    EXPECT_EQ(sum.averageLinear(), (std::vector<float>{0.75f, 2, 50}));
}

TEST(SampleSum, keepsEveryCodeOfOneSample)
{
    std::vector<std::byte> pixels;
    for (int code = 0; code < 256; ++code)
        pixels.insert(pixels.end(),
                      {std::byte(code), std::byte(255 - code), std::byte(code), std::byte{255}});
    viewer::SampleSum sum(16, 16, 1);
    sum.add(pixels);
    EXPECT_EQ(sum.average(), pixels);
}

/// A point in front of the camera moves by the part of a sample that the frame's image is shifted by.
TEST(ShiftCamera, spreadsSamplesEvenlyOverAPixel)
{
    constexpr uint32_t kWidth = 640, kHeight = 360;
    const shared::Camera camera{.position = {1, 2, 3}, .target = {4, 1, -5}, .y_fov_rad = 0.9f};
    std::set<std::pair<int, int>> places;
    for (uint32_t frame = 0; frame < 16; ++frame)
    {
        const shared::FrameView view = shared::makeFrameView(
            viewer::shiftCamera(camera, frame, 16, kWidth, kHeight), kWidth, kHeight, 1, 1);
        const Float3 ahead = camera.target - camera.position;
        const float w = dot(shared::row3(view.clip_w), ahead);
        const float x = dot(shared::row3(view.clip_x), ahead) / w * kWidth / 2,
                    y = dot(shared::row3(view.clip_y), ahead) / w * kHeight / 2;
        // places are 1/4 apart, the first at -3/8
        EXPECT_NEAR(std::remainder(x - 0.125f, 0.25f), 0, 0.01f);
        EXPECT_NEAR(std::remainder(y - 0.125f, 0.25f), 0, 0.01f);
        EXPECT_LT(std::max(std::abs(x), std::abs(y)), 0.4f);
        places.emplace(std::lround(x * 8), std::lround(y * 8));
    }
    EXPECT_EQ(places.size(), 16u);
    const shared::Camera still = viewer::shiftCamera(camera, 0, 1, kWidth, kHeight);
    EXPECT_EQ(still.shift.x, 0);
    EXPECT_EQ(still.shift.y, 0);
}

} // namespace hearth::test

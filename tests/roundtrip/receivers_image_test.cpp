// Draws a room cooked with receivers and bricks as a game may leave it: lamps dimmed and switched off, a prop
// moved, a character posed. Compares it with paths through the same frame. Receivers do not follow what
// moves: the prop's baked shadow stays where it was cooked, on a floor that is black where it stood, and
// neither prop nor character throws a shadow of the lamps on baked surfaces. The test measures these errors.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/scene/light_change.h"
#include "runtime/pack/pack.h"
#include "runtime/pack/pose_player.h"
#include "sample_assets/shapes/glb_writer.h"
#include "tests/reference/flip.h"
#include "tests/reference/tracer/camera_rays.h"
#include "tests/roundtrip/lamp_room.h"
#include "tests/roundtrip/traced_pictures.h"
#include "tests/runtime/gpu/frame/read_radiance.h"
#include "tests/support/sandbox.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>

namespace hearth::test
{

namespace
{

using reference::Double3;

constexpr uint32_t kSide = 96; ///< of an image, in pixels
/// Paths of each pixel, traced twice: of the scene as it was baked, and as it is in the frame.
constexpr uint32_t kPathsAtRest = 16, kPaths = 96;
constexpr uint32_t kSettlingFrames = 12; ///< in which bricks take the light of the lamps
constexpr uint32_t kGathers = 32;        ///< of the frame that is compared: little noise
constexpr Float3 kMove{-1.1f, 0, 0.1f};
constexpr std::array<float, 3> kWeights{1, 0.3f, 0}; ///< of the lamps
constexpr shared::Camera kCamera{
    .position = {0.1f, 1.5f, 5}, .target = {0, 0.95f, 0}, .y_fov_rad = 0.6f, .z_near = 0.05f};
constexpr double kMaxBaked = 0.012; ///< error of the mean light of surfaces with receivers
constexpr double kMaxFlip = 0.09;
constexpr gpu::ShadowOptions kShadows{.max_maps = 13, .texels = 512};

/// Radiance of the paths of an image, by halves of them: their noise is independent.
struct Traced
{
    std::vector<Double3> first, second;
    std::vector<std::optional<reference::ShadedPoint>> seen; ///< surface of each pixel

    Double3 at(size_t i) const { return (first[i] + second[i]) / 2; }
};

/// Error of a region.
struct RegionError
{
    size_t pixels = 0;
    Double3 ratio;  ///< of the mean radiance, drawn over traced
    double rms = 0; ///< of differences over the mean of traced, without the noise of paths
};

class ReceiversImageTest : public GpuTest
{
protected:
    static void SetUpTestSuite()
    {
        GpuTest::SetUpTestSuite();
        gpu::RendererOptions options = testRendererOptions();
        options.post = gpu::PostSupport::half;
        replaceRenderer(options);
        Sandbox folder;
        ASSERT_TRUE(samples::writeFile(folder / "room.glb", samples::encodeGlb(makeLampRoom())).ok());
        const ProgramEnd end =
            folder.run({HEARTH_BIN "/hearth", "cook", "room.glb", "-o", "room.hearth", "-q", "--no-cache",
                        "--receivers", "--bricks", "--visibility", "off"});
        ASSERT_EQ(end.exit_code, 0) << end.err;
        pack_ = std::make_unique<pack::Pack>(pack::Pack::open(folder / "room.hearth").value());
    }

    static void TearDownTestSuite()
    {
        pack_.reset();
        GpuTest::TearDownTestSuite();
    }

    static const formats::PackView& view() { return pack_->view(); }

    static uint32_t findNode(std::string_view name)
    {
        for (uint32_t i = 0; i < view().nodes().size(); ++i)
            if (view().text(view().nodes()[i].name) == name)
                return i;
        ADD_FAILURE() << "no node " << name;
        return 0;
    }

    static uint32_t findInstance(std::string_view name)
    {
        const uint32_t node = findNode(name);
        for (uint32_t i = 0; i < view().instances().size(); ++i)
            if (view().instances()[i].node == node)
                return i;
        ADD_FAILURE() << "no instance " << name;
        return 0;
    }

    /// Draw the frame that a game shows after a while; return its linear colours.
    std::vector<Float3> drawRadiance()
    {
        const auto scene = upload(view(), {.shadows = kShadows});
        auto targets = renderer().createTargets({kSide, kSide}, {.keeps_radiance = true}).value();
        pack::PosePlayer player(view());
        player.play({0, 1});
        std::vector<gpu::InstancePose> poses;
        for (const pack::PosedInstance& posed : player.posed())
            poses.push_back({.instance = posed.instance,
                             .world_from_bind = posed.world_from_bind,
                             .morph_weights = posed.morph_weights});
        const uint32_t prop = findInstance(kPropName);
        Affine3 place = view().instances()[prop].world_from_object;
        for (int row = 0; row < 3; ++row)
            place.m[row][3] += kMove[row];
        const gpu::InstanceMove move = gpu::moveInstance(*scene, prop, place).value();
        std::vector<gpu::LampWeight> weights;
        for (uint32_t i = 0; i < kWeights.size(); ++i)
            weights.push_back(gpu::weighLight(*scene, i, {kWeights[i], kWeights[i], kWeights[i]}).value());
        // faces of bricks are lit in frames of any size
        auto small = renderer().createTargets({8, 8}).value();
        for (uint32_t frame = 0; frame <= kSettlingFrames; ++frame)
        {
            const uint32_t side = frame < kSettlingFrames ? 8 : kSide;
            gpu::FrameInput input{
                .view = makeView(*scene, kCamera, {.width = side, .height = side, .error_pixels = 0}),
                .gathers = frame < kSettlingFrames ? 1 : kGathers};
            if (frame == 0)
            {
                input.moves = {&move, 1};
                input.poses = poses;
                input.lamp_weights = weights;
            }
            EXPECT_TRUE(host()
                            .run(
                                [&](VkCommandBuffer commands)
                                {
                                    renderer().record(commands, *scene,
                                                      frame < kSettlingFrames ? small : targets, input);
                                    return success();
                                })
                            .ok());
        }
        return readRadiance(host(), renderer(), targets);
    }

    /// Trace the room under the weights of the lamps.
    /// is_at_rest  as it was baked: the prop in its place, no character
    static Traced trace(bool is_at_rest)
    {
        const formats::AnimationTables tables = formats::animationTables(view());
        formats::ScenePose pose = formats::restPose(tables);
        if (is_at_rest)
            pose.nodes[findNode(kHipName)].translation = {0, -50, 0};
        else
        {
            formats::sampleAnimation(tables, view().animations()[0], 1, pose);
            formats::NodePose& prop = pose.nodes[findNode(kPropName)];
            prop.translation =
                prop.translation + hearth::Double3{double{kMove.x}, double{kMove.y}, double{kMove.z}};
        }
        const reference::PackGeometry geometry = reference::PackGeometry::decode(view()).value();
        const reference::TextureSet textures = reference::TextureSet::load(view()).value();
        reference::ShadedScene scene(geometry, textures, &pose);
        reference::SceneLighting lighting = scene.lighting();
        for (size_t i = 0; i < kWeights.size(); ++i)
            lighting.lights[i].intensity = lighting.lights[i].intensity * double{kWeights[i]};
        scene.setLighting(lighting);
        reference::PathTracing tracing{.camera = kCamera,
                                       .width = kSide,
                                       .height = kSide,
                                       .samples = is_at_rest ? kPathsAtRest : kPaths,
                                       .through_centers = true};
        Traced traced;
        traced.first = reference::tracePaths(scene, tracing);
        tracing.seed = 2;
        traced.second = reference::tracePaths(scene, tracing);
        const reference::CameraRays rays(kCamera, kSide, kSide);
        for (uint32_t i = 0; i < kSide * kSide; ++i)
            traced.seen.push_back(scene.nearest(rays.through(i % kSide + 0.5, i / kSide + 0.5), 0));
        return traced;
    }

    /// Compare the pixels whose surface counts.
    template <typename Counts>
    static RegionError compare(const char* name, const std::vector<Float3>& drawn, const Traced& traced,
                               const Counts& counts)
    {
        RegionError error;
        Double3 sum_drawn, sum_traced;
        double squares = 0;
        for (size_t i = 0; i < drawn.size(); ++i)
        {
            if (!traced.seen[i] || !counts(*traced.seen[i]))
                continue;
            ++error.pixels;
            sum_drawn += Double3(drawn[i]);
            sum_traced += traced.at(i);
            squares += dot(Double3(drawn[i]) - traced.first[i], Double3(drawn[i]) - traced.second[i]) / 3;
        }
        EXPECT_GT(error.pixels, 50u) << name;
        const double count = static_cast<double>(error.pixels);
        error.ratio = {sum_drawn.x / sum_traced.x, sum_drawn.y / sum_traced.y, sum_drawn.z / sum_traced.z};
        const double mean = (sum_traced.x + sum_traced.y + sum_traced.z) / (3 * count);
        error.rms = std::sqrt(std::max(squares / count, 0.0)) / mean;
        std::printf("%-22s %5zu pixels, %.3f: drawn / traced %.3f %.3f %.3f, rms %.3f\n", name, error.pixels,
                    mean, error.ratio.x, error.ratio.y, error.ratio.z, error.rms);
        return error;
    }

    /// Expect the ratio of each channel to lie within bounds.
    static void expectRatio(const RegionError& error, double min, double max)
    {
        for (const double ratio : {error.ratio.x, error.ratio.y, error.ratio.z})
        {
            EXPECT_GT(ratio, min);
            EXPECT_LT(ratio, max);
        }
    }

    /// Return the image of radiance, each pixel the mean of 2 x 2, which halves the noise of paths.
    template <typename Radiance>
    static reference::Image show(const std::string& name, const Radiance& radiance)
    {
        std::vector<Double3> means(size_t{kSide / 2} * kSide / 2);
        for (uint32_t i = 0; i < kSide * kSide; ++i)
            means[i / kSide / 2 * (kSide / 2) + i % kSide / 2] += Double3(radiance[i]) / 4;
        const reference::Image image = showRadiance(means, kSide / 2);
        if (const char* folder = std::getenv("HEARTH_TEST_IMAGES"))
            EXPECT_TRUE(reference::writePng(std::string(folder) + "/receivers-" + name + ".png",
                                            showRadiance(radiance, kSide))
                            .ok());
        return image;
    }

    static std::vector<Double3> average(const Traced& traced)
    {
        std::vector<Double3> radiance;
        for (size_t i = 0; i < traced.first.size(); ++i)
            radiance.push_back(traced.at(i));
        return radiance;
    }

    static double meanFlip(const reference::Image& a, const reference::Image& b)
    {
        const reference::FlipMap map = reference::flip(a, b);
        return std::accumulate(map.error.begin(), map.error.end(), 0.0) /
               static_cast<double>(map.error.size());
    }

    static bool isWithin(Double3 point, Float3 center, double margin)
    {
        return std::abs(point.x - double{center.x}) < double{kPropHalf.x} + margin &&
               std::abs(point.z - double{center.z}) < double{kPropHalf.z} + margin;
    }

    static inline std::unique_ptr<pack::Pack> pack_;
};

} // namespace

TEST_F(ReceiversImageTest, showsTheLightOfPathsUnderWeightsAMoveAndAPose)
{
    const uint32_t prop = findInstance(kPropName), character = findInstance("character"),
                   floor = findInstance("floor");
    const Traced at_rest = trace(true), now = trace(false);
    const std::vector<Float3> drawn = drawRadiance();
    const auto isMoving = [&](const reference::ShadedPoint& point)
    { return point.hit.instance == prop || point.hit.instance == character; };
    const auto isOnFloor = [&](const reference::ShadedPoint& point, Float3 center, double margin)
    { return point.hit.instance == floor && isWithin(point.surface.position, center, margin); };

    Traced still = at_rest; // without what moves in this frame
    for (size_t i = 0; i < drawn.size(); ++i)
        if (now.seen[i] && isMoving(*now.seen[i]))
            still.seen[i].reset();
    const RegionError baked = compare("as baked", drawn, still,
                                      [&](const reference::ShadedPoint& point) { return !isMoving(point); });
    expectRatio(baked, 1 - kMaxBaked, 1 + kMaxBaked);
    EXPECT_LT(baked.rms, 0.025);

    const RegionError moved = compare(
        "prop", drawn, now, [&](const reference::ShadedPoint& point) { return point.hit.instance == prop; });
    expectRatio(moved, 1, 1.035);
    EXPECT_LT(moved.rms, 0.08);
    // brighter than the truth: what moves hides no light of other surfaces, not even from itself
    const RegionError posed =
        compare("character", drawn, now,
                [&](const reference::ShadedPoint& point) { return point.hit.instance == character; });
    expectRatio(posed, 1, 1.1);
    EXPECT_LT(posed.rms, 0.1);

    const RegionError all = compare("all that is baked", drawn, now,
                                    [&](const reference::ShadedPoint& point) { return !isMoving(point); });
    expectRatio(all, 0.99, 1.03);
    EXPECT_LT(all.rms, 0.12);
    // the stated limits: a shadow that stays, and another that is not there
    expectRatio(compare("floor where it stood", drawn, now,
                        [&](const reference::ShadedPoint& point)
                        { return isOnFloor(point, kPropCenter, 0); }),
                0.45, 0.75);
    expectRatio(compare("floor around it", drawn, now,
                        [&](const reference::ShadedPoint& point)
                        { return isOnFloor(point, kPropCenter + kMove, 0.3); }),
                1.05, 1.25);

    const reference::Image truth = show("traced", average(now));
    show("baked", average(at_rest));
    const double flip = meanFlip(show("drawn", drawn), truth);
    std::printf("FLIP %.4f, of the halves of the paths %.4f\n", flip,
                meanFlip(show("first", now.first), show("second", now.second)));
    EXPECT_LT(flip, kMaxFlip);
}

} // namespace hearth::test

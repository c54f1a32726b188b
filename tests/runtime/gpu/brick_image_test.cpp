// Tests global illumination from bricks in images: the gather for surfaces against the CPU's, its temporal
// stability, and its response to changes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/light/face_lighting.h"
#include "formats/gpu_shared/gather_lobe.h"
#include "runtime/gpu/scene/scene_shading.h"
#include "tests/runtime/gpu/brick_scene.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/lit_scene.h"

#include <algorithm>
#include <cmath>

namespace hearth::test
{

namespace
{

using namespace shared;

constexpr std::array<uint32_t, 3> kVoxels{24, 16, 24};

/// A floor of two voxels, and a wall at its left end that emits red light.
bool floorAndWall(uint32_t x, uint32_t y, uint32_t)
{
    return y < 2 || x < 2;
}

FaceLook redWall(std::array<uint32_t, 3> voxel, uint32_t side)
{
    const bool glows = side == 1 && voxel[0] == 1;
    return {{0.4f, 0.5f, 0.6f}, glows ? Float3{2, 0.05f, 0.05f} : Float3{}};
}

/// A scene of floor, wall and an upright card that is not in the bricks.
class BrickImageTest : public GpuTest
{
protected:
    static constexpr uint32_t kWidth = 128, kHeight = 96;

    void load(bool with_bricks = true)
    {
        BrickModel bricks = brickModel(kVoxels, floorAndWall, redWall);
        bricks.grid.origin = {-6, -1, -6};
        bricks.grid.voxel_size = 0.5f;
        model_ = bricks;
        const uint32_t white = test_.addMaterial(plainMaterial());
        const uint32_t floor = test_.addMaterial(floor_);
        layers_.material = floor;
        test_.model().material_layers = {layers_};
        test_.addInstance(test_.addMesh(withMaterial(makeQuad(12, 12), floor)), lying({0, 0, 0}));
        test_.addInstance(test_.addMesh(withMaterial(makeQuad(card_width_, 1.5f), white)),
                          translated(kCardFar));
        test_.addLight(sun({0.2f, -1, -0.3f}));
        if (with_bricks)
            setBricks(test_, bricks);
        pack_.emplace(test_.build());
        scene_ = upload(*pack_);
        targets_.emplace(makeTargets(kWidth * scale_, kHeight * scale_));
    }

    Image frame(const DrawOptions& more = {}, Float3 eye = {2, 3, 7})
    {
        DrawOptions options = more;
        options.width = kWidth * scale_;
        options.height = kHeight * scale_;
        return draw(*scene_, *targets_, {.position = eye, .target = {0, 0.5f, 0}}, options);
    }

    Image settled(const DrawOptions& options = {}, uint32_t frames = 48)
    {
        for (uint32_t i = 0; i < frames; ++i)
            frame(options);
        return frame(options);
    }

    /// Gather points of the last frame's tiles, except tiles without any surface.
    std::vector<GatherPoint> points()
    {
        const VkExtent2D tiles = targets_->gather().tiles();
        std::vector<GatherPoint> all =
            read<GatherPoint>(targets_->gather().points(), size_t{tiles.width} * tiles.height);
        std::erase_if(all, [](const GatherPoint& p) { return p.count == 0; });
        return all;
    }

    static constexpr Float3 kCardFar{3, 0.8f, 1};
    static constexpr Float3 kCardNear{-4, 0.8f, 1};
    static constexpr uint32_t kCard = 1; ///< instance

    /// Reload the scene with a metal floor.
    void polish(float roughness)
    {
        floor_.metallic = 1;
        floor_.roughness = roughness;
        test_ = TestScene();
        load();
    }

    static constexpr uint32_t kFloor = 0; ///< instance

    uint32_t scale_ = 1;                              ///< pixels of the next load for one, in each direction
    float card_width_ = 1.5f;                         ///< metres, of the next load
    formats::MaterialRecord floor_ = plainMaterial(); ///< material of the next load
    formats::MaterialLayersRecord layers_ = formats::neutralLayers(0);
    BrickModel model_;
    TestScene test_;
    std::optional<formats::PackView> pack_;
    std::unique_ptr<gpu::Scene> scene_;
    std::optional<gpu::FrameTargets> targets_;
};

/// Mean light of all rays of a lobe at the point of a tile.
Float3 gatherLobe(const BrickScene& scene, const Sky& sky, const BrickStart& start, const GatherPoint& point,
                  float roughness)
{
    constexpr uint32_t kRays = kGatherLobeRays * kGatherFrames;
    const Float3 to_eye = point.position * (-1 / length(point.position));
    Float3 sum;
    float weights = 0;
    for (uint32_t i = 0; i < kRays; ++i)
    {
        const GatherLobeRay ray = gatherLobeRay(to_eye, point.normal, roughness, i, kRays, 0);
        sum += brickRayLight(scene, sky, start.position, ray.direction).radiance * ray.weight;
        weights += ray.weight;
    }
    return sum / weights;
}

/// Maximum difference of a channel between two images.
int mostDifference(const Image& a, const Image& b)
{
    int most = 0;
    for (size_t i = 0; i < a.color.size(); ++i)
        for (int c = 0; c < 3; ++c)
            most = std::max(most, std::abs(channel(a.color[i], c) - channel(b.color[i], c)));
    return most;
}

} // namespace

TEST_F(BrickImageTest, gathersWhatTheCpuGathers)
{
    load();
    settled({}, 40);
    const SceneLighting lighting = gpu::makeLighting(*pack_);
    bricks::FaceLighting solver(makeBrickView(model_));
    solver.sweep(lighting, scene_->bricks->rays, 24);
    const Sky sky = lighting.sky;
    const BrickScene scene = solver.scene();
    const Float3 eye{2, 3, 7};
    const std::vector<GatherPoint> gathered = points();
    ASSERT_GT(gathered.size(), 60u);
    double square = 0, sum = 0, lobe_square = 0, lobe_sum = 0;
    size_t count = 0;
    for (const GatherPoint& point : gathered)
    {
        const Float3 position = (eye + point.position - model_.grid.origin) / model_.grid.voxel_size;
        const BrickStart start = brickSurfaceStart(scene, position, point.normal);
        // in corners the device searches for empty space elsewhere, too
        if (start.is_interior != 0 || length(start.position - position) > 2)
            continue;
        ++count;
        const Float3 truth = brickGather(scene, sky, start, 512, 1);
        const Float3 sharp = gatherLobe(scene, sky, start, point, kGatherSharpRoughness);
        const Float3 wide = gatherLobe(scene, sky, start, point, kGatherWideRoughness);
        const Float3 sharp_found{point.red.w, point.green.w, point.blue.w};
        for (int c = 0; c < 3; ++c)
        {
            square += std::pow(double(point.mean[c] - truth[c]), 2);
            sum += double(truth[c]);
            lobe_square += std::pow(double(sharp_found[c] - sharp[c]), 2);
            lobe_square += std::pow(double(point.wide[c] - wide[c]), 2);
            lobe_sum += double(sharp[c] + wide[c]);
        }
    }
    ASSERT_GT(count, gathered.size() * 3 / 4);
    const double rms = std::sqrt(square * 3 * double(count)) / sum; // relative to the mean
    EXPECT_LT(rms, 0.02);
    // the lobes weight the last frames of their cycle more than the others
    const double lobe_rms = std::sqrt(lobe_square * 6 * double(count)) / lobe_sum;
    EXPECT_LT(lobe_rms, 0.05);
}

TEST_F(BrickImageTest, standsStill)
{
    const auto unrest = [&]
    {
        settled({}, 40);
        Image last = frame();
        int most = 0;
        for (int i = 0; i < 16; ++i)
        {
            const Image next = frame();
            most = std::max(most, mostDifference(last, next));
            last = next;
        }
        return most;
    };
    load();
    EXPECT_LE(unrest(), 2); // of 255
    polish(0.1f);
    EXPECT_LE(unrest(), 3);
    polish(0.5f);
    EXPECT_LE(unrest(), 3);
}

TEST_F(BrickImageTest, mirrorImagesAreAsSharpAsTheSurfaceIsSmooth)
{
    // the wall is reflected in the left of the floor, the sky in its right
    const auto contrast = [&](float roughness)
    {
        polish(roughness);
        const Image image = settled({}, 20);
        double red[2]{}, green[2]{};
        for (uint32_t y = 0; y < kHeight; ++y)
            for (uint32_t x = 0; x < kWidth; ++x)
            {
                if (image.seen()[x + size_t{y} * kWidth][0] != kFloor ||
                    (x > kWidth / 4 && x < kWidth * 3 / 4))
                    continue;
                red[x > kWidth / 2 ? 1 : 0] += channel(image.at(x, y), 0);
                green[x > kWidth / 2 ? 1 : 0] += channel(image.at(x, y), 1);
            }
        return red[0] / green[0] / (red[1] / green[1]);
    };
    const double mirror = contrast(0.1f), smooth = contrast(0.35f), rough = contrast(0.6f),
                 matt = contrast(1);
    EXPECT_GT(mirror, 1.05 * smooth);
    EXPECT_GT(smooth, 1.1 * rough);
    EXPECT_GT(rough, 1.05 * matt);
}

/// Black that reflects as a dielectric, and black that reflects nothing below a coat of that dielectric.
TEST_F(BrickImageTest, aClearCoatMirrorsBricksAsADielectricDoes)
{
    floor_.base_color = {0, 0, 0, 1};
    for (const float roughness : {0.15f, 0.5f})
    {
        floor_.roughness = roughness;
        layers_ = formats::neutralLayers(0);
        test_ = TestScene();
        load();
        const Image dielectric = settled();
        floor_.roughness = 1;
        layers_.specular = 0;
        layers_.clearcoat = 1;
        layers_.clearcoat_roughness = roughness;
        test_ = TestScene();
        load();
        const Image coated = settled();
        EXPECT_LE(mostDifference(dielectric, coated), 1) << roughness;
        layers_.clearcoat = 0.2f;
        test_ = TestScene();
        load();
        EXPECT_GT(mostDifference(settled(), coated), 20) << roughness << ": its light is seen";
    }
}

/// Beside a red wall sheen on black is as red as paper.
TEST_F(BrickImageTest, sheenGetsTheLightOfBricks)
{
    load();
    const Image paper = settled();
    floor_.base_color = {0, 0, 0, 1};
    layers_.specular = 0;
    layers_.sheen_color = {1, 1, 1};
    layers_.sheen_roughness = 1;
    test_ = TestScene();
    load();
    const Image sheen = settled();
    double of_paper = 0, of_sheen = 0;
    for (size_t i = 0; i < paper.color.size(); ++i)
        if (paper.visibility[i] != kVisibilitySky)
        {
            of_paper += channel(paper.color[i], 0) - channel(paper.color[i], 2);
            of_sheen += channel(sheen.color[i], 0) - channel(sheen.color[i], 2);
        }
    std::printf("redness of paper %.0f, of sheen %.0f\n", of_paper, of_sheen);
    EXPECT_GT(of_paper, 10000);
    EXPECT_GT(of_sheen, 0.2 * of_paper);
}

TEST_F(BrickImageTest, whatMovesReceivesLight)
{
    load();
    const auto rednessOfCard = [&](const Image& image)
    {
        double red = 0, green = 0;
        size_t i = 0;
        for (const auto& seen : image.seen())
        {
            if (seen[0] == kCard)
            {
                red += channel(image.color[i], 0);
                green += channel(image.color[i], 1);
            }
            ++i;
        }
        EXPECT_GT(green, 0);
        return red / green;
    };
    const double far = rednessOfCard(settled({.debug_view = kViewGi}));
    const gpu::InstanceMove move = gpu::moveInstance(*scene_, kCard, translated(kCardNear)).value();
    frame({.debug_view = kViewGi, .moves = {&move, 1}});
    const double near = rednessOfCard(settled({.debug_view = kViewGi}, 8));
    EXPECT_GT(near, 1.15 * far);
}

/// A bar narrower than a tile has the light that it has in a picture whose tiles are narrower than the bar.
TEST_F(BrickImageTest, smallFormsHaveTheirOwnLight)
{
    card_width_ = 0.2f;
    const auto findLightOfCard = [&](uint32_t scale, Float3 eye)
    {
        scale_ = scale;
        test_ = TestScene();
        load();
        for (uint32_t i = 0; i < 24; ++i)
            frame({.debug_view = kViewGi}, eye);
        const Image image = frame({.debug_view = kViewGi}, eye);
        const std::vector<std::array<uint32_t, 3>> seen = image.seen();
        double sum = 0, count = 0;
        for (size_t i = 0; i < seen.size(); ++i)
            if (seen[i][0] == kCard)
            {
                sum += channel(image.color[i], 0);
                count += 1;
            }
        EXPECT_GT(count, 10);
        return sum / count;
    };
    double worst = 0;
    for (const float x : {1.4f, 1.8f, 2.2f, 2.6f})
    {
        const Float3 eye{x, 3, 7};
        const double small = findLightOfCard(1, eye), large = findLightOfCard(4, eye);
        std::printf("from %.1f: light of the bar %.1f, %.1f by small tiles\n", double{x}, small, large);
        worst = std::max(worst, std::abs(small / large - 1));
    }
    EXPECT_LT(worst, 0.02);
}

TEST_F(BrickImageTest, withoutTheirLightTheImageIsThatOfAPackWithoutBricks)
{
    load();
    const Image off = frame({.gi = false});
    const Image on = frame();
    EXPECT_NE(off.color, on.color);
    test_ = TestScene();
    load(false);
    EXPECT_EQ(frame({.gi = false}).color, off.color);
    EXPECT_EQ(frame().color, off.color);
}

TEST_F(BrickImageTest, tilesAndPartsShowTheSame)
{
    load();
    const Image whole = settled({.area = gpu::ShadedArea::wholeFrame}, 2);
    targets_.emplace(makeTargets(kWidth, kHeight));
    scene_ = upload(*pack_);
    EXPECT_EQ(settled({.area = gpu::ShadedArea::tiles}, 2).color, whole.color);
}

TEST_F(BrickImageTest, showsBricksAndTheirLight)
{
    load();
    const Image lit = settled({.debug_view = kViewBrickLighting}, 8);
    const Image cells = frame({.debug_view = kViewBricks});
    const auto red = std::count_if(lit.color.begin(), lit.color.end(),
                                   [](uint32_t c)
                                   { return channel(c, 0) > 200 && 2 * channel(c, 0) > 3 * channel(c, 1); });
    EXPECT_GT(red, 200);
    const uint32_t sky = lit.at(kWidth - 4, 2);
    EXPECT_GE(channel(sky, 2), channel(sky, 0));
    EXPECT_NE(cells.color, lit.color);
    // bluish, like the floor's albedo
    const uint32_t floor = cells.at(kWidth / 2, kHeight * 3 / 4);
    EXPECT_GT(channel(floor, 2), channel(floor, 0));
}

TEST_F(BrickImageTest, newLightIsSeenSoon)
{
    load();
    settled();
    const Image before = frame();
    formats::LightRecord out = sun({0.2f, -1, -0.3f});
    out.intensity = 0;
    const gpu::LightChange change = gpu::changeLight(*scene_, 0, out).value();
    const gpu::EmissionScale dark{{{-10, -10, -10}, {10, 10, 10}}, 0};
    frame({.lights = {&change, 1}, .emission = {&dark, 1}});
    const Image soon = settled({.emission = {&dark, 1}}, 20);
    const Image late = settled({.emission = {&dark, 1}}, 40);
    EXPECT_GT(mostDifference(before, late), 20);
    EXPECT_LE(mostDifference(soon, late), 3);
}

} // namespace hearth::test

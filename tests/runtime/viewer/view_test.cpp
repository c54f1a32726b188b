// Tests the debug views: every pixel has the colour that follows from its entry in the visibility buffer.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/decisions.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/shapes.h"
#include "tests/support/test_scene.h"

#include <cmath>
#include <functional>
#include <map>
#include <set>

namespace hearth::test
{

namespace
{

using namespace shared;

Camera rocksCamera()
{
    return {.position = {5, 3, 7}, .target = {0, 0, 0}, .y_fov_rad = 0.9f, .z_near = 0.05f};
}

Float3 mix(Float3 a, Float3 b, float along)
{
    return a * (1 - along) + b * along;
}

/// Value in an sRGB target after `count` additive steps, rounded after each.
int addedUp(float step, int count)
{
    int stored = 0;
    for (int i = 0; i < count; ++i)
    {
        const float encoded = static_cast<float>(stored) / 255;
        const float before =
            encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
        const float linear = std::min(before + step, 1.0f);
        stored = static_cast<int>(
            (linear <= 0.0031308f ? linear * 12.92f : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f) * 255 +
            0.5f);
    }
    return stored;
}

class ViewTest : public GpuTest
{
protected:
    /// Build rocks near and far, and foliage, which has hardly any cones; each with a material of its own.
    void SetUp() override
    {
        GpuTest::SetUp();
        std::mt19937 random(81);
        const uint32_t rock =
            test_.addMesh(withMaterial(shapes::rock(24, 0.25f), test_.addMaterial(plainMaterial())));
        const uint32_t leaves =
            test_.addMesh(withMaterial(shapes::foliage(400), test_.addMaterial(plainMaterial())));
        for (int i = 0; i < 8; ++i)
            test_.addInstance(i % 4 == 3 ? leaves : rock, randomAffine(random, 4));
        test_.addInstance(rock, translated({-12, 0, -25}));
        pack_.emplace(test_.build());
        scene_ = upload(*pack_);
    }

    Image drawView(uint32_t debug_view)
    {
        return draw(*scene_, rocksCamera(),
                    {.width = 320, .height = 200, .error_pixels = 2, .debug_view = debug_view});
    }

    const formats::ClusterRecord& getCluster(const VisibleCluster& slot) const
    {
        return pack_->clusters()[slot.cluster];
    }

    /// Expect that each pixel has the `expected` colour (0 to 1, as displayed) of its slot. Returns how many
    /// different colours there were.
    size_t expectColors(const Image& image, const std::function<Float3(const VisibleCluster&)>& expected)
    {
        std::set<uint32_t> colors;
        size_t wrong = 0;
        for (size_t i = 0; i < image.visibility.size(); ++i)
        {
            const uint32_t id = image.visibility[i];
            if (id == kVisibilitySky)
                continue;
            const Float3 color = expected(image.list.slots.at(id >> kTriangleBits));
            for (int c = 0; c < 3; ++c)
                wrong +=
                    std::abs(static_cast<float>(channel(image.color[i], c)) - color[c] * 255) > 1 ? 1u : 0u;
            colors.insert(image.color[i]);
        }
        EXPECT_EQ(wrong, 0u);
        return colors.size();
    }

    TestScene test_;
    std::optional<formats::PackView> pack_;
    std::unique_ptr<gpu::Scene> scene_;
};

} // namespace

TEST_F(ViewTest, errorIsThatOfTheCutRuleOverTheAllowedOne)
{
    const Image image = drawView(kViewError);
    const FrameView view = makeView(*scene_, rocksCamera(), {.width = 320, .height = 200, .error_pixels = 2});
    float largest = 0;
    const size_t colors = expectColors(
        image,
        [&](const VisibleCluster& slot)
        {
            const formats::ClusterRecord& cluster = getCluster(slot);
            float ratio = 0;
            if (cluster.refined_group != kInvalidIndex)
            {
                const formats::GroupRecord& group = pack_->groups()[cluster.refined_group];
                const formats::InstanceRecord& instance = pack_->instances()[slot.instance];
                const Float3 center = transformPoint(instance.world_from_object, group.sphere_center);
                const float distance = std::max(
                    length(center - view.eye) - instance.scale_max * group.sphere_radius, view.z_near);
                // pixels of error, of the two that are allowed
                ratio = instance.scale_max * group.error * view.lod_scale / distance / 2;
            }
            largest = std::max(largest, ratio);
            return mix({0.1f, 0.15f, 0.5f}, {1, 0.85f, 0.1f}, ratio);
        });
    EXPECT_GT(colors, 10u);
    EXPECT_GT(largest, 0.5f);
    EXPECT_LE(largest, 1.0f) << "what is drawn keeps to the allowed error";
}

TEST_F(ViewTest, conesAreThoseOfTheClusters)
{
    const size_t colors = expectColors(
        drawView(kViewCones),
        [&](const VisibleCluster& slot) -> Float3
        {
            const uint16_t cutoff = getCluster(slot).cone_cutoff;
            if (cutoff == formats::kNoCone)
                return {0.7f, 0.1f, 0.1f};
            return mix({0.1f, 0.7f, 0.3f}, {0.9f, 0.8f, 0.1f}, static_cast<float>(cutoff) / 65536);
        });
    EXPECT_GT(colors, 10u);
}

/// Views that give each thing a colour, dimmed by the angle to the eye: all pixels of a thing have one hue,
/// and other things mostly others.
TEST_F(ViewTest, thingsHaveAColourEach)
{
    const auto countHues =
        [&](uint32_t debug_view, const std::function<uint64_t(const VisibleCluster&, uint32_t)>& key)
    {
        const Image image = drawView(debug_view);
        std::map<uint64_t, Float3> hues;
        std::set<std::array<int, 3>> different;
        for (size_t i = 0; i < image.visibility.size(); ++i)
        {
            const uint32_t id = image.visibility[i];
            if (id == kVisibilitySky)
                continue;
            const uint32_t color = image.color[i];
            Float3 hue{static_cast<float>(channel(color, 0)), static_cast<float>(channel(color, 1)),
                       static_cast<float>(channel(color, 2))};
            hue = hue / std::max({hue.x, hue.y, hue.z});
            const auto [entry, fresh] =
                hues.emplace(key(image.list.slots.at(id >> kTriangleBits), id & 127u), hue);
            EXPECT_LT(length(entry->second - hue), 0.05f) << "view " << debug_view << " pixel " << i;
            if (fresh)
                different.insert({static_cast<int>(hue.x * 15), static_cast<int>(hue.y * 15),
                                  static_cast<int>(hue.z * 15)});
        }
        EXPECT_GT(hues.size(), 1u);
        EXPECT_GE(different.size(), std::min<size_t>(hues.size() / 2, 30)) << "view " << debug_view;
        return hues.size();
    };
    const auto cluster = [](const VisibleCluster& slot, uint32_t)
    { return uint64_t{slot.instance} << 32 | slot.cluster; };
    EXPECT_GT(countHues(kViewClusters, cluster), 50u);
    EXPECT_GT(countHues(kViewTriangles, [&](const VisibleCluster& slot, uint32_t triangle)
                        { return cluster(slot, 0) << 7 | triangle; }),
              500u);
    EXPECT_EQ(countHues(kViewMaterials, [&](const VisibleCluster& slot, uint32_t)
                        { return uint64_t{getCluster(slot).material}; }),
              2u);
}

TEST_F(ViewTest, overdrawCountsEveryLayer)
{
    // One-sided and two-sided squares and a mirrored one, each smaller than the one behind it; half of the
    // last is holes.
    TestScene test;
    formats::MaterialRecord two_sided = plainMaterial();
    two_sided.flags = formats::kMaterialDoubleSided;
    formats::MaterialRecord holes = plainMaterial();
    holes.alpha_mode = static_cast<uint32_t>(formats::AlphaMode::blend);
    holes.base_color.w = 0.5f;
    const uint32_t materials[] = {test.addMaterial(plainMaterial()), test.addMaterial(two_sided),
                                  test.addMaterial(holes)};
    constexpr int kLayers = 8;
    for (int i = 0; i < kLayers; ++i)
    {
        const float size = 2 - 0.25f * static_cast<float>(i);
        const uint32_t quad =
            test.addMesh(withMaterial(makeQuad(size, size), materials[i == kLayers - 1 ? 2 : i % 2]));
        Affine3 place = translated({0, 0, 0.001f * static_cast<float>(i)});
        place.m[0][0] = i == 4 ? -1.0f : 1.0f;
        test.addInstance(quad, place);
    }
    const formats::PackView pack = test.build();
    const auto scene = upload(pack);
    const auto expectLayers = [&](const Image& image, uint32_t x, int layers)
    {
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(channel(image.at(x, 64), c), addedUp(kOverdrawStep[c], layers), 1)
                << "x " << x << " layers " << layers;
    };
    // the square of side 2 fills the image
    const Camera front{
        .position = {0, 0, 2}, .target = {0, 0, 0}, .y_fov_rad = 2 * std::atan(0.5f), .z_near = 0.01f};
    gpu::FrameTargets targets = makeTargets(128, 128);
    for (const uint32_t flags : {0u, kCullEverything, kCullEverything})
    {
        const Image image = draw(*scene, targets, front,
                                 {.width = 128, .height = 128, .flags = flags, .debug_view = kViewOverdraw});
        for (uint32_t i = 0; i < kLayers - 1; ++i)
            expectLayers(image, 4 + 8 * i, static_cast<int>(i) + 1);
        int covered = 0; // of the 16 x 16 pixels of the last one
        for (uint32_t y = 56; y < 72; ++y)
            for (uint32_t x = 56; x < 72; ++x)
                covered += channel(image.at(x, y), 2) > addedUp(kOverdrawStep.z, kLayers - 1) + 2 ? 1 : 0;
        EXPECT_EQ(covered, 128);
    }
}

TEST_F(ViewTest, overdrawShowsBothPhases)
{
    gpu::FrameTargets targets = makeTargets(320, 200);
    const DrawOptions options{.width = 320, .height = 200, .debug_view = kViewOverdraw};
    std::mt19937 random(91);
    size_t covered = 0, many = 0, late = 0;
    for (int i = 0; i < 5; ++i)
    {
        // geometry that is occluded from there need not be occluded from here
        Camera before = rocksCamera();
        before.position += {uniform(random, -4, 4), uniform(random, -4, 4), uniform(random, -4, 4)};
        draw(*scene_, targets, before, options);
        const Image image = draw(*scene_, targets, rocksCamera(), options);
        late += image.list.slots.size() - image.list.counters.early_clusters;
        for (size_t pixel = 0; pixel < image.color.size(); ++pixel)
        {
            const int layers = channel(image.color[pixel], 2);
            ASSERT_EQ(layers > 0, image.visibility[pixel] != kVisibilitySky) << pixel;
            covered += layers > 0 ? 1u : 0u;
            many += layers > addedUp(kOverdrawStep.z, 1) + 2 ? 1u : 0u;
        }
    }
    EXPECT_GT(late, 20u);
    EXPECT_GT(covered, 10000u);
    EXPECT_GT(many, covered / 20);
}

} // namespace hearth::test

// Compares the light that occluders give back with closed forms: sunlit ground, the integrating sphere, and
// the white furnace.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/light/radiance_transfer.h"
#include "formats/gpu_shared/record_values.h"
#include "formats/gpu_shared/sky.h"
#include "formats/scene/radiance_transfer.h"
#include "tests/cook/visibility/ray_scenes.h"

#include <cstring>
#include <gtest/gtest.h>

#include <tbb/global_control.h>

namespace hearth::visibility
{
namespace
{

using formats::RadianceTransferRecord;
using shared::OccluderLight;

constexpr Float3 kGroundColor{0.6f, 0.4f, 0.2f};

std::vector<uint32_t> makeColors(const Mesh& mesh, Float3 color, bool double_sided)
{
    return std::vector<uint32_t>(mesh.corners.size() / 3, encodeSurfaceColor(color, double_sided));
}

/// Occluders of one mesh in one colour.
Occluders makeColored(const Mesh& mesh, Float3 color, bool double_sided = true)
{
    const std::vector<uint32_t> colors = makeColors(mesh, color, double_sided);
    return makeOccluders({{.positions = mesh.positions, .corners = mesh.corners, .colors = colors}});
}

/// Turn +z up to +y up: the sky is about +y.
Mesh standing(const Mesh& mesh)
{
    return transformed(mesh, {{{1, 0, 0, 0}, {0, 0, 1, 0}, {0, -1, 0, 0}}});
}

TransferPoint pointAt(Float3 position, Float3 normal)
{
    return {{position, normal, 1e-5f}, 1, {}};
}

constexpr shared::Sky kNoSky{};
constexpr shared::Sky kConstantSky{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}};

OccluderLight under(const std::optional<RadianceTransferRecord>& transfer, const shared::Sky& sky,
                    std::span<const shared::Light> suns = {})
{
    EXPECT_TRUE(transfer.has_value());
    return shared::transferLight(transfer.value_or(RadianceTransferRecord{}),
                                 shared::projectDistantLight(sky, suns));
}

shared::Light sunAt(double elevation, double azimuth)
{
    shared::Light sun{};
    sun.type = shared::kLightDirectional;
    sun.direction = {static_cast<float>(-std::cos(elevation) * std::cos(azimuth)),
                     static_cast<float>(-std::sin(elevation)),
                     static_cast<float>(-std::cos(elevation) * std::sin(azimuth))};
    sun.intensity = {3, 2, 1};
    return sun;
}

/// Expect a colour within an absolute error.
void expectNear(Float3 color, Float3 expected, float error)
{
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(color[c], expected[c], error) << c;
}

/// A wall sees the ground below the horizon: radiance rho (E_sun sin(elevation) + E_sky) / pi.
class SunlitGround : public testing::Test
{
protected:
    const Occluders ground_ = makeColored(standing(makeFloor(kFar)), kGroundColor);
    std::optional<RadianceTransferRecord> transfer_;

    void SetUp() override
    {
        std::vector<TransferPoint> points;
        for (int i = 0; i < 64; ++i)
            points.push_back(pointAt({static_cast<float>(i), 2, 0}, {0, 0, 1}));
        transfer_ = estimateTransfer(ground_, points, {.rays_per_point = 64});
    }
};

TEST_F(SunlitGround, givesBackTheSunByItsHeight)
{
    // nine harmonics are within a sixteenth of the sun's light from each direction
    for (const double degrees : {90.0, 60.0, 30.0, 10.0})
        for (const double azimuth : {0.0, 2.0, 4.0})
        {
            const shared::Light sun = sunAt(degrees / 180 * kPi, azimuth);
            const Float3 full = sun.intensity * kGroundColor / static_cast<float>(kPi);
            const Float3 found =
                shared::occluderRadiance(under(transfer_, kNoSky, {&sun, 1}), {0, -0.6f, 0.3f});
            const auto sine = static_cast<float>(std::sin(degrees / 180 * kPi));
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(found[c], full[c] * sine, full[c] * 0.115f) << degrees << " " << azimuth;
        }
}

TEST_F(SunlitGround, givesBackTheMeanOfAllSunsAsTheGroundDoes)
{
    // mean of the sun's cosine over the upper hemisphere: 1 / 2
    Float3 sum, full;
    constexpr int kHeights = 16, kTurns = 8;
    for (int i = 0; i < kHeights; ++i)
        for (int j = 0; j < kTurns; ++j)
        {
            const shared::Light sun = sunAt(std::asin((i + 0.5) / kHeights), 2 * kPi * j / kTurns);
            sum += shared::occluderRadiance(under(transfer_, kNoSky, {&sun, 1}), {0, -0.6f, 0.3f});
            full = sun.intensity * kGroundColor / static_cast<float>(kPi);
        }
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(sum[c] / (kHeights * kTurns), full[c] / 2, full[c] * 0.02f);
}

TEST_F(SunlitGround, givesBackTheSky)
{
    constexpr shared::Sky kSky{{0.3f, 0.4f, 0.6f}, {0.5f, 0.45f, 0.4f}, {0.12f, 0.1f, 0.08f}};
    Float3 irradiance;
    constexpr int kHeights = 1000;
    for (int i = 0; i < kHeights; ++i)
    {
        const float height = (static_cast<float>(i) + 0.5f) / kHeights;
        irradiance += shared::skyRadiance(kSky, {std::sqrt(1 - height * height), height, 0}) *
                      (2 * static_cast<float>(kPi) * height / kHeights);
    }
    const Float3 expected = kGroundColor * irradiance / static_cast<float>(kPi);
    const Float3 found = shared::occluderRadiance(under(transfer_, kSky), {0, -0.6f, 0.3f});
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(found[c] / expected[c], 1, 0.02);
}

TEST_F(SunlitGround, isDarkAtNight)
{
    const shared::Light below = sunAt(-kPi / 4, 1);
    // what nine harmonics leave of the light from below
    expectNear(shared::occluderRadiance(under(transfer_, kNoSky, {&below, 1}), {0, -0.6f, 0.3f}), {}, 0.06f);
    expectNear(shared::occluderRadiance(under(transfer_, kNoSky), {0, -0.6f, 0.3f}), {}, 0);
}

/// A sphere of albedo rho, of whose area a part f is open: under a constant sky of radiance 1 all of its
/// inside has the radiance rho f / (1 - rho (1 - f)), over all bounces.
TEST(IntegratingSphere, hasOneRadiance)
{
    for (const double top : {0.5, 0.75, 0.9})
        for (const float color : {0.3f, 0.8f})
        {
            const Mesh sphere = makeSphere(48, 96, top, true);
            const double open = (1 + std::cos(kPi * top)) / 2;
            const double expected = double{color} * open / (1 - double{color} * (1 - open));
            const std::vector<SamplePoint> all = makePoints(sphere, 0.05);
            std::vector<TransferPoint> points;
            for (size_t i = 0; i < all.size(); i += std::max<size_t>(all.size() / 4096, 1))
                points.push_back({all[i], 1, {}});
            const auto transfer =
                estimateTransfer(makeColored(sphere, {color, color, color}), points, {.rays_per_point = 64});
            const OccluderLight light = under(transfer, kConstantSky);
            for (const Float3 direction : {Float3{0, 0, -0.9f}, Float3{0.7f, 0, 0}, Float3{0, -0.5f, -0.5f}})
                EXPECT_NEAR(shared::occluderRadiance(light, direction).x / expected, 1, 0.03)
                    << top << " " << color;
        }
}

/// Surfaces that reflect all light look like the sky all around.
TEST(WhiteFurnace, occludersAreAsBrightAsTheSky)
{
    Mesh mesh = makeFloor(2);
    mesh.addQuad({0, -2, 0}, {0, 2, 0}, {0, 2, 2}, {0, -2, 2});
    std::vector<TransferPoint> points;
    for (const SamplePoint& point : makePoints(mesh, 8))
        points.push_back({point, 1, {}});
    const auto transfer = estimateTransfer(makeColored(mesh, {1, 1, 1}), points, {.rays_per_point = 256});
    const OccluderLight light = under(transfer, kConstantSky);
    for (const Float3 direction : {Float3{0.6f, 0, -0.4f}, Float3{-0.6f, 0, 0.2f}, Float3{0, 0, -0.6f}})
        expectNear(shared::occluderRadiance(light, direction), {1, 1, 1}, 0.02f);
}

/// A red wall on one side and a green one on the other.
TEST(RadianceTransfer, dependsOnTheDirection)
{
    Mesh left, right;
    left.addQuad({-6, -5, -5}, {-6, 5, -5}, {-6, 5, 5}, {-6, -5, 5});
    right.addQuad({6, -5, -5}, {6, 5, -5}, {6, 5, 5}, {6, -5, 5});
    const auto red = makeColors(left, {0.5f, 0, 0}, true), green = makeColors(right, {0, 0.5f, 0}, true);
    const Occluders walls =
        makeOccluders({{.positions = left.positions, .corners = left.corners, .colors = red},
                       {.positions = right.positions, .corners = right.corners, .colors = green}});
    std::vector<TransferPoint> points;
    for (int i = 0; i < 64; ++i)
        points.push_back(pointAt({0, static_cast<float>(i % 8 - 4), 0}, {i % 2 == 0 ? 1.0f : -1.0f, 0, 0}));
    const OccluderLight light = under(estimateTransfer(walls, points, {}), kConstantSky);
    const Float3 from_left = shared::occluderRadiance(light, {-0.66f, 0, 0}),
                 from_right = shared::occluderRadiance(light, {0.66f, 0, 0});
    EXPECT_GT(from_left.x, 0.3f);
    EXPECT_LT(from_left.y, 0.06f); // that a linear function of the direction leaves
    EXPECT_GT(from_right.y, 0.3f);
    EXPECT_LT(from_right.x, 0.06f);
}

TEST(RadianceTransfer, isNoneWhereNothingOccludes)
{
    const Occluders floor = makeColored(makeFloor(1), {1, 1, 1});
    const TransferPoint point = pointAt({0, 0, 0}, kUp);
    EXPECT_FALSE(estimateTransfer(floor, {&point, 1}, {}).has_value());
    // nothing is near enough
    const TransferPoint below = pointAt({0, 0, -0.5f}, kUp);
    EXPECT_FALSE(estimateTransfer(floor, {&below, 1}, {.distance = 0.4f}).has_value());
    EXPECT_TRUE(estimateTransfer(floor, {&below, 1}, {}).has_value());
}

/// Rays that leave a solid through its back show what nobody sees.
TEST(RadianceTransfer, doesNotCountTheInsideOfSolids)
{
    const Mesh solid = makeSphere(16, 32, 1, false);
    const TransferPoint point = pointAt({0, 0, 0}, kUp);
    EXPECT_FALSE(estimateTransfer(makeColored(solid, {1, 1, 1}, false), {&point, 1}, {}).has_value());
    EXPECT_TRUE(estimateTransfer(makeColored(solid, {1, 1, 1}, true), {&point, 1}, {}).has_value());
}

/// Instances that are mirrored or many keep their fronts.
TEST(RadianceTransfer, seesFrontsOfInstances)
{
    const Mesh floor = makeFloor(1);
    const auto colors = makeColors(floor, {0.5f, 0.5f, 0.5f}, false);
    for (const size_t count : {size_t{1}, size_t{100}}) // many are merged
        for (const float side : {1.0f, -1.0f})
        {
            Occluders occluders;
            const auto mesh =
                occluders.add({.positions = floor.positions, .corners = floor.corners, .colors = colors});
            for (size_t i = 0; i < count; ++i)
                occluders.place(mesh,
                                {{{side, 0, 0, 4.0f * static_cast<float>(i)}, {0, 1, 0, 0}, {0, 0, 1, 0}}});
            occluders.finish();
            const auto front = occluders.nearest({0.2f, 0.3f, 1}, {0, 0, -1});
            const auto back = occluders.nearest({0.2f, 0.3f, -1}, {0, 0, 1});
            ASSERT_TRUE(front && back);
            EXPECT_FALSE(front->is_inside);
            EXPECT_TRUE(back->is_inside);
            EXPECT_EQ(front->normal, (Float3{0, 0, 1}));
            EXPECT_EQ(back->normal, (Float3{0, 0, -1}));
            EXPECT_FLOAT_EQ(front->distance, 1);
        }
}

TEST(RadianceTransfer, meetsEqualMeshesOnce)
{
    const Mesh floor = makeFloor(1), other = makeFloor(2);
    const auto gray = makeColors(floor, {0.5f, 0.5f, 0.5f}, false), red = makeColors(floor, {1, 0, 0}, false);
    Occluders occluders;
    const OccluderMesh mesh{.positions = floor.positions, .corners = floor.corners, .colors = gray};
    const Occluders::Mesh first = occluders.add(mesh);
    OccluderMesh colored = mesh, larger = mesh, masked = mesh, open = mesh;
    colored.colors = red;
    larger.positions = other.positions;
    masked.mask = [](uint32_t, float, float) { return false; };
    open.back_faces = BackFaces::let_through;
    for (const OccluderMesh& different : {colored, larger, masked, open})
        EXPECT_NE(occluders.add(different), first);
    EXPECT_NE(occluders.add(masked), occluders.add(masked));
    EXPECT_EQ(occluders.add(mesh), first);
    // 100 copies in two places, the second one mirrored: two instances, too few to be merged
    for (int i = 0; i < 100; ++i)
        occluders.place(first, {{{i % 2 == 0 ? 1.0f : -1.0f, 0, 0, 4.0f * static_cast<float>(i % 2)},
                                 {0, 1, 0, 0},
                                 {0, 0, 1, 0}}});
    occluders.finish();
    for (const float x : {0.2f, 4.2f})
    {
        const auto front = occluders.nearest({x, 0.3f, 1}, {0, 0, -1});
        ASSERT_TRUE(front);
        EXPECT_FALSE(front->is_inside);
        EXPECT_NEAR(front->color.x, 0.5f, 0.01f);
    }
    EXPECT_FALSE(occluders.nearest({8.2f, 0.3f, 1}, {0, 0, -1}));
}

/// Solids that stick in each other: paths from one to the inside of the other end there.
TEST(RadianceTransfer, endsPathsInsideSolids)
{
    // the opening of the outer solid is seen by paths from its inside, but not from the lower half of the
    // inner solid
    const Mesh outer = makeSphere(16, 32, 0.9, false);
    const Mesh inner = transformed(makeSphere(16, 32, 1, false), scaledAndMoved(0.5f, {0, 0, 0.25f}));
    const TransferPoint point = pointAt({0, 0, -0.6f}, kUp);
    for (const bool double_sided : {false, true})
    {
        const auto outside = makeColors(outer, {1, 1, 1}, double_sided);
        Occluders occluders;
        for (const Mesh* mesh : {&outer, &inner})
            occluders.place(
                occluders.add({.positions = mesh->positions, .corners = mesh->corners, .colors = outside}));
        occluders.finish();
        const auto transfer = estimateTransfer(occluders, {&point, 1}, {});
        ASSERT_TRUE(transfer);
        EXPECT_EQ(std::ranges::any_of(transfer->values, [](uint16_t half) { return half != 0; }),
                  double_sided);
    }
}

TEST(RadianceTransfer, isTheSameForAnyNumberOfThreads)
{
    const Mesh sphere = makeSphere(16, 32, 0.7, true);
    const Occluders occluders = makeColored(sphere, kGroundColor);
    std::vector<TransferPoint> points;
    for (const SamplePoint& point : makePoints(sphere, 1))
        points.push_back({point, 1, {}});
    std::vector<RadianceTransferRecord> found;
    for (const size_t threads : {size_t{1}, size_t{5}})
    {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        found.push_back(estimateTransfer(occluders, points, {}).value());
    }
    EXPECT_EQ(std::memcmp(&found[0], &found[1], sizeof(found[0])), 0);
}

} // namespace
} // namespace hearth::visibility

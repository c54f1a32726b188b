// Tests the sample of many lights: their number, ranges and motion, what camera "thirty" sees, and that the
// import has nothing to say about the file.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/market.h"
#include "sample_assets/shapes/glb_writer.h"
#include "sample_assets/shapes/sample_math.h"
#include "tests/support/sandbox.h"

#include <gtest/gtest.h>

#include <set>
#include <sstream>

namespace hearth::test
{

namespace
{

using samples::Document;
using samples::kNoIndex;
using samples::Light;
using samples::LightKind;

const Document& defaultMarket()
{
    static const Document market = samples::makeMarket(192);
    return market;
}

/// Light of a document, where it is in the rest pose.
struct PlacedLight
{
    Light light;
    Float3 position;
    bool moves = false; ///< a track moves its node, or one above it
};

/// Return the lights of the nodes below `node`.
void findLights(const Document& document, int index, const samples::Placement& above, bool moves,
                std::vector<PlacedLight>& found)
{
    const samples::Node& node = document.nodes[static_cast<size_t>(index)];
    const samples::Placement placement{samples::rotate(above.rotation, node.placement.translation) +
                                           above.translation,
                                       samples::multiply(above.rotation, node.placement.rotation),
                                       {1, 1, 1}};
    for (const samples::Track& track : document.animations.front().tracks)
        moves = moves || track.node == index;
    if (node.light != kNoIndex)
        found.push_back({document.lights[static_cast<size_t>(node.light)], placement.translation, moves});
    for (const int child : node.children)
        findLights(document, child, placement, moves, found);
}

std::vector<PlacedLight> findLights(const Document& document)
{
    std::vector<PlacedLight> found;
    for (const int root : document.roots)
        findLights(document, root, {}, false, found);
    return found;
}

size_t count(const Document& document, LightKind kind)
{
    return static_cast<size_t>(std::count_if(document.lights.begin(), document.lights.end(),
                                             [&](const Light& light) { return light.kind == kind; }));
}

/// Return how far the ball of a light reaches into a camera's view, by its five planes at 16:9; negative: it
/// is outside.
float depthInView(const Document& document, const std::string& camera, const PlacedLight& light)
{
    const auto node =
        std::find_if(document.nodes.begin(), document.nodes.end(),
                     [&](const samples::Node& n) { return n.camera != kNoIndex && n.name == camera; });
    const samples::Camera& lens = document.cameras[static_cast<size_t>(node->camera)];
    const Float4 turn = node->placement.rotation;
    const Float3 local =
        samples::rotate({-turn.x, -turn.y, -turn.z, turn.w}, light.position - node->placement.translation);
    const float slope_y = samples::sine(lens.y_fov_rad / 2) / samples::cosine(lens.y_fov_rad / 2);
    const float slope_x = slope_y * 16 / 9;
    float depth = -local.z - lens.z_near;
    for (const float side : {-1.0f, 1.0f})
    {
        depth = std::min(depth, (-local.z * slope_x + side * local.x) / std::sqrt(1 + slope_x * slope_x));
        depth = std::min(depth, (-local.z * slope_y + side * local.y) / std::sqrt(1 + slope_y * slope_y));
    }
    return depth + light.light.range;
}

class MarketLights : public ::testing::TestWithParam<uint32_t>
{
};

INSTANTIATE_TEST_SUITE_P(Counts, MarketLights, ::testing::Values(1, 3, 30, 192, 1024, 4096));

} // namespace

TEST_P(MarketLights, areAsManyAsAskedForWithinTheirRanges)
{
    struct Limits
    {
        uint32_t count;
        float low, high;
    };
    constexpr Limits kLimits[] = {{192, 3, 12}, {1024, 2, 8}, {4096, 1, 5}};
    const uint32_t light_count = GetParam();
    const auto* const limits = std::find_if(std::begin(kLimits), std::end(kLimits),
                                            [&](const Limits& row) { return light_count <= row.count; });
    const Document document = samples::makeMarket(light_count);
    ASSERT_EQ(document.lights.size(), light_count);
    EXPECT_EQ(count(document, LightKind::directional), std::min(light_count, 3u));
    std::set<std::string> names;
    for (const PlacedLight& placed : findLights(document))
    {
        const Light& light = placed.light;
        EXPECT_TRUE(names.insert(light.name).second) << light.name;
        EXPECT_GT(light.intensity, 0) << light.name;
        EXPECT_LE(std::max({light.color.x, light.color.y, light.color.z}), 1) << light.name;
        EXPECT_TRUE(light.flicker.amplitude >= 0 && light.flicker.amplitude <= 1) << light.name;
        if (light.kind == LightKind::directional)
            continue;
        EXPECT_TRUE(light.range >= limits->low && light.range <= limits->high)
            << light.name << ' ' << light.range;
        EXPECT_TRUE(std::abs(placed.position.x) < 25 && std::abs(placed.position.z) < 43) << light.name;
        EXPECT_TRUE(placed.position.y > 0 && placed.position.y < 9) << light.name;
    }
    EXPECT_EQ(names.size(), light_count) << "each light has a node";
}

TEST(Market, hasSpotsFromNarrowToWide)
{
    float narrowest = 2, widest = 0;
    for (const Light& light : defaultMarket().lights)
    {
        if (light.kind != LightKind::spot)
            continue;
        EXPECT_LT(light.inner_cone_rad, light.outer_cone_rad);
        narrowest = std::min(narrowest, light.outer_cone_rad);
        widest = std::max(widest, light.outer_cone_rad);
    }
    EXPECT_GT(count(defaultMarket(), LightKind::spot), 30u);
    EXPECT_LT(narrowest, 0.2f);
    EXPECT_GT(widest, 1.5f);
    EXPECT_LT(widest, samples::kPi / 2);
}

// a renderer may draw only the first lights of a file
TEST(Market, hasLampsOfEachKindAmongItsFirstLights)
{
    for (const std::string kind :
         {"stall_lamp_", "lantern_", "lamp_post_", "accent_", "sign_", "moving_lamp_"})
        EXPECT_TRUE(std::any_of(defaultMarket().lights.begin(), defaultMarket().lights.begin() + 64,
                                [&](const Light& light) { return light.name.starts_with(kind); }))
            << kind;
}

TEST(Market, hasLightsThatMoveAndFlicker)
{
    ASSERT_EQ(defaultMarket().animations.size(), 1u);
    EXPECT_EQ(defaultMarket().animations[0].name, "evening");
    size_t moving = 0, flickering = 0;
    for (const PlacedLight& placed : findLights(defaultMarket()))
    {
        moving += placed.moves ? 1 : 0;
        flickering += placed.light.flicker.amplitude > 0 ? 1 : 0;
    }
    EXPECT_GT(moving, 10u);
    EXPECT_GT(flickering, 15u);
}

TEST(Market, hasLightsThatBlinkAndChangeColour)
{
    std::set<samples::LightProperty> properties;
    for (const samples::LightTrack& track : defaultMarket().animations[0].light_tracks)
    {
        properties.insert(track.property);
        ASSERT_LT(static_cast<size_t>(track.light), defaultMarket().lights.size());
        EXPECT_EQ(track.times.back(), 12);
        EXPECT_EQ(track.values.front(), track.values.back()) << "the clip loops";
        const Light& light = defaultMarket().lights[static_cast<size_t>(track.light)];
        EXPECT_EQ(track.values.front(),
                  track.property == samples::LightProperty::color ? light.color : Float3{light.intensity});
    }
    EXPECT_EQ(properties.size(), 2u);
}

// S. Yeung's test scene of a light pre-pass renderer: three directional lights, 30 point lights, two
// characters
TEST(Market, showsThirtyPointLightsToOneCamera)
{
    size_t points = 0, spots = 0;
    float nearest = 1e3f;
    for (const PlacedLight& placed : findLights(defaultMarket()))
    {
        if (placed.light.kind == LightKind::directional)
            continue;
        const float depth = depthInView(defaultMarket(), "thirty", placed);
        nearest = std::min(nearest, std::abs(depth));
        if (depth > 0)
            ++(placed.light.kind == LightKind::point ? points : spots);
    }
    EXPECT_EQ(points, 30u);
    EXPECT_EQ(spots, 0u);
    EXPECT_EQ(count(defaultMarket(), LightKind::directional), 3u);
    EXPECT_GT(nearest, 0.15f) << "metres: rounding decides about no light";
    EXPECT_EQ(defaultMarket().skins.size(), 2u);
}

TEST(Market, hasTheSameBytesAgain)
{
    const samples::GlbFile first = samples::encodeGlb(defaultMarket());
    const samples::GlbFile second = samples::encodeGlb(samples::makeMarket(192));
    EXPECT_EQ(first.head, second.head);
    EXPECT_EQ(first.binary, second.binary);
}

TEST(Market, staysSmallWithManyLights)
{
    const samples::GlbFile few = samples::encodeGlb(defaultMarket());
    const samples::GlbFile many = samples::encodeGlb(samples::makeMarket(4096));
    EXPECT_LT(many.binary.size() - few.binary.size(), 8192u) << "lamps are drawn with and without a light";
    EXPECT_LT(many.head.size(), size_t{2} << 20);
}

TEST(Market, isImportedWithoutWarningsButOfAnimatedLights)
{
    Sandbox folder;
    for (const std::string count : {"1", "192", "4096"})
    {
        ASSERT_EQ(folder.run({HEARTH_BIN "/hearth-samples", "market", "-o", "market.glb", "--lights", count})
                      .exit_code,
                  0);
        const ProgramEnd end = folder.run({HEARTH_BIN "/hearth-import", "market.glb", "-o", "market.part"});
        EXPECT_EQ(end.exit_code, 0);
        std::istringstream lines(end.err);
        for (std::string line; std::getline(lines, line);)
            EXPECT_NE(line.find("pointer"), std::string::npos) << line;
    }
}

TEST(Market, refusesOtherCounts)
{
    Sandbox folder;
    for (const std::string count : {"0", "4097", "many"})
    {
        const ProgramEnd end =
            folder.run({HEARTH_BIN "/hearth-samples", "market", "-o", "market.glb", "--lights", count});
        EXPECT_EQ(end.exit_code, 2) << count;
        EXPECT_NE(end.err.find("--lights"), std::string::npos) << end.err;
    }
}

} // namespace hearth::test

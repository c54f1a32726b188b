// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/market/lights.h"

#include "formats/base/assert.h"
#include "sample_assets/market/surroundings.h"
#include "sample_assets/shapes/noise.h"
#include "sample_assets/shapes/sample_math.h"

namespace hearth::samples::market
{

namespace
{

/// Illuminance that a lamp would have at its range without the window that ends it there, lux: 0.32 makes a
/// lantern of 7 m a bulb of 16 cd, and a candle of 1.5 m one of 0.7 cd.
constexpr float kEndIlluminance = 0.32f;

/// Share of the lights that a kind of fixture gets, beside the others of its rank. Rank 1 comes after all of
/// rank 0.
struct Share
{
    uint32_t rank;
    float weight;
    const char* name; ///< of the lights
};
constexpr std::array<Share, kFixtureKinds> kShares{{{0, 4.0f, "stall_lamp"},
                                                    {0, 2.5f, "lantern"},
                                                    {0, 0.8f, "lamp_post"},
                                                    {0, 1.0f, "accent"},
                                                    {0, 0.5f, "sign"},
                                                    {0, 0.8f, "moving_lamp"},
                                                    {1, 10.0f, "eave_bulb"},
                                                    {1, 2.2f, "string_bulb"},
                                                    {1, 5.0f, "candle"},
                                                    {1, 9.5f, "tree_bulb"},
                                                    {1, 5.0f, "facade_bulb"},
                                                    {1, 1.4f, "ground_candle"}}};

/// Return the kinds of the fixtures that get a light, in order, by the largest averages of V. D'Hondt: each
/// first part of the order has the shares, too, so that a renderer of few lights shows some of each kind.
/// available  fixtures of each kind
std::vector<uint32_t> shareOut(const std::array<uint32_t, kFixtureKinds>& available, uint32_t count)
{
    std::vector<uint32_t> order;
    std::array<uint32_t, kFixtureKinds> given{};
    for (uint32_t rank = 0; rank <= 1; ++rank)
        while (order.size() < count)
        {
            uint32_t best = kFixtureKinds;
            float best_average = 0;
            for (uint32_t kind = 0; kind < kFixtureKinds; ++kind)
            {
                const float average = kShares[kind].weight / static_cast<float>(given[kind] + 1);
                if (kShares[kind].rank != rank || given[kind] == available[kind] || average <= best_average)
                    continue;
                best = kind;
                best_average = average;
            }
            if (best == kFixtureKinds)
                break;
            ++given[best];
            order.push_back(best);
        }
    HEARTH_ASSERT(order.size() == count);
    return order;
}

void addSun(Document& document, const char* name, Float3 color, float lux, Float3 towards)
{
    Node node;
    node.name = name;
    node.light = add(document.lights,
                     Light{.name = name, .kind = LightKind::directional, .color = color, .intensity = lux});
    node.placement.rotation = rotationLookingAt(towards, {0, 0, 0});
    addRoot(document, node);
}

void addSuns(Document& document, uint32_t count)
{
    if (count > 0)
        addSun(document, "moon", {0.62f, 0.74f, 1.0f}, 0.30f, moonDirection());
    if (count > 1)
        addSun(document, "town_glow", {1.0f, 0.62f, 0.38f}, 0.08f, {0.70f, 0.42f, -0.58f});
    if (count > 2)
        addSun(document, "sky_glow", {0.45f, 0.55f, 1.0f}, 0.06f, {0.64f, 0.77f, -0.05f});
}

int addFixtureLight(Document& document, const Fixture& fixture, const RangeLimits& limits, std::string name)
{
    Light light;
    light.name = name;
    light.kind = fixture.light;
    light.color = fixture.color;
    light.range = std::clamp(fixture.range * limits.factor, limits.low, limits.high);
    light.intensity = kEndIlluminance * light.range * light.range;
    if (light.kind == LightKind::spot)
    {
        light.inner_cone_rad = fixture.inner_cone_rad;
        light.outer_cone_rad = fixture.outer_cone_rad;
    }
    if (fixture.flicker > 0)
    {
        const auto seed = static_cast<uint32_t>(document.lights.size());
        light.flicker = {6 + 4 * randomUnit(seed, 1201), fixture.flicker, seed};
    }
    Node node;
    node.name = std::move(name);
    node.placement.translation = fixture.position - Float3{0, fixture.light_drop, 0};
    if (light.kind == LightKind::spot)
        node.placement.rotation = rotationBetween({0, 0, -1}, fixture.direction);
    const int index = add(document.lights, std::move(light));
    node.light = index;
    if (fixture.node == kNoIndex)
        addRoot(document, node);
    else
    {
        const int child = add(document.nodes, node);
        document.nodes[static_cast<size_t>(fixture.node)].children.push_back(child);
    }
    return index;
}

} // namespace

RangeLimits rangeLimits(uint32_t light_count)
{
    struct Row
    {
        float count;
        RangeLimits limits;
    };
    constexpr Row kRows[] = {{192, {3, 12, 1}}, {1024, {2, 8, 0.85f}}, {4096, {1, 5, 0.85f}}};
    const auto count = static_cast<float>(light_count);
    for (size_t i = 0; i + 1 < std::size(kRows); ++i)
    {
        const Row &from = kRows[i], &to = kRows[i + 1];
        const float share = clamp01((count - from.count) / (to.count - from.count));
        if (share < 1)
            return {lerp(from.limits.low, to.limits.low, share),
                    lerp(from.limits.high, to.limits.high, share),
                    lerp(from.limits.factor, to.limits.factor, share)};
    }
    return kRows[std::size(kRows) - 1].limits;
}

std::vector<int> addLights(Document& document, const std::vector<Fixture>& fixtures, uint32_t count)
{
    const uint32_t suns = std::min(count, kSunCount);
    addSuns(document, suns);
    std::array<std::vector<size_t>, kFixtureKinds> fixtures_of_kind;
    for (size_t i = 0; i < fixtures.size(); ++i)
        fixtures_of_kind[static_cast<size_t>(fixtures[i].kind)].push_back(i);
    std::array<uint32_t, kFixtureKinds> available{}, used{};
    for (size_t kind = 0; kind < kFixtureKinds; ++kind)
        available[kind] = static_cast<uint32_t>(fixtures_of_kind[kind].size());

    const RangeLimits limits = rangeLimits(count);
    std::vector<int> light_of_fixture(fixtures.size(), kNoIndex);
    for (const uint32_t kind : shareOut(available, count - suns))
    {
        const size_t fixture = fixtures_of_kind[kind][used[kind]];
        const std::string name = std::string(kShares[kind].name) + "_" + std::to_string(used[kind]++);
        light_of_fixture[fixture] = addFixtureLight(document, fixtures[fixture], limits, name);
    }
    return light_of_fixture;
}

} // namespace hearth::samples::market

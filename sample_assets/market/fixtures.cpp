// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/market/fixtures.h"

#include "sample_assets/market/pieces.h"
#include "sample_assets/market/street.h"
#include "sample_assets/market/surroundings.h"
#include "sample_assets/shapes/noise.h"
#include "sample_assets/shapes/sample_math.h"

namespace hearth::samples::market
{

namespace
{

constexpr float kDegree = kPi / 180;

/// Half-angles of the spots of stalls, from narrow to nearly a half space.
constexpr std::array kStallCones{28 * kDegree, 40 * kDegree, 55 * kDegree, 72 * kDegree, 88 * kDegree};

void addStallLamps(const Plan& plan, std::vector<Fixture>& fixtures)
{
    for (uint32_t i = 0; i < plan.stalls.size(); ++i)
    {
        const auto random = [&](uint32_t which) { return randomUnit(i * 4 + which, 1101); };
        const Placement& stall = plan.stalls[i].placement;
        Fixture fixture;
        fixture.position = fromPlacement(stall, kStallLamp);
        fixture.color = random(0) < 0.75f ? kBulbColor : Float3{1.0f, 0.82f, 0.60f};
        fixture.range = 3.6f + 2.8f * random(1);
        if (plan.stalls[i].has_spots && random(2) < 0.5f)
        {
            fixture.light = LightKind::spot;
            fixture.outer_cone_rad = kStallCones[i % kStallCones.size()];
            fixture.inner_cone_rad = fixture.outer_cone_rad * 0.6f;
            fixture.look = 1;
        }
        fixtures.push_back(fixture);
    }
}

void addLanterns(const Plan& plan, std::vector<Fixture>& fixtures)
{
    for (uint32_t i = 0; i < plan.strings.size(); ++i)
    {
        const LampString& string = plan.strings[i];
        if (string.swings)
            continue;
        const uint32_t count = string.to.x - string.from.x > 6 ? 5 : 3;
        for (uint32_t k = 0; k < count; ++k)
        {
            Fixture fixture{.kind = FixtureKind::lantern};
            const float share = (static_cast<float>(k) + 0.5f) / static_cast<float>(count);
            fixture.position = stringPoint(string, share) - Float3{0, kLanternDrop, 0};
            // warm papers are three times as frequent as the others
            const float random = randomUnit(i * 8 + k, 1102);
            fixture.look =
                static_cast<uint32_t>(random < 0.72f ? random / 0.24f : 3 + (random - 0.72f) / 0.0934f);
            fixture.light_drop = kLanternLightDrop;
            fixture.color = kPaperColors[fixture.look];
            fixture.range = 5.4f + 2.2f * randomUnit(i * 8 + k, 1103);
            fixture.flicker = k % 2 == 0 ? 0.25f : 0.0f;
            fixtures.push_back(fixture);
        }
    }
}

void addLampPosts(const Plan& plan, std::vector<Fixture>& fixtures)
{
    for (const Placement& post : plan.lamp_posts)
    {
        Fixture fixture{.kind = FixtureKind::lamp_post};
        fixture.position = fromPlacement(post, kPostLight);
        fixture.color = {1.0f, 0.60f, 0.26f};
        fixture.range = 8.5f + 3.5f * randomUnit(static_cast<uint32_t>(fixtures.size()), 1104);
        fixtures.push_back(fixture);
    }
}

/// Add two narrow spots below each roof, which cross on the goods.
void addAccents(const Plan& plan, std::vector<Fixture>& fixtures)
{
    for (uint32_t i = 0; i < plan.stalls.size(); ++i)
        for (const float side : {-1.0f, 1.0f})
        {
            if (!plan.stalls[i].has_spots)
                continue;
            const Placement& stall = plan.stalls[i].placement;
            const auto random = [&](uint32_t which)
            { return randomUnit(i * 16 + (side > 0 ? 8u : 0u) + which, 1105); };
            const Float3 from = fromPlacement(stall, {side * 1.2f, 2.1f, 0.9f});
            const Float3 to = fromPlacement(stall, {side * (0.9f - 0.7f * random(0)), kCounterTop, 0.55f});
            Fixture fixture{.kind = FixtureKind::accent, .light = LightKind::spot};
            fixture.position = from;
            fixture.direction = normalize(to - from);
            fixture.outer_cone_rad = (7 + 16 * random(1)) * kDegree;
            fixture.inner_cone_rad = fixture.outer_cone_rad * 0.5f;
            fixture.color = random(2) < 0.7f ? Float3{1.0f, 0.86f, 0.66f} : kPaperColors[3 + i % 3];
            fixture.range = 3.4f + 1.6f * random(3);
            fixtures.push_back(fixture);
        }
}

void addSignLights(const Plan& plan, std::vector<Fixture>& fixtures)
{
    for (const Sign& sign : placeSigns(plan))
    {
        Fixture fixture{.kind = FixtureKind::sign};
        fixture.position = fromPlacement(sign.placement, {0, 0, 0.3f});
        fixture.color = kPaperColors[sign.color];
        fixture.look = sign.color;
        fixture.range = 4.5f;
        fixtures.push_back(fixture);
    }
}

/// Return a bulb of a string, or a candle, that has a short range.
Fixture makeBulb(FixtureKind kind, Float3 position, uint32_t id)
{
    Fixture fixture{.kind = kind};
    fixture.position = position;
    fixture.color = kBulbColor;
    fixture.range = 1.3f + 0.9f * randomUnit(id, 1106);
    return fixture;
}

void addEaveBulbs(const Plan& plan, std::vector<Fixture>& fixtures)
{
    constexpr uint32_t kBulbs = 14;
    for (uint32_t i = 0; i < plan.stalls.size(); ++i)
        for (uint32_t k = 0; k < kBulbs; ++k)
        {
            const Stall& stall = plan.stalls[i];
            const Float2 eave = frontEave(stall.roof);
            const float x = 3.4f * ((static_cast<float>(k) + 0.5f) / kBulbs - 0.5f);
            Fixture bulb =
                makeBulb(FixtureKind::eave_bulb,
                         fromPlacement(stall.placement, {x, eave.x - 0.02f, eave.y + 0.06f}), i * kBulbs + k);
            bulb.look = i % 4 == 1 ? 1 : 0; // every fourth stall has bulbs of many colours
            if (bulb.look == 1)
                bulb.color = kPaperColors[k % kPaperCount];
            fixtures.push_back(bulb);
        }
}

void addStringBulbs(const Plan& plan, std::vector<Fixture>& fixtures)
{
    for (uint32_t i = 0; i < plan.strings.size(); ++i)
    {
        const LampString& string = plan.strings[i];
        const uint32_t count = string.to.x - string.from.x > 6 ? 10 : 6;
        for (uint32_t k = 0; k < count; ++k)
        {
            const float share =
                (static_cast<float>(k) + 0.5f) / static_cast<float>(count) + 0.2f / static_cast<float>(count);
            fixtures.push_back(makeBulb(FixtureKind::string_bulb,
                                        stringPoint(string, share) - Float3{0, 0.06f, 0}, i * 16 + k));
        }
    }
}

void addCandles(const Plan& plan, std::vector<Fixture>& fixtures)
{
    constexpr uint32_t kCandles = 7;
    for (uint32_t i = 0; i < plan.stalls.size(); ++i)
        for (uint32_t k = 0; k < kCandles; ++k)
        {
            const uint32_t id = i * kCandles + k;
            const bool shelf = k >= 5;
            const Float3 at{shelf ? -0.9f + 1.8f * static_cast<float>(k - 5)
                                  : -1.4f + 0.7f * static_cast<float>(k),
                            shelf ? 1.75f + 0.16f : kCounterTop + 0.16f,
                            shelf ? -0.8f : kCounterTo - 0.06f + 0.03f * (randomUnit(id, 1107) - 0.5f)};
            Fixture candle = makeBulb(FixtureKind::candle, fromPlacement(plan.stalls[i].placement, at), id);
            candle.color = kFlameColor;
            candle.flicker = 0.4f;
            fixtures.push_back(candle);
        }
}

/// Add bulbs on the outside of the crowns, in a spiral.
void addTreeBulbs(const Plan& plan, std::vector<Fixture>& fixtures)
{
    constexpr uint32_t kBulbs = 52;
    for (uint32_t i = 0; i < plan.trees.size(); ++i)
        for (uint32_t k = 0; k < kBulbs; ++k)
        {
            const float y = 1 - 2 * (static_cast<float>(k) + 0.5f) / kBulbs;
            const float around = std::sqrt(1 - y * y),
                        turn = 2.3999632f * static_cast<float>(k); // golden angle
            const Float3 on{around * cosine(turn), y, around * sine(turn)};
            Fixture bulb = makeBulb(FixtureKind::tree_bulb,
                                    fromPlacement(plan.trees[i], kCrownMiddle + kCrownHalf * on * 1.03f),
                                    i * kBulbs + k);
            bulb.color = i % 3 == 0 ? Float3{0.55f, 0.72f, 1.0f} : kBulbColor;
            bulb.look = i % 3 == 0 ? 2 : 0;
            fixtures.push_back(bulb);
        }
}

void addFacadeBulbs(const Plan& plan, std::vector<Fixture>& fixtures)
{
    constexpr uint32_t kBulbs = 9;
    for (uint32_t i = 0; i < plan.houses.size(); ++i)
        for (uint32_t k = 0; k < 2 * kBulbs; ++k)
        {
            const float x = kHouseHalfWidth * (2 * (static_cast<float>(k % kBulbs) + 0.5f) / kBulbs - 1);
            const Float3 at =
                k < kBulbs ? Float3{x, kHouseLedge - 0.16f, 0.18f} : Float3{x, kHouseEaves - 0.2f, 0.24f};
            fixtures.push_back(
                makeBulb(FixtureKind::facade_bulb, fromPlacement(plan.houses[i], at), i * 2 * kBulbs + k));
        }
}

/// Add candles in glasses along the main street, before the stalls.
void addGroundCandles(std::vector<Fixture>& fixtures)
{
    constexpr uint32_t kAlong = 76;
    for (uint32_t i = 0; i < 2 * kAlong; ++i)
    {
        const float side = i % 2 == 0 ? -1.0f : 1.0f;
        const Float2 at{side * (3.05f + 0.1f * randomUnit(i, 1108)),
                        33 - 66 * (static_cast<float>(i / 2) + 0.5f) / kAlong};
        Fixture candle = makeBulb(FixtureKind::ground_candle, {at.x, groundHeight(at) + 0.15f, at.y}, i);
        candle.color = kFlameColor;
        candle.flicker = 0.35f;
        fixtures.push_back(candle);
    }
}

/// Put the fixtures of each kind into an order of which every first part is spread evenly: by the fractions
/// of multiples of the golden ratio, as H. Weyl's sequence.
void spread(std::vector<Fixture>& fixtures)
{
    const auto keyed = [](uint32_t i) { return i * 2654435769u; }; // 2^32 / golden ratio
    for (uint32_t kind = 0; kind < kFixtureKinds; ++kind)
    {
        std::vector<size_t> places;
        for (size_t i = 0; i < fixtures.size(); ++i)
            if (fixtures[i].kind == FixtureKind{kind})
                places.push_back(i);
        std::vector<std::pair<uint32_t, Fixture>> order;
        for (uint32_t i = 0; i < places.size(); ++i)
            order.emplace_back(keyed(i), fixtures[places[i]]);
        std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        for (size_t i = 0; i < places.size(); ++i)
            fixtures[places[i]] = order[i].second;
    }
}

} // namespace

std::vector<Sign> placeSigns(const Plan& plan)
{
    std::vector<Sign> signs;
    for (uint32_t i = 3; i < plan.stalls.size(); i += 6)
    {
        const Stall& stall = plan.stalls[i];
        Placement placement = stall.placement;
        placement.translation =
            fromPlacement(stall.placement, {0, stall.roof == Roof::awning ? 2.72f : 2.78f, 1.30f});
        signs.push_back({placement, (i / 6 * 5 + 3) % kPaperCount});
    }
    for (uint32_t i = 0; i < plan.houses.size(); i += 4)
    {
        Placement placement = plan.houses[i];
        placement.translation = fromPlacement(plan.houses[i], {1.1f, 3.98f, 0.2f});
        signs.push_back({placement, (i / 4 * 2 + 4) % kPaperCount});
    }
    return signs;
}

std::vector<Fixture> placeFixtures(const Plan& plan)
{
    std::vector<Fixture> fixtures;
    addStallLamps(plan, fixtures);
    addLanterns(plan, fixtures);
    addLampPosts(plan, fixtures);
    addAccents(plan, fixtures);
    addSignLights(plan, fixtures);
    addEaveBulbs(plan, fixtures);
    addStringBulbs(plan, fixtures);
    addCandles(plan, fixtures);
    addTreeBulbs(plan, fixtures);
    addFacadeBulbs(plan, fixtures);
    addGroundCandles(fixtures);
    spread(fixtures);
    return fixtures;
}

} // namespace hearth::samples::market

// Tests which lights have shadow maps, from frame to frame, against a slow ranking, and which rows they have.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/frame/shadow_lights.h"

#include "tests/runtime/frame/shadow_cases.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <optional>
#include <set>

namespace hearth::test
{

namespace
{

using namespace shared;

/// Lights with the luminances of their intensities without flicker.
struct Lights
{
    std::vector<Light> lights;
    std::vector<float> luminances;
};

void setRandomLight(Lights& scene, uint32_t slot, std::mt19937& random, float extent)
{
    Light& light = scene.lights[slot];
    const uint32_t kind = random() % 100;
    light.type = kind < 1 ? kLightDirectional : kind < 40 ? kLightSpot : kLightPoint;
    light.position = {between(random, -extent, extent), between(random, 0, 6),
                      between(random, -extent, extent)};
    light.range = random() % 50 == 0 ? 0 : between(random, 0.5f, 8);
    scene.luminances[slot] = random() % 5 == 0 ? 0 : between(random, 0.1f, 30);
}

Lights makeRandomLights(uint32_t count, std::mt19937& random, float extent)
{
    Lights scene{std::vector<Light>(count), std::vector<float>(count)};
    for (uint32_t slot = 0; slot < count; ++slot)
        setRandomLight(scene, slot, random, extent);
    return scene;
}

uint32_t rowsOnce(uint32_t type)
{
    return type == kLightPoint ? 6 : 1;
}

/// Luminance times solid angle, in doubles.
double weigh(const Light& light, float luminance, Float3 eye)
{
    if (light.type == kLightDirectional)
        return HUGE_VAL;
    const Double3 offset = widen(light.position) - widen(eye);
    const double distance = length(offset);
    const double range = double{light.range};
    const double share = range <= 0 || distance <= range
                             ? 1
                             : 0.5 * (1 - std::sqrt(distance * distance - range * range) / distance);
    return double{luminance} * 4 * std::numbers::pi * share;
}

/// The rule as a person would carry it out: the best light that is left comes next.
class SlowRanking
{
public:
    std::vector<uint32_t> choose(const Lights& scene, Float3 eye, uint32_t maps, uint32_t maps_of_a_sun)
    {
        std::vector<bool> is_left(scene.lights.size());
        for (size_t slot = 0; slot < is_left.size(); ++slot)
            is_left[slot] = scene.luminances[slot] > 0;
        std::vector<uint32_t> chosen;
        uint32_t rows = 64;
        while (std::find(is_left.begin(), is_left.end(), true) != is_left.end())
        {
            std::optional<uint32_t> best;
            for (uint32_t slot = 0; slot < is_left.size(); ++slot)
                if (is_left[slot] && (!best || beats(scene, slot, *best, eye)))
                    best = slot;
            is_left[*best] = false;
            const uint32_t type = scene.lights[*best].type;
            const uint32_t needed =
                type == kLightDirectional ? std::min(maps_of_a_sun, std::max(maps, 1u)) : rowsOnce(type);
            if (rowsOnce(type) > rows || needed > maps)
                continue;
            rows -= rowsOnce(type);
            maps -= needed;
            chosen.push_back(*best);
        }
        types_.clear();
        for (const uint32_t slot : chosen)
            types_[slot] = scene.lights[slot].type;
        return chosen;
    }

private:
    bool holds(const Lights& scene, uint32_t slot) const
    {
        const auto found = types_.find(slot);
        return found != types_.end() && found->second == scene.lights[slot].type;
    }
    bool beats(const Lights& scene, uint32_t a, uint32_t b, Float3 eye) const
    {
        const auto now = [&](uint32_t slot)
        { return weigh(scene.lights[slot], scene.luminances[slot], eye) * (holds(scene, slot) ? 1.25 : 1); };
        if (now(a) != now(b))
            return now(a) > now(b);
        return holds(scene, a) && !holds(scene, b); // slots come in rising order
    }

    std::map<uint32_t, uint32_t> types_; ///< of the lights chosen last
};

std::vector<uint32_t> getSlots(const ShadowLights& chosen)
{
    std::vector<uint32_t> slots;
    for (const ShadowLights::Holder& holder : chosen.holders())
        slots.push_back(holder.slot);
    return slots;
}

void expectOwnRows(const ShadowLights& chosen)
{
    std::set<uint32_t> rows;
    for (const ShadowLights::Holder& holder : chosen.holders())
        for (uint32_t i = 0; i < rowsOnce(holder.type); ++i)
        {
            ASSERT_LT(holder.row + i, 64u);
            ASSERT_TRUE(rows.insert(holder.row + i).second) << "row " << holder.row + i << " has two lights";
        }
}

/// Expect that a light that is still on has lost its maps to a light of more than 1.25 times its weight.
void expectBeaten(const Lights& scene, std::span<const uint32_t> before, std::span<const uint32_t> now,
                  Float3 eye)
{
    const auto has = [](std::span<const uint32_t> slots, uint32_t slot)
    { return std::find(slots.begin(), slots.end(), slot) != slots.end(); };
    double best_new = 0;
    for (const uint32_t slot : now)
        if (!has(before, slot))
            best_new = std::max(best_new, weigh(scene.lights[slot], scene.luminances[slot], eye));
    for (const uint32_t slot : before)
        if (!has(now, slot) && scene.luminances[slot] > 0)
            ASSERT_GT(best_new, 1.2499 * weigh(scene.lights[slot], scene.luminances[slot], eye));
}

} // namespace

TEST(ShadowLights, areThoseOfASlowRankingWhileLightsComeGoMoveAndChangeTheirType)
{
    std::mt19937 random(11);
    for (const uint32_t maps : {64u, 23u, 5u, 0u})
    {
        Lights scene = makeRandomLights(120, random, 20);
        ShadowLights chosen(1024);
        SlowRanking slow;
        Float3 eye{};
        for (int frame = 0; frame < 150; ++frame)
        {
            eye = eye + randomUnit(random) * between(random, 0, 2);
            for (uint32_t i = random() % 8; i > 0; --i)
                setRandomLight(scene, random() % 120, random, 20);
            chosen.choose(scene.lights, scene.luminances, eye, {.maps = maps, .maps_of_a_sun = 4});
            ASSERT_EQ(getSlots(chosen), slow.choose(scene, eye, maps, 4)) << frame;
            ASSERT_NO_FATAL_FAILURE(expectOwnRows(chosen));
        }
    }
}

TEST(ShadowLights, tellWhoseRowsChange)
{
    std::mt19937 random(12);
    Lights scene = makeRandomLights(60, random, 10);
    std::vector<uint32_t> rows(60, kNoShadow);
    ShadowLights chosen(1024);
    uint32_t stays = 0, moves = 0;
    for (int frame = 0; frame < 300; ++frame)
    {
        for (uint32_t i = random() % 8; i > 0; --i)
            setRandomLight(scene, random() % 60, random, 10);
        const std::vector<uint32_t> before = rows;
        chosen.choose(scene.lights, scene.luminances, {}, {.maps = 64, .maps_of_a_sun = 2});
        for (const ShadowRowChange& change : chosen.changes())
        {
            ASSERT_NE(rows[change.slot], change.row) << "no change";
            rows[change.slot] = change.row;
        }
        std::vector<uint32_t> expected(60, kNoShadow);
        for (const ShadowLights::Holder& holder : chosen.holders())
            expected[holder.slot] = holder.row;
        ASSERT_EQ(rows, expected);
        for (uint32_t slot = 0; slot < 60; ++slot)
            if (before[slot] != kNoShadow && rows[slot] != kNoShadow)
                ++(rows[slot] == before[slot] ? stays : moves);
    }
    EXPECT_GT(stays, 20 * moves) << moves << " rows moved";
}

/// A walk among the lights of a market, with a stop every tenth frame.
TEST(ShadowLights, keepTheirMapsUntilTheyAreBeaten)
{
    std::mt19937 random(13);
    const Lights scene = makeRandomLights(1024, random, 40);
    ShadowLights chosen(1024);
    std::vector<uint32_t> before;
    uint32_t changes = 0;
    for (int frame = 0; frame < 200; ++frame)
    {
        const float along = static_cast<float>(frame / 10 * 10) * 0.3f;
        const Float3 eye{along - 30, 1.7f, 0.4f * along - 10};
        chosen.choose(scene.lights, scene.luminances, eye, {.maps = 64, .maps_of_a_sun = 4});
        const std::vector<uint32_t> now = getSlots(chosen);
        ASSERT_NO_FATAL_FAILURE(expectBeaten(scene, before, now, eye)) << "frame " << frame;
        if (frame % 10 != 0)
            ASSERT_TRUE(chosen.changes().empty()) << "the eye rests in frame " << frame;
        changes += static_cast<uint32_t>(chosen.changes().size());
        before = now;
    }
    EXPECT_GT(changes, 50u);
}

TEST(ShadowLights, haveMapsWhateverTheHistoryWhereAllHavePlace)
{
    std::mt19937 random(14);
    Lights scene = makeRandomLights(9, random, 10);
    ShadowLights chosen(1024);
    for (int frame = 0; frame < 200; ++frame)
    {
        setRandomLight(scene, random() % 9, random, 10);
        chosen.choose(scene.lights, scene.luminances, {between(random, -20, 20), 1, 0},
                      {.maps = 64, .maps_of_a_sun = 4});
        std::vector<uint32_t> slots = getSlots(chosen);
        std::sort(slots.begin(), slots.end());
        std::vector<uint32_t> on;
        for (uint32_t slot = 0; slot < 9; ++slot)
            if (scene.luminances[slot] > 0)
                on.push_back(slot);
        ASSERT_EQ(slots, on);
        EXPECT_EQ(chosen.droppedMaps(), 0u);
    }
}

TEST(ShadowLights, ofEqualWeightAreThoseOfLowSlotsAndStay)
{
    Lights scene{std::vector<Light>(30), std::vector<float>(30, 1)};
    for (Light& light : scene.lights)
        light.type = kLightPoint;
    ShadowLights chosen(1024);
    const auto choose = [&]
    {
        chosen.choose(scene.lights, scene.luminances, {}, {.maps = 64, .maps_of_a_sun = 4});
        return getSlots(chosen);
    };
    EXPECT_EQ(choose(), (std::vector<uint32_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9})) << "sixty rows of 64";
    EXPECT_EQ(chosen.droppedMaps(), 0u) << "more maps would need more rows";
    scene.luminances[29] = 1.24f;
    EXPECT_EQ(choose().back(), 9u) << "not beaten by 1.25";
    scene.luminances[29] = 1.26f;
    EXPECT_EQ(choose().front(), 29u);
    EXPECT_EQ(getSlots(chosen).back(), 8u) << "the last of equal weight has lost";
    scene.luminances[29] = 1;
    EXPECT_EQ(choose().back(), 29u) << "it stays among its equals";
}

TEST(ShadowLights, countTheMapsThatTheyLack)
{
    Lights scene{std::vector<Light>(30), std::vector<float>(30, 1)};
    for (Light& light : scene.lights)
        light.type = kLightPoint;
    scene.lights[7].type = kLightDirectional;
    ShadowLights chosen(1024);
    chosen.choose(scene.lights, scene.luminances, {}, {.maps = 16, .maps_of_a_sun = 4});
    EXPECT_EQ(getSlots(chosen), (std::vector<uint32_t>{7, 0, 1}));
    EXPECT_EQ(chosen.lightsOn(), 30u);
    EXPECT_EQ(chosen.droppedMaps(), 8u * 6) << "of the ten lamps that have rows beside a sun";
}

} // namespace hearth::test

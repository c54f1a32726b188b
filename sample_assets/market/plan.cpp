// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/market/plan.h"

#include "sample_assets/market/pieces.h"
#include "sample_assets/shapes/noise.h"
#include "sample_assets/shapes/sample_math.h"

namespace hearth::samples::market
{

namespace
{

constexpr uint32_t kStallsInRow = 14;
constexpr float kFirstStall = 31, kPitch = 4.2f, kCrossLane = 3; ///< metres along Z
constexpr float kMainPole = 3.55f, kInnerPole = 9.05f, kOuterPole = 13.65f;

/// Row of stalls along Z.
struct Row
{
    float x;
    float heading_rad;
};

constexpr float kEast = kPi / 2, kWest = -kPi / 2; ///< headings
constexpr std::array kRows{Row{-4.9f, kEast}, Row{4.9f, kWest},    Row{-7.7f, kWest},
                           Row{7.7f, kEast},  Row{-15.05f, kEast}, Row{15.05f, kWest}};

/// Return the middle of a place for a stall along Z; two lanes cross the rows.
float stallZ(uint32_t place)
{
    const uint32_t lanes = (place >= 5 ? 1u : 0u) + (place >= 10 ? 1u : 0u);
    return kFirstStall - static_cast<float>(place) * kPitch - static_cast<float>(lanes) * kCrossLane;
}

/// Return the middle between a place and the next one.
float gapZ(uint32_t place)
{
    return (stallZ(place) + stallZ(place + 1)) / 2;
}

void addStalls(Plan& plan)
{
    for (uint32_t row = 0; row < kRows.size(); ++row)
        for (uint32_t place = 0; place < kStallsInRow; ++place)
        {
            const uint32_t id = row * kStallsInRow + place;
            const auto random = [&](uint32_t which) { return randomUnit(id * 8 + which, 901); };
            const Float3 position{kRows[row].x + 0.14f * (random(0) - 0.5f), 0,
                                  stallZ(place) + 0.24f * (random(1) - 0.5f)};
            const float heading = kRows[row].heading_rad + 0.08f * (random(2) - 0.5f);
            const bool is_seen_by_thirty = place >= 1 && place <= 6;
            plan.stalls.push_back({standing(position, heading), random(3) < 0.6f ? Roof::awning : Roof::tent,
                                   (id * 5 + row) % kGoodsCount,
                                   static_cast<uint32_t>(random(4) * kClothCount), !is_seen_by_thirty});
        }
}

void addString(Plan& plan, float from_x, float to_x, float z)
{
    plan.strings.push_back({{from_x, kStringHeight, z}, {to_x, kStringHeight, z}});
    plan.poles.push_back({from_x, 0, z});
    plan.poles.push_back({to_x, 0, z});
}

void addStrings(Plan& plan)
{
    for (uint32_t place = 0; place + 1 < kStallsInRow; ++place)
    {
        const float z = gapZ(place);
        addString(plan, -kMainPole, kMainPole, z);
        if (place % 2 == 1)
            continue;
        addString(plan, -kOuterPole, -kInnerPole, z);
        addString(plan, kInnerPole, kOuterPole, z);
    }
    plan.strings[3].swings = true; // between the first stalls of the main street
}

void addTrees(Plan& plan)
{
    const auto plant = [&](float x, float z)
    {
        const auto id = static_cast<uint32_t>(plan.trees.size());
        const float scale = 0.95f + 0.3f * randomUnit(id, 911);
        plan.trees.push_back(standing({x, 0, z}, 2 * kPi * randomUnit(id, 912), scale));
    };
    for (const float x : {-6.3f, 6.3f})
        for (const uint32_t place : {4u, 9u})
            plant(x, gapZ(place));
    for (const float x : {-17.6f, 17.6f})
        for (uint32_t place = 0; place < kStallsInRow; place += 2)
            plant(x, gapZ(std::min(place, kStallsInRow - 2)));
    for (const float x : {-10.5f, -3.4f, 3.4f, 10.5f})
        plant(x, stallZ(kStallsInRow - 1) - 3.6f);
}

void addHouses(Plan& plan)
{
    constexpr float kHouseWidth = 7;
    constexpr uint32_t kAlongSide = 12, kAlongEnd = 6;
    for (uint32_t i = 0; i < kAlongSide; ++i)
    {
        const float z = (static_cast<float>(i) - 5.5f) * kHouseWidth;
        plan.houses.push_back(standing({-20.2f, 0, z}, kEast));
        plan.houses.push_back(standing({20.2f, 0, z}, kWest));
    }
    for (uint32_t i = 0; i < kAlongEnd; ++i)
    {
        const float x = (static_cast<float>(i) - 2.5f) * kHouseWidth;
        plan.houses.push_back(standing({x, 0, -38.5f}, 0));
        plan.houses.push_back(standing({x, 0, 39.5f}, kPi));
    }
}

void addLampPosts(Plan& plan)
{
    for (uint32_t place = 0; place < kStallsInRow; place += 3)
    {
        plan.lamp_posts.push_back(standing({-12.9f, 0, stallZ(place) + 2.1f}, kEast));
        plan.lamp_posts.push_back(standing({12.9f, 0, stallZ(place) + 2.1f}, kWest));
        plan.lamp_posts.push_back(standing({-19.4f, 0, stallZ(place) + 1.2f}, kEast));
        plan.lamp_posts.push_back(standing({19.4f, 0, stallZ(place) + 1.2f}, kWest));
    }
    for (const float x : {-14.0f, -7.0f, 0.0f, 7.0f, 14.0f})
        plan.lamp_posts.push_back(standing({x, 0, -37.6f}, 0));
}

} // namespace

Float2 frontEave(Roof roof)
{
    return roof == Roof::awning ? Float2{2.30f, 1.45f} : Float2{2.36f, 1.32f};
}

Float3 stringPoint(const LampString& string, float share)
{
    const float middle = 2 * share - 1;
    return lerp(string.from, string.to, share) - Float3{0, kStringSag * (1 - middle * middle), 0};
}

Plan makePlan()
{
    Plan plan;
    addStalls(plan);
    addStrings(plan);
    addTrees(plan);
    addHouses(plan);
    addLampPosts(plan);
    return plan;
}

} // namespace hearth::samples::market

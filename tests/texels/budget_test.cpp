// The budget of textures beside all possible choices.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/budget/budget.h"
#include "cook/budget/texture_budget.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace hearth::budget
{

namespace
{

double sumCost(const std::vector<BudgetOptions>& textures, const std::vector<size_t>& chosen)
{
    double cost = 0;
    for (size_t t = 0; t < textures.size(); ++t)
        cost += textures[t][chosen[t]].cost;
    return cost;
}

uint64_t sumBytes(const std::vector<BudgetOptions>& textures, const std::vector<size_t>& chosen)
{
    uint64_t bytes = 0;
    for (size_t t = 0; t < textures.size(); ++t)
        bytes += textures[t][chosen[t]].bytes;
    return bytes;
}

/// Return the least cost of all choices within the budget; infinite if there is none.
double findLeastCost(const std::vector<BudgetOptions>& textures, uint64_t budget)
{
    double least = std::numeric_limits<double>::infinity();
    std::vector<size_t> chosen(textures.size(), 0);
    while (true)
    {
        if (sumBytes(textures, chosen) <= budget)
            least = std::min(least, sumCost(textures, chosen));
        size_t t = 0;
        while (t < textures.size() && ++chosen[t] == textures[t].size())
            chosen[t++] = 0;
        if (t == textures.size())
            return least;
    }
}

/// Return the largest step between neighbours on a lower convex hull: options that no line between two
/// others, and no smaller option, is below.
double findLargestStep(const std::vector<BudgetOptions>& textures)
{
    double largest = 0;
    for (const BudgetOptions& options : textures)
    {
        std::vector<BudgetOption> hull;
        for (const BudgetOption& option : options)
        {
            const auto x = static_cast<double>(option.bytes);
            bool is_above = false;
            for (const BudgetOption& a : options)
            {
                is_above = is_above || (a.bytes <= option.bytes && a.cost < option.cost);
                for (const BudgetOption& b : options)
                    if (a.bytes < option.bytes && option.bytes < b.bytes)
                    {
                        const auto ax = static_cast<double>(a.bytes), bx = static_cast<double>(b.bytes);
                        is_above =
                            is_above || a.cost + (b.cost - a.cost) * (x - ax) / (bx - ax) < option.cost;
                    }
            }
            if (!is_above)
                hull.push_back(option);
        }
        std::ranges::sort(hull, {}, &BudgetOption::bytes);
        for (size_t i = 1; i < hull.size(); ++i)
            largest = std::max(largest, hull[i - 1].cost - hull[i].cost);
    }
    return largest;
}

std::vector<BudgetOptions> makeTextures(std::mt19937& random)
{
    std::vector<BudgetOptions> textures(2 + random() % 4);
    for (BudgetOptions& options : textures)
    {
        const auto weight = static_cast<double>(1 + random() % 8);
        for (size_t i = 0, count = 1 + random() % 5; i < count; ++i)
        {
            // errors mostly fall with bytes, as those of formats do, but not always
            const uint64_t bytes = 1 + random() % 60;
            const auto noise = static_cast<double>(random() % 9);
            const double error = random() % 16 == 0 ? 0 : 100.0 / static_cast<double>(bytes) + noise;
            options.push_back({bytes, weight * error});
        }
    }
    return textures;
}

TEST(Budget, isAtMostOneStepOffTheBestOfAllChoices)
{
    std::mt19937 random(7);
    size_t held = 0, best = 0;
    for (int trial = 0; trial < 1500; ++trial)
    {
        const std::vector<BudgetOptions> textures = makeTextures(random);
        const uint64_t budget = 1 + random() % 200;
        const BudgetShare share = shareBudget(textures, budget);
        const double least = findLeastCost(textures, budget);
        ASSERT_EQ(share.bytes, sumBytes(textures, share.chosen));
        ASSERT_EQ(share.is_held, least < std::numeric_limits<double>::infinity());
        ASSERT_EQ(share.is_held, share.bytes <= budget);
        if (!share.is_held)
            continue;
        ++held;
        const double cost = sumCost(textures, share.chosen);
        best += cost <= least * (1 + 1e-12) + 1e-12 ? 1 : 0;
        ASSERT_LE(cost, least + findLargestStep(textures) + 1e-9) << "trial " << trial;
    }
    EXPECT_GT(held, 1000u);
    EXPECT_GT(best, held / 2) << "mostly there is no better choice at all";
}

TEST(Budget, doesNotDependOnTheOrderOfOptions)
{
    std::mt19937 random(11);
    for (int trial = 0; trial < 200; ++trial)
    {
        std::vector<BudgetOptions> textures = makeTextures(random);
        const BudgetShare share = shareBudget(textures, 120);
        const double cost = sumCost(textures, share.chosen);
        for (BudgetOptions& options : textures)
            std::ranges::shuffle(options, random);
        const BudgetShare again = shareBudget(textures, 120);
        EXPECT_EQ(again.bytes, share.bytes);
        EXPECT_EQ(sumCost(textures, again.chosen), cost);
    }
}

TEST(Budget, thatNobodyCanHoldGivesTheSmallest)
{
    const std::vector<BudgetOptions> textures{{{40, 1}, {10, 9}}, {{20, 3}, {30, 1}}};
    const BudgetShare share = shareBudget(textures, 29);
    EXPECT_FALSE(share.is_held);
    EXPECT_EQ(share.bytes, 30u);
    EXPECT_EQ(share.chosen, (std::vector<size_t>{1, 0}));
    EXPECT_TRUE(shareBudget(textures, 30).is_held);
    EXPECT_EQ(shareBudget(textures, UINT64_MAX).bytes, 70u);
    EXPECT_TRUE(shareBudget({}, 0).is_held);
}

TEST(TextureBudget, countsEqualImagesOnceAndGivesThemOneFormat)
{
    const TextureFormats small{"a", {"8x8", "4x4"}, {{10, 9}, {40, 1}}};
    const TextureFormats other{"b", {"8x8", "4x4"}, {{10, 4}, {40, 1}}};
    const TextureFormats of_rule{"a", {"6x6"}, {{20, 0}}};
    const std::vector<SourceTextures> sources{{small, other}, {}, {small, of_rule}};
    const TextureShare share = shareTextures(sources, 75);
    EXPECT_EQ(share.texture_count, 3u);
    EXPECT_TRUE(share.is_held);
    EXPECT_EQ(share.bytes, 40u + 10u + 20u);
    EXPECT_EQ(share.min_bytes, 40u);
    EXPECT_EQ(share.max_bytes, 100u);
    EXPECT_EQ(listText(share), "0=4x4 1=8x8\n\n0=4x4 1=6x6\n");
    EXPECT_FALSE(shareTextures(sources, 39).is_held);
    EXPECT_EQ(shareTextures(sources, 100).bytes, 100u);
    // twice in the pack: it weighs more than one that gains as much
    const std::vector<SourceTextures> twice{
        {{"a", {"8x8", "4x4"}, {{10, 8}, {40, 1}}}, {"b", {"8x8", "4x4"}, {{10, 9}, {40, 1}}}},
        {{"a", {"8x8", "4x4"}, {{10, 8}, {40, 1}}}}};
    EXPECT_EQ(listText(shareTextures(twice, 50)), "0=4x4 1=8x8\n0=4x4\n");
}

TEST(TextureBudget, refusesEstimatesThatAreNone)
{
    for (const char* text : {"", "{", "{}", R"({"images":1})", R"({"images":[{"content":"a","formats":[]}]})",
                             R"({"images":[{"content":"a","formats":[{"format":"b","bytes":-1,"cost":1}]}]})",
                             R"({"images":[{"content":"a","formats":[{"format":"b","bytes":1}]}]})"})
        EXPECT_EQ(parseEstimates(text, "a.json").error().issue, Issue::json_syntax) << text;
    const auto read = parseEstimates(
        R"({"images":[{"content":"a","formats":[{"format":"b","bytes":1,"cost":0.5}]}]})", "a.json");
    ASSERT_TRUE(read.ok());
    EXPECT_EQ((*read)[0].names, std::vector<std::string>{"b"});
    EXPECT_EQ((*read)[0].options[0].cost, 0.5);
}

} // namespace

} // namespace hearth::budget

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/budget/budget.h"

#include "formats/base/assert.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

namespace hearth::budget
{

namespace
{

/// Return how much cost a byte saves between two options, the second of which has more bytes.
double slope(const BudgetOption& a, const BudgetOption& b)
{
    return (a.cost - b.cost) / static_cast<double>(b.bytes - a.bytes);
}

/// Return the options on the lower convex hull, by rising bytes: each costs less than the one before, and
/// each step saves less a byte.
std::vector<size_t> findHull(const BudgetOptions& options)
{
    std::vector<size_t> order(options.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::ranges::stable_sort(order, {},
                             [&](size_t i) { return std::pair(options[i].bytes, options[i].cost); });
    std::vector<size_t> hull;
    for (const size_t i : order)
    {
        if (!hull.empty() && options[i].cost >= options[hull.back()].cost)
            continue;
        while (hull.size() > 1 && slope(options[hull[hull.size() - 2]], options[hull.back()]) <=
                                      slope(options[hull.back()], options[i]))
            hull.pop_back();
        hull.push_back(i);
    }
    return hull;
}

/// Step of a texture to the next option of its hull.
struct Step
{
    size_t texture;
    size_t to; ///< index of the hull
    double slope;
};

} // namespace

BudgetShare shareBudget(std::span<const BudgetOptions> textures, uint64_t budget)
{
    BudgetShare share;
    std::vector<std::vector<size_t>> hulls;
    std::vector<Step> steps;
    for (size_t t = 0; t < textures.size(); ++t)
    {
        HEARTH_ASSERT(!textures[t].empty());
        hulls.push_back(findHull(textures[t]));
        const std::vector<size_t>& hull = hulls.back();
        share.chosen.push_back(hull.front());
        share.bytes += textures[t][hull.front()].bytes;
        for (size_t i = 1; i < hull.size(); ++i)
            steps.push_back({t, i, slope(textures[t][hull[i - 1]], textures[t][hull[i]])});
    }
    share.is_held = share.bytes <= budget;
    if (!share.is_held)
        return share;
    // slopes of one texture fall, so that its steps stay in order
    std::ranges::stable_sort(steps, std::ranges::greater{}, &Step::slope);
    std::vector<size_t> reached(textures.size(), 0);
    for (const Step& step : steps)
    {
        const BudgetOptions& options = textures[step.texture];
        const uint64_t more =
            options[hulls[step.texture][step.to]].bytes - options[share.chosen[step.texture]].bytes;
        // a step that does not fit ends those of its texture; smaller ones of others may still fit
        if (reached[step.texture] + 1 != step.to || more > budget - share.bytes)
            continue;
        reached[step.texture] = step.to;
        share.chosen[step.texture] = hulls[step.texture][step.to];
        share.bytes += more;
    }
    return share;
}

} // namespace hearth::budget

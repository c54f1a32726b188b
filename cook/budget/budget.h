// Shares a budget of bytes among textures such that their errors are least together.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hearth::budget
{

/// A format that a texture may have.
struct BudgetOption
{
    uint64_t bytes = 0;
    double cost = 0; ///< square of its error, times the weight of the texture; at least 0
};

/// Formats of a texture, in any order; at least one.
using BudgetOptions = std::vector<BudgetOption>;

struct BudgetShare
{
    std::vector<size_t> chosen{}; ///< [textures] index of the option of each
    uint64_t bytes = 0;           ///< of all chosen options
    bool is_held = true;          ///< bytes are within the budget; else each texture has its smallest option
};

/// Choose an option of each texture. Their cost together is at most one step of one texture's convex hull
/// above the least that is possible with so many bytes: steps are taken by falling cost / bytes, as long as
/// they fit (Shoham and Gersho, Efficient bit allocation for an arbitrary set of quantizers, 1988). Options
/// in another order give the same cost. Time O(n log n) of the options.
BudgetShare shareBudget(std::span<const BudgetOptions> textures, uint64_t budget);

} // namespace hearth::budget

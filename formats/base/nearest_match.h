// Finds the nearest match for a mistyped word.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace hearth
{

/// Return the smallest number of insertions, deletions, substitutions and swaps of neighbours that turn `a`
/// into `b`.
size_t editDistance(std::string_view a, std::string_view b);

/// Return the candidate nearest to `word`, if it is near enough; else an empty string. The first of equals
/// wins.
std::string nearestMatch(std::string_view word, std::span<const std::string> candidates);

} // namespace hearth

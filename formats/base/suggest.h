// The nearest match for a mistyped word.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace hearth
{

/// Fewest insertions, deletions, substitutions and swaps of neighbours that turn `a` into `b`.
size_t editDistance(std::string_view a, std::string_view b);

/// The candidate that is nearest to `word`, if it is near enough to be meant; else an empty string. The first of
/// equals wins.
std::string nearestMatch(std::string_view word, std::span<const std::string> candidates);

} // namespace hearth

// Sums of squares that the search for ETC2's base colours adds up: tables over the distance in gray.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace hearth::texels
{

/// Weights of red, green and blue in the error.
using ColorWeights = std::array<uint8_t, 3>;

inline constexpr uint8_t kMaxWeight = 8;

/// [table]: change of an error.
using TableErrors = std::array<int32_t, 8>;

/// Changes of a texel's error by the modifiers of all 8 tables.
///
/// ETC2 adds a modifier m to all three channels of a base colour b. The error of a texel p is then
///     sum w (p - b - m)^2 = sum w (p - b)^2 + W m^2 - 2 m sum w (p - b),  W = sum w:
/// its first term does not depend on the table, and its others depend on one number, the texel's distance in
/// gray, sum w (p - b). A look-up by that number gives the best modifiers of all tables at once. Clamping of
/// b + m to 0 to 255 only makes the error less.
struct SearchTables
{
    explicit SearchTables(ColorWeights weights);

    ColorWeights weights;
    int32_t weight_sum;
    /// [|distance in gray|]: the better one of the two modifiers of that sign, of ETC1's tables
    std::vector<TableErrors> halves;
    /// [|distance in gray|]: the better one of no modifier and the distance, of mode T's distances
    std::vector<TableErrors> lines;
};

} // namespace hearth::texels

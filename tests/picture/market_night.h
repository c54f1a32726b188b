// Compares the night market, drawn by its lights alone, with rays.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/picture/comparison.h"

namespace hearth::picture
{

inline constexpr std::string_view kNightScene = "night";

/// Picture by lights with shadow maps or without, beside that of rays, in which the same lights cast shadows.
struct NightComparison
{
    std::string name; ///< "lights with shadows" or "lights without shadows"
    reference::Image drawn, traced;
    Difference difference;
    size_t lights = 0, casting = 0;
};

/// Generate the market with 192 lights in a folder, cook it, and compare both pictures. errors: child_failed;
/// as for packs and devices.
Result<std::vector<NightComparison>> compareMarketNight(const std::string& work);

/// Return a line for each.
std::string describe(const std::vector<NightComparison>& nights);

} // namespace hearth::picture

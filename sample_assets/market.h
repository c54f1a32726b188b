// Generates a market at night, lit by any number of lamps: the sample of many lights.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/shapes/document.h"

namespace hearth::samples
{

inline constexpr uint32_t kMaxMarketLights = 4096;

/// Make the market: 84 stalls along three lanes of 65 m, the main one along Z, cameras "street", "above",
/// "thirty" and "stall", clip "evening".
/// light_count  1 to kMaxMarketLights (asserted): up to three directional lights, then points and spots
Document makeMarket(uint32_t light_count);

} // namespace hearth::samples

// Generates what is sold at the market: fruit, jars, cloth, pots, bread and toys on the counters, and the
// crates, barrels and sacks around the stalls.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/market/plan.h"

namespace hearth::samples::market
{

/// Add goods on the counters and shelves of all stalls, and beside the stalls.
void addGoods(Document& document, const Plan& plan);

} // namespace hearth::samples::market

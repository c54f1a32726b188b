// Generates the stalls of the market: frames of wood with a counter and shelves, and roofs of striped cloth.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/market/plan.h"

namespace hearth::samples::market
{

/// Add the frames and roofs of all stalls.
void addStalls(Document& document, const Plan& plan);

} // namespace hearth::samples::market

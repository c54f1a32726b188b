// Generates the people of the market: sellers and guests that stand, and two skinned characters.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/market/plan.h"

namespace hearth::samples
{

/// Add the people. One character pushes the cart, the other looks around; their tracks go into `evening`.
void addMarketPeople(Document& document, const market::Plan& plan, Animation& evening);

} // namespace hearth::samples

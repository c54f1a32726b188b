// Generates the paved ground of the market: worn stones, wet in places, and puddles in its hollows.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/shapes/document.h"

namespace hearth::samples::market
{

/// Return the height of the ground, metres: within 5 cm of 0.
float groundHeight(Float2 xz);

/// Add the ground and the puddles.
void addStreet(Document& document);

} // namespace hearth::samples::market

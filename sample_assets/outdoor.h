// Generates a yard under the sky and the default sun: corners, an overhang, gaps and cards of grass on real
// ground.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/shapes/document.h"

namespace hearth::samples
{

/// Make the scene; its camera is called `outdoor`.
Document makeOutdoor();

} // namespace hearth::samples

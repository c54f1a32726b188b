// Tells assets that share a world from assets that were never placed, so that each stands in all others.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

#include <span>

namespace hearth::formats
{

/// True if the assets were never placed: three quarters of them, and at least two, have boxes around the
/// world's origin that overlap heavily with half of the others there. False for props side by side, props in
/// a house, and tiles that meet. Such assets neither hide each other nor light each other.
/// boxes  of the assets that draw something, world space
bool areUnplaced(std::span<const Box3> boxes);

} // namespace hearth::formats

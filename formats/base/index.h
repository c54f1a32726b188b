// The value that no index has.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>

namespace hearth
{

/// Stands for "none" wherever a 32-bit index stands, in memory and in files.
inline constexpr uint32_t kInvalidIndex = 0xFFFFFFFFu;

} // namespace hearth

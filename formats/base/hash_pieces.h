// The hash of bytes that are not in memory at once.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

namespace hearth
{

/// XXH3-64, as hashBytes(), of bytes that come one piece after the other; an empty one ends them.
uint64_t hashPieces(const std::function<std::span<const std::byte>()>& next);

} // namespace hearth

// Hashes bytes that are not in memory at once.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

namespace hearth
{

/// Return XXH3-64, as hashBytes(), of bytes that `next` returns piece by piece; an empty piece ends them.
uint64_t hashStream(const std::function<std::span<const std::byte>()>& next);

} // namespace hearth

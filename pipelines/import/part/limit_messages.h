// Words the limits that refuse a source: each message has the number in the file and the limit.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace hearth::import
{

/// Return "300 vertices, at most 200 are read".
std::string describeExcess(uint64_t count, std::string_view things, uint64_t limit);

/// Return the first position that is not finite or has a coordinate beyond kMaxCoordinate.
std::optional<size_t> findBadPosition(std::span<const Float3> positions);

/// Return "(2e+09, 0, 0), coordinates go up to 1e+09", of a position that findBadPosition found.
std::string describeBadPosition(Float3 position);

} // namespace hearth::import

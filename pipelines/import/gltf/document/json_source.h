// Cuts values out of a JSON text as they are written, so that no number or name changes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hearth::import
{

/// Return the texts of values without the white space between their tokens. All else is as in the source:
/// digits of numbers, escapes of strings, the order of members.
/// text       valid JSON
/// positions  of the values, as Json::position(), ascending; none lies inside another
std::vector<std::string> cutValues(std::string_view text, std::span<const uint32_t> positions);

} // namespace hearth::import

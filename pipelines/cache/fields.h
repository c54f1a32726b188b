// Lists of named fields as text, the format of cache entries, records and journals: parses in a microsecond.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hearth::cache
{

/// Name of the fields of an entry that hold the SHA-256 of a content of the result.
inline constexpr std::string_view kContentField = "content";

/// List of names and values, both any bytes. Names may repeat, and the order counts.
using Fields = std::vector<std::pair<std::string, std::string>>;

/// Serialize fields, one a line: name, a tab, value. Backslash, tab and line break are written as \\ \t \n.
/// Different fields give different texts.
std::string formatFields(const Fields& fields);

/// Parse a text that formatFields wrote; nullopt where it is malformed.
std::optional<Fields> parseFields(std::string_view text);

/// Return the value of the first field of that name; empty where there is none.
std::string_view fieldValue(const Fields& fields, std::string_view name);

} // namespace hearth::cache

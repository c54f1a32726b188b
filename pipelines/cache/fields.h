// Text of named fields, in which the cache and the cook keep what they know: simple enough to be read in a microsecond.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hearth::cache
{

/// In an entry: SHA-256 of a content that belongs to it.
inline constexpr std::string_view kContentField = "content";

/// Name and value, both any bytes; names may repeat, the order counts.
using Fields = std::vector<std::pair<std::string, std::string>>;

/// A line a field: name, a tab, value; backslash, tab and line break are written as \\ \t \n.
/// Different fields give different texts.
std::string textOf(const Fields& fields);

/// nullopt where the text is not one that textOf makes
std::optional<Fields> fieldsOf(std::string_view text);

/// The value of the first field of that name; empty where there is none.
std::string_view valueOf(const Fields& fields, std::string_view name);

} // namespace hearth::cache

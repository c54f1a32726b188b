// The tables of FORMAT.md, made from the structs and lists themselves.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hearth::formats
{

/// The Markdown table of a block: a record's name ("NodeRecord"), an enum's ("LightType"), "chunks", "issues" or
/// "limits"; nullopt where there is none of that name.
std::optional<std::string> formatTable(std::string_view name);

/// Names of all blocks; each has its place in FORMAT.md.
std::vector<std::string_view> formatTableNames();

/// `document` with the text between each `<!-- table NAME -->` and the next `<!-- end -->` made again. A block of a name
/// that does not exist is left empty.
std::string withFreshTables(std::string_view document);

} // namespace hearth::formats

// Generates the tables of FORMAT.md from the structs and lists themselves.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hearth::formats
{

/// Return the Markdown table of a block: a record's name ("NodeRecord"), an enum's ("LightType"), "chunks",
/// "issues" or "limits"; nullopt for an unknown name.
std::optional<std::string> formatTable(std::string_view name);

/// Return the names of all blocks; each has its place in FORMAT.md.
std::vector<std::string_view> formatTableNames();

/// Return `document` with the text between each `<!-- table NAME -->` and the next `<!-- end -->`
/// regenerated. A block with an unknown name is left empty.
std::string regenerateTables(std::string_view document);

} // namespace hearth::formats

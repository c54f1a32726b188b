// DESIGN's arrows as data: which folder may include and link which, and where each library may be seen.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hearth::test
{

/// Paths are relative to the root of the repository, with '/' between folders.
/// nullopt where `file` may include `header` (of the repository); else the rule that it breaks.
std::optional<std::string> wrongArrow(std::string_view file, std::string_view header);

/// The same for a library's header, a name in angle brackets.
std::optional<std::string> wrongLibrary(std::string_view file, std::string_view header);

/// The headers that a source text includes: "quoted" and <angled>, each with its line.
struct Include
{
    size_t line = 0;
    bool angled = false;
    std::string header;
};
std::vector<Include> includesOf(std::string_view text);

} // namespace hearth::test

// The architecture as data: which folder may include and link which, and where each library may be seen.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hearth::test
{

/// Paths are relative to the root of the repository, with '/' between folders, without one at the end.

struct Arrow
{
    std::string_view from;
    std::string_view to; ///< this folder and all below it

    bool operator==(const Arrow&) const = default;
};

/// The table of arrows between folders. Tests may include everything and are not in it.
std::vector<Arrow> allArrows();

/// The arrow of the table that lets files of a folder include files of another; nullopt where there is none.
std::optional<Arrow> arrowOf(std::string_view from, std::string_view to);

/// The folder of a file.
std::string_view folderOf(std::string_view path);

/// nullopt where `file` may include `header` (of the repository); else the rule that it breaks.
std::optional<std::string> wrongArrow(std::string_view file, std::string_view header);

/// nullopt where the libraries of a folder may link those of another; else the rule that it breaks.
std::optional<std::string> wrongLink(std::string_view from, std::string_view to);

/// Start of an include in angle brackets that the table of libraries knows: a header, or a folder with '/' at its end.
std::vector<std::string_view> allLibraries();

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

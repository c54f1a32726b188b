// Defines the architecture as data: allowed includes and links between folders, and the folders that may use
// each library.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hearth::test
{

/// Paths are relative to the root of the repository, with '/' between folders and none at the end.

struct Arrow
{
    std::string_view from;
    std::string_view to; ///< this folder and all folders below it

    bool operator==(const Arrow&) const = default;
};

/// Table of arrows between folders. Tests may include everything and are not in it, and neither are cookers
/// without a row of their own: each of these may include all that cookers share.
std::vector<Arrow> allArrows();

/// Arrow of the table that lets files of a folder include files of another; nullopt if there is none.
std::optional<Arrow> findArrow(std::string_view from, std::string_view to);

/// The folder of a file.
std::string_view getFolder(std::string_view path);

/// Rule that is broken if `file` includes `header` (of the repository); nullopt if the include is allowed.
std::optional<std::string> wrongArrow(std::string_view file, std::string_view header);

/// Rule that is broken if the libraries of a folder link libraries of another; nullopt if the link is
/// allowed.
std::optional<std::string> wrongLink(std::string_view from, std::string_view to);

/// Libraries of the table, as prefixes of includes in angle brackets: a header, or a folder with '/' at its
/// end.
std::vector<std::string_view> allLibraries();

/// Rule that is broken if `file` includes a library's header (a name in angle brackets); nullopt if it is
/// allowed.
std::optional<std::string> wrongLibrary(std::string_view file, std::string_view header);

/// A header that a source text includes, "quoted" or <angled>, with its line.
struct Include
{
    size_t line = 0;
    bool angled = false;
    std::string header;
};
std::vector<Include> findIncludes(std::string_view text);

} // namespace hearth::test

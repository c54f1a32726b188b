// Glob patterns for paths.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <string>
#include <string_view>

namespace hearth::profiles
{

/// True if the pattern matches all of `path`, folder by folder: * matches any characters of one name, ?
/// matches one, a folder ** matches any number of folders, including none; other characters match themselves.
/// "props/**/*.glb" matches "props/a.glb" and "props/x/y/a.glb". Time is at most proportional to the product
/// of both lengths.
bool matchesPath(std::string_view pattern, std::string_view path);

/// True if a text has * or ?.
bool isPattern(std::string_view text);

} // namespace hearth::profiles

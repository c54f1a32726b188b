// Patterns for paths.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <string>
#include <string_view>

namespace hearth::profiles
{

/// Whether all of `path` matches, folder by folder: * stands for any characters of one name, ? for one, a folder ** for any
/// number of folders, none included; everything else for itself. "props/**/*.glb" matches "props/a.glb" and "props/x/y/a.glb".
/// Time is at most the product of both lengths.
bool matchesPath(std::string_view pattern, std::string_view path);

/// Whether a text has * or ?.
bool isPattern(std::string_view text);

} // namespace hearth::profiles

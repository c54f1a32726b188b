// Lists the files of a cooked folder that no cooker has read.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <string>
#include <vector>

namespace hearth::command
{

/// Return a line on the files that no cooker has read: textures that no source uses, other files of assets,
/// and files of types that are not supported. It names the first few of each. Packs and configuration files
/// do not count.
/// files    files of the folders
/// known    paths that were read or written, in any spelling
/// returns  empty if nothing is left out
std::string unusedFilesText(const std::vector<std::string>& files, const std::vector<std::string>& known);

} // namespace hearth::command

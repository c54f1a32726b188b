// Names the files of a cooked folder that are in no pack.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <string>
#include <vector>

namespace hearth::command
{

/// A line on the files that nobody has read: textures that no source uses, other files of assets, and files
/// of kinds that are not read. It names the first few of each. Packs and files of settings are not meant.
/// files    of the folders
/// known    paths of what was read or written, however they are typed
/// returns  empty where nothing is left out
std::string leftOutText(const std::vector<std::string>& files, const std::vector<std::string>& known);

} // namespace hearth::command

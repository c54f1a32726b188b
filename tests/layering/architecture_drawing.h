// Draws which folders include which, for docs/ARCHITECTURE.md.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <map>
#include <set>
#include <string>

namespace hearth::test
{

/// Arrows between folders: from a folder to those that its files include.
using FolderGraph = std::map<std::string, std::set<std::string>>;

/// Return the graph of folders two levels deep ("cook/clusters"), from the includes of all sources but tests.
///
/// root  of the repository
FolderGraph readFolderGraph(const std::string& root);

/// Return an SVG. Each folder stands one floor above the highest of those that it includes. Arrows that
/// follow from others are left out.
///
/// graph  without cycles (asserted)
std::string drawFolderGraph(const FolderGraph& graph);

} // namespace hearth::test

// hearth inspect --topology: faults of a source's meshes, as an artist can mend them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <string>

namespace hearth::command
{

struct TopologyOptions
{
    std::string source; ///< source file, which is imported, or an import part
    bool is_json = false;
    std::string ply; ///< file for findings as geometry, or folder of a file for each kind; empty: none
};

/// Print the report.
/// returns  the exit code. Findings are no errors; those of the importer stay as they are
int inspectTopology(const TopologyOptions& options);

} // namespace hearth::command

// Limits on running cookers, and the verbosity of their verbs: options that do not change the output.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/command/shell/terminal.h"

#include <cstdint>
#include <string>

namespace hearth::command
{

/// Limits on running cookers, and the verbosity of their verb.
struct RunLimits
{
    /// Number of cookers at once; 0: two, and of small sources as many as there are cores. Cookers of large
    /// sources are parallel themselves: two are enough to hide their serial parts, and each more costs the
    /// memory of another mesh.
    unsigned jobs = 0;
    /// Memory of all cookers together, by their estimates; 0: three quarters of the machine's memory.
    uint64_t memory_bytes = 0;
    Verbosity verbosity = Verbosity::normal;
    std::string progress = "auto"; ///< see progressStyle
};

} // namespace hearth::command

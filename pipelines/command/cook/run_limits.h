// How verbs that run cookers go about it: options that change no byte of what they make.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/command/shell/terminal.h"

#include <cstdint>
#include <string>

namespace hearth::command
{

struct Effort
{
    /// Cookers at once; 0: two, and of small sources as many as there are cores. With large ones they are parallel
    /// themselves: two are enough to hide their serial parts, and each more costs the memory of another mesh.
    unsigned jobs = 0;
    /// What the cookers may take together, by their estimates; 0: three quarters of the machine's memory.
    uint64_t memory_bytes = 0;
    Verbosity verbosity = Verbosity::normal;
    std::string progress = "auto"; ///< see progressStyle
};

} // namespace hearth::command

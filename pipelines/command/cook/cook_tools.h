// Helpers of the verbs that run cookers: messages about stages, and limits on processes and memory.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/command/shell/messages.h"
#include "pipelines/command/shell/run_programs.h"
#include "pipelines/command/shell/terminal.h"
#include "pipelines/graph/executor.h"

#include <cstdint>
#include <string>
#include <vector>

namespace hearth::command
{

/// Print a child's messages: errors always, warnings unless quiet, all others only with Verbosity::all.
void printMessages(const std::vector<std::string>& lines, Verbosity verbosity);

/// Print a line on stderr, in grey if stderr shows colours.
void printFaint(const std::string& line);

/// Print a line about a cooker that has run.
void printStage(const graph::Action& action, const graph::ActionOutcome& outcome);

/// Return the limits of all cookers together. jobs 0: two at once, of small sources one per core;
/// memory_bytes 0: three quarters of the machine's memory.
graph::PoolLimits makePoolLimits(unsigned jobs, uint64_t memory_bytes);

} // namespace hearth::command

// What the verbs that run cookers share: how they tell of stages, and how much memory they take.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/command/shell/terminal.h"
#include "pipelines/graph/executor.h"

#include <cstdint>
#include <string>
#include <vector>

namespace hearth::command
{

inline constexpr int kInterrupted = 130;

/// A line on stderr.
void print(const std::string& line);

/// An error or a warning on stderr. returns  its exit code
int tell(const Error& error);

/// Pass on a child's messages: errors always, the noise of libraries only when everything is asked for.
void passOn(const std::vector<std::string>& lines, Verbosity verbosity);

/// As print(), in grey where stderr shows colours.
void printFaint(const std::string& line);

/// A line of a cooker that has run.
void printStage(const graph::Action& action, const graph::ActionOutcome& outcome);

/// What cookers may take together; 0: two at once, of small sources one a core, and three quarters of the machine's memory.
graph::CrewLimits limitsOf(unsigned jobs, uint64_t memory_bytes);

} // namespace hearth::command

// Verbs (subcommands) of hearth. Each adds itself to the command line, and sets the work that is done if it
// is chosen.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/command_line/command_line.h"

#include <functional>

namespace hearth::command
{

/// Action of the chosen verb, with its parsed options; returns the exit code.
using Work = std::function<int()>;

void addCook(cli::CommandLine& app, Work& run);
void addInspect(cli::CommandLine& app, Work& run);
void addDiff(cli::CommandLine& app, Work& run);
void addVerify(cli::CommandLine& app, Work& run);
void addExtract(cli::CommandLine& app, Work& run);
void addWhy(cli::CommandLine& app, Work& run);
void addCache(cli::CommandLine& app, Work& run);
void addPlan(cli::CommandLine& app, Work& run);
void addRun(cli::CommandLine& app, Work& run);
void addMerge(cli::CommandLine& app, Work& run);
void addFarm(cli::CommandLine& app, Work& run);
void addConfig(cli::CommandLine& app, Work& run);
void addCompletion(cli::CommandLine& app, Work& run);
void addDoctor(cli::CommandLine& app, Work& run);
void addReport(cli::CommandLine& app, Work& run);
void addExplain(cli::CommandLine& app, Work& run);
void addMan(cli::CommandLine& app, Work& run);
void addSchema(cli::CommandLine& app, Work& run);
void addVersion(cli::CommandLine& app, Work& run);

} // namespace hearth::command

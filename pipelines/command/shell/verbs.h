// Verbs (subcommands) of hearth. Each adds itself to the command line, and sets the work that is done if it
// is chosen.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/command_line/command_line.h"

#include <functional>

namespace hearth::command
{

/// Action of the chosen verb, with its parsed options; returns the exit code.
using VerbAction = std::function<int()>;

void addCook(cli::CommandLine& app, VerbAction& run);
void addInspect(cli::CommandLine& app, VerbAction& run);
void addDiff(cli::CommandLine& app, VerbAction& run);
void addVerify(cli::CommandLine& app, VerbAction& run);
void addExtract(cli::CommandLine& app, VerbAction& run);
void addWhy(cli::CommandLine& app, VerbAction& run);
void addCache(cli::CommandLine& app, VerbAction& run);
void addPlan(cli::CommandLine& app, VerbAction& run);
void addRun(cli::CommandLine& app, VerbAction& run);
void addMerge(cli::CommandLine& app, VerbAction& run);
void addFarm(cli::CommandLine& app, VerbAction& run);
void addConfig(cli::CommandLine& app, VerbAction& run);
void addCompletion(cli::CommandLine& app, VerbAction& run);
void addDoctor(cli::CommandLine& app, VerbAction& run);
void addReport(cli::CommandLine& app, VerbAction& run);
void addExplain(cli::CommandLine& app, VerbAction& run);
void addMan(cli::CommandLine& app, VerbAction& run);
void addSchema(cli::CommandLine& app, VerbAction& run);
void addVersion(cli::CommandLine& app, VerbAction& run);

} // namespace hearth::command

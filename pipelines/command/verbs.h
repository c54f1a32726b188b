// The verbs of hearth: each adds itself to the command line, and hands over its work when it is chosen.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <functional>

namespace CLI
{
class App;
} // namespace CLI

namespace hearth::command
{

/// What the chosen verb does, with the options that the command line has given it; returns the exit code.
using Work = std::function<int()>;

void addCook(CLI::App& app, Work& run);
void addInspect(CLI::App& app, Work& run);
void addDiff(CLI::App& app, Work& run);
void addVerify(CLI::App& app, Work& run);
void addExtract(CLI::App& app, Work& run);
void addWhy(CLI::App& app, Work& run);
void addCache(CLI::App& app, Work& run);
void addPlan(CLI::App& app, Work& run);
void addRun(CLI::App& app, Work& run);
void addMerge(CLI::App& app, Work& run);
void addFarm(CLI::App& app, Work& run);
void addConfig(CLI::App& app, Work& run);
void addCompletion(CLI::App& app, Work& run);
void addDoctor(CLI::App& app, Work& run);
void addReport(CLI::App& app, Work& run);
void addExplain(CLI::App& app, Work& run);
void addMan(CLI::App& app, Work& run);
void addSchema(CLI::App& app, Work& run);
void addVersion(CLI::App& app, Work& run);

} // namespace hearth::command

// The options that say what is cooked, and what it shall become: those of cook, which a plan keeps.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/command/cook.h"
#include "pipelines/command/open_plan.h"
#include "pipelines/farm/plan.h"

#include <memory>
#include <string>
#include <vector>

namespace CLI
{
class App;
} // namespace CLI

namespace hearth::command
{

struct SettingsOptions : CookOptions
{
    bool bakes_visibility = false;
    VisibilityOptions baked;
    bool makes_bricks = false;
    BrickOptions bricked;
};

void addSettings(CLI::App* verb, const std::shared_ptr<SettingsOptions>& options);

/// To be called when the command line has been read.
void takeSettings(SettingsOptions& options);

/// Those that the command line of a verb has given, as words.
std::vector<std::string> chosenSettings(const CLI::App& verb);

/// The plan, --directory and --cache: what all verbs take that read a plan.
void addPlanFile(CLI::App& verb, PlanOptions& options);

/// A farm::ReadRequest. errors: usage
Result<graph::CookSettings> readRequest(const farm::Request& request);

} // namespace hearth::command

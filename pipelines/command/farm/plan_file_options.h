// Options of all verbs that read a plan.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/command/cook/setting_options.h"
#include "pipelines/command/farm/open_plan.h"

namespace hearth::command
{

/// Add the argument PLAN and the options --directory and --cache.
void addPlanFile(cli::CommandLine& verb, PlanOptions& options, SettingOptions& settings);

} // namespace hearth::command

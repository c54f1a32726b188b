// What the verbs have in common that read a plan.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/command/cook/setting_options.h"
#include "pipelines/command/farm/open_plan.h"

namespace hearth::command
{

/// The plan, --directory and --cache.
void addPlanFile(cli::CommandLine& verb, PlanOptions& options, SettingOptions& settings);

} // namespace hearth::command

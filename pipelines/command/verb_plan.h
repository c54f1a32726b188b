// What the verbs have in common that read a plan.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/command/open_plan.h"
#include "pipelines/command/verbs.h"

namespace hearth::command
{

/// The plan, --directory and --cache.
void addPlanFile(CLI::App& verb, PlanOptions& options);

/// The work of a verb, after the caches have been looked up that the command line leaves open. The options live as long as
/// the work.
Work withPlan(PlanOptions& options, const Work& work);

} // namespace hearth::command

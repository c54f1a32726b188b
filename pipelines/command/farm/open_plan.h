// Opens a plan for the verbs of farms: parsed, checked, and with absolute paths.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/farm/emit.h"
#include "pipelines/farm/plan.h"

#include <string>
#include <vector>

namespace hearth::command
{

/// Options that run, merge and farm have in common.
struct PlanOptions
{
    std::string plan_file;
    std::string directory;           ///< base of the sources' relative paths; empty: as the plan says
    std::vector<std::string> caches; ///< values of --cache
};

/// Plan with the paths and caches to use.
struct OpenedPlan
{
    farm::Plan plan;
    std::string file;      ///< absolute
    std::string hash;      ///< SHA-256 of the plan's text
    std::string directory; ///< absolute; empty if it is the plan's own
    /// Caches with absolute folders: from --cache, else from HEARTH_CACHE; none: the user's own.
    std::vector<std::string> caches;
};

/// Read and check a plan.
/// errors: input_missing, and those of farm::parsePlan
Result<OpenedPlan> openPlan(const PlanOptions& options);

/// Change to the folder of the sources. Relative paths from before have another meaning afterwards.
/// errors: input_missing
Status enterSourceFolder(const OpenedPlan& opened);

/// Return the job for a batch system. pack  empty: beside the plan, "village.hearth" for "village.plan.json"
farm::FarmJob makeFarmJob(const OpenedPlan& opened, const std::string& pack);

/// Return the caches as OpenedPlan::caches describes them.
std::vector<std::string> absoluteCaches(const std::vector<std::string>& caches);

} // namespace hearth::command

// A plan as the verbs of farms need it: read, checked, and with paths that hold wherever they are used.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/farm/emit.h"
#include "pipelines/farm/plan.h"

#include <string>
#include <vector>

namespace hearth::command
{

/// What run, merge and farm have in common.
struct PlanOptions
{
    std::string plan_file;
    std::string directory;           ///< that relative paths of sources start from; empty: as the plan says
    std::vector<std::string> caches; ///< of --cache
};

struct OpenedPlan
{
    farm::Plan plan;
    std::string file;      ///< absolute
    std::string hash;      ///< SHA-256 of its text
    std::string directory; ///< absolute, where it is not the plan's own
    /// Caches with absolute folders: of --cache, else of HEARTH_CACHE; none: the user's own.
    std::vector<std::string> caches;
};

/// errors  input_missing, and those of farm::parsePlan
Result<OpenedPlan> openPlan(const PlanOptions& options);

/// Go to the folder of the sources; paths that were not made absolute before mean others from here on.
/// errors  input_missing
Status enterFolder(const OpenedPlan& opened);

/// What a batch system is told. pack  empty: beside the plan, "village.hearth" of "village.plan.json"
farm::FarmJob jobOf(const OpenedPlan& opened, const std::string& pack);

/// As OpenedPlan::caches.
std::vector<std::string> absoluteCaches(const std::vector<std::string>& caches);

} // namespace hearth::command

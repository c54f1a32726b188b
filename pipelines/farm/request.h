// Request for a distributed cook: sources, and the settings of each by value, wherever they were set.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "pipelines/graph/cook_graph.h"

#include <string>
#include <vector>

namespace hearth::farm
{

/// Name of the pack in a plan; only the merge gets the real name.
inline constexpr const char* kPackName = "pack.hearth";

/// Settings as "clusters.influences=4", each at most once; see profiles::parseAssignment.
using Assignments = std::vector<std::string>;

struct Request
{
    std::vector<std::string> sources;
    std::vector<std::vector<std::string>> lods_of_source; ///< [sources.size()]: authored LODs, as "N=FILE"
    std::vector<Assignments> settings_of_source;          ///< [sources.size()]
    Assignments settings_of_pack;
};

/// Return the settings of the cook with its cooker arguments, exactly as `hearth cook` makes them: a forged
/// request cannot pass other arguments.
/// errors  usage, profile_key, profile_value
Result<graph::CookSettings> makeCookSettings(const Request& request);

} // namespace hearth::farm

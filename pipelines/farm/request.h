// What a plan is asked for: sources, and the settings of each by value, wherever they were written.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "pipelines/graph/cook_graph.h"

#include <string>
#include <vector>

namespace hearth::farm
{

/// What a plan calls the pack, whose name only the merge is told.
inline constexpr const char* kPackName = "pack.hearth";

/// Settings as "clusters.influences=4", each at most once; see profiles::parseAssignment.
using Assignments = std::vector<std::string>;

struct Request
{
    std::vector<std::string> sources;
    std::vector<std::vector<std::string>> lods_of_source; ///< [sources.size()]: levels of detail, as "N=FILE"
    std::vector<Assignments> settings_of_source;          ///< [sources.size()]
    Assignments settings_of_pack;
};

/// What the cookers are told: as `hearth cook` tells them, so that whoever wrote a request, no cooker is told anything else.
/// errors  usage, profile_key, profile_value
Result<graph::CookSettings> settingsOf(const Request& request);

} // namespace hearth::farm

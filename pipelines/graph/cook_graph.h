// Builds the action graph of a cook: which cookers run over which sources, and the inputs of the link.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "pipelines/graph/action.h"
#include "pipelines/settings/value.h"

#include <string>
#include <vector>

namespace hearth::graph
{

/// Complete description of a cook, from which its graph is made.
struct CookSettings
{
    std::vector<std::string> sources;
    std::string output;
    /// [sources.size()], or empty: authored LODs of each source, as "N=FILE".
    std::vector<std::vector<std::string>> lods_of_source;
    /// [sources.size()], or empty: none is set. Settings enter the cache keys by value, as arguments of
    /// cookers.
    std::vector<settings::Values> values_of_source;
    settings::Values values_of_pack;
};

/// Build the graph of a cook from the registry of cookers.
/// errors: usage where the authored LODs are invalid, profile_value where settings contradict each other
Result<Graph> makeCookGraph(const CookSettings& settings);

} // namespace hearth::graph

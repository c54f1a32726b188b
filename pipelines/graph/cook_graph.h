// The graph of a cook: which cookers run over which sources, and what the link takes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/result.h"
#include "pipelines/graph/action.h"

#include <optional>
#include <string>
#include <vector>

namespace hearth::graph
{

/// What hearth-visibility is told.
struct VisibilityOptions
{
    std::string quality = "default";
    std::string occluders = "scene";
    double distance = 0; ///< metres; 0: no limit
    double power = 0;    ///< with a distance only
};

/// What a cook makes of what: all that its graph is made from.
struct CookSettings
{
    std::vector<std::string> sources;
    std::string output;
    std::vector<std::string> lods;               ///< "N=FILE": levels of detail of the only source
    std::string profile;                         ///< TOML file that the cookers read; empty: none
    std::optional<VisibilityOptions> visibility; ///< none: vertices do not say what they see
    bool statistics = false;                     ///< hearth-clusters says what became of each mesh
};

/// Name of the output of hearth-clusters that says what became of each mesh, where it is asked for.
inline constexpr const char* kStatisticsOutput = "clusters.json";

/// errors: usage where the levels of detail are not as they should be.
Result<Graph> makeCookGraph(const CookSettings& settings);

} // namespace hearth::graph

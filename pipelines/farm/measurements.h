// Measurements time and memory of cookers in an earlier cook: better estimates than file sizes give.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "pipelines/graph/action.h"

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hearth::farm
{

/// Measurements by the name of the source (empty: actions of all sources together) and by cooker.
using Measurements = std::map<std::pair<std::string, std::string>, graph::Estimate>;

/// Read the measurements of a report: of cookers that made something, in that cook or in the one from which
/// the cache has their result.
///
/// report  JSON of `hearth cook --report` or `hearth merge --report`
/// errors  json_syntax, which names `file`
Result<Measurements> readMeasurements(std::string_view report, const std::string& file);

/// Replace the estimates of measured cookers and sources; others stay as they are.
/// sources  of the graph, as the user typed them
void applyMeasurements(const Measurements& measured, const std::vector<std::string>& sources,
                       graph::Graph& graph);

/// Return the number of sources that were measured.
size_t countMeasured(const Measurements& measured, const std::vector<std::string>& sources);

} // namespace hearth::farm

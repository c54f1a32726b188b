// What cookers took in an earlier cook: a better guess of what they will take than the sizes of files.
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

/// By the name of the source (empty: what is of all sources) and by the cooker.
using Measured = std::map<std::pair<std::string, std::string>, graph::Estimate>;

/// Of cookers that made something, in the cook of the report or in the one that the cache has their result of.
///
/// report  as `hearth cook --report` or `hearth merge --report` writes JSON
/// errors  json_syntax, which names `file`
Result<Measured> measuredOf(std::string_view report, const std::string& file);

/// Let it stand for the estimates of the same cookers and sources; others stay as they are.
/// sources  of the graph, as the user typed them
void estimateBy(const Measured& measured, const std::vector<std::string>& sources, graph::Graph& graph);

/// How many of the sources were measured.
size_t countMeasured(const Measured& measured, const std::vector<std::string>& sources);

} // namespace hearth::farm

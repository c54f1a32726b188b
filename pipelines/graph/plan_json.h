// A graph as JSON, schema "hearth.plan/1": what a dry run shows, what is remembered of a cook, what farms can be given.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "pipelines/graph/action.h"

#include <string>
#include <string_view>

namespace hearth::graph
{

/// Words of a command line are strings, or {"input": I} and {"output": O} with what stands before the path as "before".
std::string planJson(const Graph& graph);

/// The graph again. errors: json_syntax, and internal where the JSON is no plan; they name `file`.
Result<Graph> parsePlan(std::string_view json, const std::string& file);

} // namespace hearth::graph

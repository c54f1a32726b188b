// Graph as JSON, schema "hearth.plan/1": for dry runs, the journal, and plans of farms.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "pipelines/graph/action.h"

#include <string>
#include <string_view>

namespace hearth::graph
{

/// Serialize a graph. Words of a command line are strings, or {"input": I} and {"output": O} with the text
/// before the path as "before".
std::string planJson(const Graph& graph);

/// Parse a graph. errors: json_syntax, and internal where the JSON is no plan; they name `file`.
Result<Graph> parsePlan(std::string_view json, const std::string& file);

} // namespace hearth::graph

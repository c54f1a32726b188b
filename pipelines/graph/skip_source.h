// Leaves sources that could not be cooked out of a graph, so that the pack of the others can be made.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/graph/action.h"
#include "pipelines/graph/cooker_outcome.h"

#include <span>
#include <string>
#include <vector>

namespace hearth::graph
{

/// Option of hearth-link for a source that the pack lacks.
inline constexpr std::string_view kSkippedOption = "--skipped";

/// True if the action belongs to no source and reads parts of sources.
bool readsSources(const Graph& graph, const Action& action);

/// Return the sources that the action reads parts of, ascending.
std::vector<size_t> sourcesRead(const Graph& graph, const Action& action);

/// Remove a source's parts from the actions of the pack, which read those of the other sources as before.
/// The link gets a word for each failure, which it stores in the pack: the source's file name without
/// folders, and the error without paths, so that the same failure gives the same bytes on every machine.
/// failures  of the source's actions; others are ignored
void skipSource(Graph& graph, size_t source, std::span<const Failure> failures);

} // namespace hearth::graph

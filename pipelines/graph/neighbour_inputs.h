// Dynamic inputs: parts of neighbouring sources, which an action reads as the output of another action lists
// them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/graph/action.h"

#include <string_view>

namespace hearth::graph
{

/// Option of a cooker before the parts of its source's neighbours.
inline constexpr std::string_view kNeighboursOption = "--neighbours";

/// Set the dynamic inputs of all actions whose neighbours the action `lister` lists. For each neighbour an
/// action reads parts of the cookers that it reads of its own source. The roles number an action's own
/// neighbours, so that a source that is no neighbour changes no record.
/// list     its first output: a line for each of its inputs, with the numbers of inputs whose sources are
///          neighbours of that input's source
/// returns  false where the list is no such text; the graph has no dynamic inputs then
bool setNeighbourInputs(Graph& graph, size_t lister, std::string_view list);

/// Remove the dynamic inputs that setNeighbourInputs has set.
void removeNeighbourInputs(Graph& graph, size_t lister);

} // namespace hearth::graph

// Dynamic inputs and words of actions, as the output of another action lists them: parts of neighbouring
// sources, and formats of textures that share a budget.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/graph/action.h"

#include <string_view>

namespace hearth::graph
{

/// Option of a cooker before the parts of its source's neighbours.
inline constexpr std::string_view kNeighboursOption = "--neighbours";

/// Option of a cooker before each value of a list of words.
inline constexpr std::string_view kFormatOption = "--format";

/// Set the dynamic inputs or words of all actions that the action `lister` lists. For each neighbour an
/// action reads parts of the cookers that it reads of its own source. The roles number an action's own
/// neighbours, so that a source that is no neighbour changes no record.
/// list     its first output: a line for each of its inputs, which concerns that input's source. A list of
///          neighbours has numbers of inputs, whose sources are neighbours; a list of words has values of
///          kFormatOption; with spaces between them
/// returns  false where the list is no such text; the graph has nothing of it then
bool applyList(Graph& graph, size_t lister, std::string_view list);

/// Remove what applyList has set.
void removeListed(Graph& graph, size_t lister);

} // namespace hearth::graph

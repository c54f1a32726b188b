// Estimates the memory and time of actions, so that a cook fits its memory limit.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/graph/action.h"

namespace hearth::graph
{

/// Estimate every action from its cooker and the file sizes of its source; an unreadable source counts as
/// empty.
void addEstimates(Graph& graph);

} // namespace hearth::graph

// What actions are thought to need, so that a cook fits its memory.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/graph/action.h"

namespace hearth::graph
{

/// By the cooker and the sizes of the sources on the disk; a source that cannot be looked at counts as empty.
void addEstimates(Graph& graph);

} // namespace hearth::graph

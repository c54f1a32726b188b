// Asks a cache on a server for a whole graph, wave by wave, where each question alone would cost a trip there and back.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/graph/action_cache.h"

namespace hearth::graph
{

/// For cache::Cache::beforeFarIsAsked. In each wave are the actions whose parts are known by then: those that read the
/// user's files, those that read what these made, and so on. Actions that have no result in the cache end it for what reads
/// them, so that nothing is asked for in vain but what must run.
void askAhead(const Graph& graph, cache::Cache& cache, ActionCache& actions);

} // namespace hearth::graph

// Prefetches the cache entries of a whole graph from a server, in waves: a round trip for each entry alone
// would be slow.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/graph/action_cache.h"

namespace hearth::graph
{

/// Prefetch, for cache::Cache::beforeRemoteLookup. Each wave has the actions whose input hashes are known by
/// then: first those that read user files, then those that read their outputs, and so on. The actions behind
/// a cache miss are not looked up, so that requests without a result are only for actions that must run.
void prefetch(const Graph& graph, cache::Cache& cache, ActionCache& actions);

} // namespace hearth::graph

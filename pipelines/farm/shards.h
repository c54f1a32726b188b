// Which sources a farm's machines cook together, so that all have about as much to do.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/graph/action.h"

#include <span>
#include <vector>

namespace hearth::farm
{

/// Sources of each shard, ascending.
using Shards = std::vector<std::vector<size_t>>;

inline constexpr size_t kMaxShards = 100000;

/// What each source's actions are thought to take, in seconds.
std::vector<double> secondsOfSources(const graph::Graph& graph);

/// As many shards as give each about a minute, but no more than sources: a batch system takes half a second of a machine to
/// start one.
size_t shardCountFor(std::span<const double> seconds_of_source);

/// The longest source first, each to the shard that has least to do: no shard takes more than 4/3 - 1/(3 count) times what the
/// best of all distributions would let the longest take.
/// Deterministic: among equals, the source and the shard that come first.
///
/// seconds_of_source  not negative
/// count              at least 1; shards beyond the number of sources are empty
/// source             R. L. Graham, "Bounds on multiprocessing timing anomalies", 1969 (LPT)
Shards distribute(std::span<const double> seconds_of_source, size_t count);

/// The actions of these sources alone; none of them reads from another source. Sources keep their numbers.
/// sources    ascending
/// action_of  [actions of the result] the index that each has in `graph`
graph::Graph actionsOf(const graph::Graph& graph, std::span<const size_t> sources,
                       std::vector<size_t>& action_of);

} // namespace hearth::farm

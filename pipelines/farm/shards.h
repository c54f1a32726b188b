// Distributes sources to the machines of a farm, with about equal work for each (multiprocessor scheduling).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/graph/action.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::farm
{

/// Sources of each shard, ascending.
using Shards = std::vector<std::vector<size_t>>;

inline constexpr size_t kMaxShards = 100000;

/// Return the estimated time of each source's actions, in seconds.
std::vector<double> estimateSourceTimes(const graph::Graph& graph);

/// Return the number of shards that gives each about a minute of work, at most one for each source: a batch
/// system takes half a second of a machine to start one.
size_t chooseShardCount(std::span<const double> seconds_of_source);

/// Distribute sources: the longest first, each to the shard with the least work. No shard takes more than 4/3
/// - 1/(3 count) times the longest shard
/// of an optimal distribution. Deterministic: among equals, the first source and the first shard win.
///
/// seconds_of_source  not negative
/// count              at least 1; shards beyond the number of sources are empty
/// source             R. L. Graham, "Bounds on multiprocessing timing anomalies", 1969 (LPT)
Shards distribute(std::span<const double> seconds_of_source, size_t count);

/// Part of a shard's work. Visibility reads the parts of neighbouring sources, which are in any shard: so all
/// shards are prepared before the first one is completed. A shard that is completed earlier makes what it
/// lacks itself.
enum class Step : uint8_t
{
    prepare,  ///< the actions that read no other source
    complete, ///< all actions
};

/// Return the actions of these sources that belong to a step, ascending.
/// sources  ascending
std::vector<size_t> listActions(const graph::Graph& graph, std::span<const size_t> sources, Step step);

/// True if actions of a source read parts of other sources, so that shards have two steps.
bool hasTwoSteps(const graph::Graph& graph);

} // namespace hearth::farm

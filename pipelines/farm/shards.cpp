// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/farm/shards.h"

#include "formats/base/assert.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hearth::farm
{

namespace
{

// Target duration of a shard. Starting a task takes half a second of it, as measured with 300 empty tasks of
// Slurm 22.05 on three nodes.
constexpr double kShardSeconds = 60;

} // namespace

std::vector<double> estimateSourceTimes(const graph::Graph& graph)
{
    std::vector<double> seconds(graph.source_count);
    for (const graph::Action& action : graph.actions)
        if (action.source < graph.source_count)
            seconds[action.source] += action.estimate.seconds;
    return seconds;
}

size_t chooseShardCount(std::span<const double> seconds_of_source)
{
    const double seconds = std::accumulate(seconds_of_source.begin(), seconds_of_source.end(), 0.0);
    const size_t max_count = std::clamp<size_t>(seconds_of_source.size(), 1, kMaxShards);
    return static_cast<size_t>(
        std::clamp(std::floor(seconds / kShardSeconds), 1.0, static_cast<double>(max_count)));
}

Shards distribute(std::span<const double> seconds_of_source, size_t count)
{
    HEARTH_ASSERT(count >= 1);
    std::vector<size_t> order(seconds_of_source.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](size_t a, size_t b) { return seconds_of_source[a] > seconds_of_source[b]; });
    Shards shards(count);
    std::vector<double> load(count);
    for (const size_t source : order)
    {
        const auto lightest = static_cast<size_t>(std::min_element(load.begin(), load.end()) - load.begin());
        shards[lightest].push_back(source);
        load[lightest] += seconds_of_source[source];
    }
    for (std::vector<size_t>& sources : shards)
        std::sort(sources.begin(), sources.end());
    return shards;
}

std::vector<size_t> listActions(const graph::Graph& graph, std::span<const size_t> sources, Step step)
{
    std::vector<size_t> actions;
    for (size_t i = 0; i < graph.actions.size(); ++i)
    {
        const graph::Action& action = graph.actions[i];
        if (std::binary_search(sources.begin(), sources.end(), action.source) &&
            (step == Step::complete || action.lister == graph::kNoAction))
            actions.push_back(i);
    }
    return actions;
}

bool hasTwoSteps(const graph::Graph& graph)
{
    return std::ranges::any_of(graph.actions,
                               [](const graph::Action& action) { return action.lister != graph::kNoAction; });
}

} // namespace hearth::farm

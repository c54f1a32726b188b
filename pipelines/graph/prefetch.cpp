// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/graph/prefetch.h"

namespace hearth::graph
{

namespace
{

struct PendingLookup
{
    size_t action = 0;
    Record record;
};

/// Hash of the first output of each action; nullopt where it is not known.
using PartHashes = std::vector<std::optional<std::string>>;

/// Return the hashes of the action's inputs; nullopt where one is not known.
std::optional<std::vector<std::string>> inputHashes(const Action& action, const PartHashes& hash_of_action)
{
    std::vector<std::string> hashes;
    for (const Input& input : action.inputs)
    {
        if (input.action != kNoAction && !hash_of_action[input.action])
            return std::nullopt;
        hashes.push_back(input.action == kNoAction ? "" : *hash_of_action[input.action]);
    }
    return hashes;
}

/// Return the actions that can be looked up now, and remove them from `remaining`.
std::vector<PendingLookup> nextWave(const Graph& graph, ActionCache& actions,
                                    const PartHashes& hash_of_action, std::vector<size_t>& remaining)
{
    std::vector<PendingLookup> wave;
    std::vector<size_t> later;
    for (const size_t index : remaining)
    {
        const Action& action = graph.actions[index];
        const auto part_hashes = inputHashes(action, hash_of_action);
        if (!part_hashes)
            later.push_back(index);
        else if (std::optional<Record> record = actions.makeRecord(action, *part_hashes))
            wave.push_back({index, std::move(*record)});
    }
    remaining = std::move(later);
    return wave;
}

} // namespace

void prefetch(const Graph& graph, cache::Cache& cache, ActionCache& actions)
{
    PartHashes hash_of_action(graph.actions.size());
    std::vector<size_t> remaining;
    for (size_t i = 0; i < graph.actions.size(); ++i)
        remaining.push_back(i);
    for (;;)
    {
        const std::vector<PendingLookup> wave = nextWave(graph, actions, hash_of_action, remaining);
        if (wave.empty())
            return;
        std::vector<std::string> keys;
        for (const PendingLookup& lookup : wave)
            keys.push_back(graph.actions[lookup.action].finds_files ? findingsKey(lookup.record)
                                                                    : resultKey(lookup.record));
        cache.prefetch(keys);
        keys.clear();
        for (const PendingLookup& lookup : wave)
            if (graph.actions[lookup.action].finds_files)
                if (const auto record =
                        actions.recordFromFindings(graph.actions[lookup.action], lookup.record))
                    keys.push_back(resultKey(*record));
        cache.prefetch(keys);
        for (const PendingLookup& lookup : wave)
            if (const auto result = actions.find(graph.actions[lookup.action], lookup.record).result)
                hash_of_action[lookup.action] = result->outputs.front().hash;
    }
}

} // namespace hearth::graph

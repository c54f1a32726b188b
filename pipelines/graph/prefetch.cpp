// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/graph/prefetch.h"

namespace hearth::graph
{

namespace
{

struct Question
{
    size_t action = 0;
    Record record;
};

/// Hash of the first output of each action; nullopt where it is not known.
using PartHashes = std::vector<std::optional<std::string>>;

/// Return the hashes of the action's inputs; nullopt where one is not known.
std::optional<std::vector<std::string>> hashesOfInputs(const Action& action, const PartHashes& hash_of_action)
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

/// Return the actions that can be looked up now, and remove them from `left`.
std::vector<Question> nextWave(const Graph& graph, ActionCache& actions, const PartHashes& hash_of_action,
                               std::vector<size_t>& left)
{
    std::vector<Question> wave;
    std::vector<size_t> later;
    for (const size_t index : left)
    {
        const Action& action = graph.actions[index];
        const auto part_hashes = hashesOfInputs(action, hash_of_action);
        if (!part_hashes)
            later.push_back(index);
        else if (std::optional<Record> record = actions.recordOf(action, *part_hashes))
            wave.push_back({index, std::move(*record)});
    }
    left = std::move(later);
    return wave;
}

} // namespace

void askAhead(const Graph& graph, cache::Cache& cache, ActionCache& actions)
{
    PartHashes hash_of_action(graph.actions.size());
    std::vector<size_t> left;
    for (size_t i = 0; i < graph.actions.size(); ++i)
        left.push_back(i);
    for (;;)
    {
        const std::vector<Question> wave = nextWave(graph, actions, hash_of_action, left);
        if (wave.empty())
            return;
        std::vector<std::string> keys;
        for (const Question& question : wave)
            keys.push_back(graph.actions[question.action].finds_files ? findingsKey(question.record)
                                                                      : resultKey(question.record));
        cache.askAhead(keys);
        keys.clear();
        for (const Question& question : wave)
            if (graph.actions[question.action].finds_files)
                if (const auto record =
                        actions.recordByFindings(graph.actions[question.action], question.record))
                    keys.push_back(resultKey(*record));
        cache.askAhead(keys);
        for (const Question& question : wave)
            if (const auto result = actions.find(graph.actions[question.action], question.record).result)
                hash_of_action[question.action] = result->outputs.front().hash;
    }
}

} // namespace hearth::graph

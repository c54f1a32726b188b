// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/graph/skip_source.h"

#include "cook/json/json.h"
#include "pipelines/graph/message.h"

#include <algorithm>

namespace hearth::graph
{

namespace
{

/// Return the source whose action makes the input; source_count for user files and parts of the pack.
size_t sourceRead(const Graph& graph, const Input& input)
{
    return input.action == kNoAction ? graph.source_count : graph.actions[input.action].source;
}

/// Remove the inputs of a source with their words, and renumber the inputs that other words refer to.
void removeInputs(const Graph& graph, size_t source, Action& action)
{
    std::vector<Input> kept;
    std::vector<size_t> new_index(action.inputs.size(), SIZE_MAX); // SIZE_MAX: removed
    for (size_t i = 0; i < action.inputs.size(); ++i)
    {
        if (sourceRead(graph, action.inputs[i]) == source)
            continue;
        new_index[i] = kept.size();
        kept.push_back(action.inputs[i]);
    }
    std::vector<Word> words;
    for (Word& word : action.words)
    {
        if (word.kind == Word::Kind::input)
            word.index = new_index[word.index];
        if (word.index != SIZE_MAX)
            words.push_back(std::move(word));
    }
    action.inputs = std::move(kept);
    action.words = std::move(words);
}

/// Return the value of the link's option for a failure.
std::string skippedText(const std::string& source, const std::string& error)
{
    const Message message = parseMessage(error);
    return Json{{"source", source.substr(source.rfind('/') + 1)},
                {"code", message.code},
                {"pointer", message.pointer},
                {"text", message.text}}
        .dump();
}

} // namespace

std::vector<size_t> sourcesRead(const Graph& graph, const Action& action)
{
    std::vector<size_t> sources;
    for (const Input& input : action.inputs)
        if (const size_t source = sourceRead(graph, input); source < graph.source_count)
            sources.push_back(source);
    std::sort(sources.begin(), sources.end());
    sources.erase(std::unique(sources.begin(), sources.end()), sources.end());
    return sources;
}

bool readsSources(const Graph& graph, const Action& action)
{
    return action.source == graph.source_count &&
           std::any_of(action.inputs.begin(), action.inputs.end(),
                       [&](const Input& input) { return sourceRead(graph, input) < graph.source_count; });
}

void skipSource(Graph& graph, size_t source, std::span<const Failure> failures)
{
    std::string name;
    for (const Action& action : graph.actions)
        if (action.source == source)
            name = action.subject;
    for (Action& action : graph.actions)
        if (action.source == graph.source_count)
            removeInputs(graph, source, action);
    Action& link = graph.actions.back();
    for (const Failure& failure : failures)
    {
        if (failure.source != source)
            continue;
        link.words.push_back({Word::Kind::text, std::string(kSkippedOption), 0});
        link.words.push_back({Word::Kind::text, skippedText(name, failure.error), 0});
    }
}

} // namespace hearth::graph

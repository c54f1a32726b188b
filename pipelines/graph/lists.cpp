// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/graph/lists.h"

#include "pipelines/cookers/registry.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace hearth::graph
{

using cookers::Lists;

namespace
{

/// Indices of actions by source and cooker.
using SourceActions = std::map<std::pair<size_t, std::string_view>, size_t>;

SourceActions indexActions(const Graph& graph)
{
    SourceActions actions;
    for (size_t i = 0; i < graph.actions.size(); ++i)
        actions[{graph.actions[i].source, graph.actions[i].cooker}] = i;
    return actions;
}

/// Parse a line of numbers below `count` with spaces between them.
std::optional<std::vector<size_t>> parseLine(std::string_view line, size_t count)
{
    std::vector<size_t> numbers;
    while (!line.empty())
    {
        size_t number = 0;
        const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), number);
        if (error != std::errc() || number >= count)
            return std::nullopt;
        numbers.push_back(number);
        line.remove_prefix(static_cast<size_t>(end - line.data()));
        if (line.starts_with(' ') && line.size() > 1)
            line.remove_prefix(1);
        else if (!line.empty())
            return std::nullopt;
    }
    return numbers;
}

/// Parse the whole list; nullopt where it does not have a line for each of `count` inputs.
std::optional<std::vector<std::vector<size_t>>> parseNumbers(std::string_view list, size_t count)
{
    std::vector<std::vector<size_t>> lines;
    while (!list.empty())
    {
        const size_t end = list.find('\n');
        std::optional<std::vector<size_t>> line = parseLine(list.substr(0, end), count);
        if (end == std::string_view::npos || !line)
            return std::nullopt;
        lines.push_back(std::move(*line));
        list.remove_prefix(end + 1);
    }
    return lines.size() == count ? std::optional(std::move(lines)) : std::nullopt;
}

/// Return the memory that an action takes for a neighbour's part: as much as the part's own cooker beyond
/// what that takes for an empty source.
uint64_t partMemory(const Action& producer)
{
    const cookers::Cooker* cooker = cookers::findCooker(producer.cooker);
    const uint64_t base = cooker == nullptr ? 0 : cooker->cost.base_bytes;
    return producer.estimate.memory_bytes - std::min(producer.estimate.memory_bytes, base);
}

/// Return the content of the list that an action writes.
Lists listContent(const Action& lister)
{
    const cookers::Cooker* cooker = cookers::findCooker(lister.cooker);
    return cooker == nullptr ? Lists::nothing : cooker->lists;
}

/// Return the position of the first such option in an action's words, and their number where it has none.
size_t findOption(const Action& action, std::string_view option)
{
    const auto isOption = [&](const Word& word)
    { return word.kind == Word::Kind::text && word.text == option; };
    return static_cast<size_t>(std::ranges::find_if(action.words, isOption) - action.words.begin());
}

/// Remove the dynamic inputs of an action: all after the option.
void removeInputs(const Graph& graph, Action& action)
{
    const size_t option = findOption(action, kNeighboursOption);
    if (option == action.words.size())
        return;
    const size_t first = action.words[option + 1].index;
    for (size_t i = first; i < action.inputs.size(); ++i)
        action.estimate.memory_bytes -= partMemory(graph.actions[action.inputs[i].action]);
    action.inputs.resize(first);
    action.words.resize(option);
}

/// Add the parts of the neighbours to the inputs of an action that has no dynamic inputs.
void addInputs(const Graph& graph, const SourceActions& actions, const std::vector<size_t>& neighbours,
               Action& action)
{
    if (neighbours.empty())
        return;
    const std::vector<Input> own = action.inputs;
    action.words.push_back({Word::Kind::text, std::string(kNeighboursOption), 0});
    for (size_t i = 0; i < neighbours.size(); ++i)
        for (const Input& input : own)
        {
            const std::string& cooker = graph.actions[input.action].cooker;
            const size_t producer = actions.at({neighbours[i], cooker});
            action.words.push_back({Word::Kind::input, "", action.inputs.size()});
            action.inputs.push_back({fmt::format("part of {} of neighbour {}", cooker, i), producer, "", 0});
            action.estimate.memory_bytes += partMemory(graph.actions[producer]);
        }
}

/// Parse the whole list; nullopt where it does not have a line of words for each of `count` inputs.
std::optional<std::vector<std::vector<std::string>>> parseWords(std::string_view list, size_t count)
{
    std::vector<std::vector<std::string>> lines;
    while (!list.empty())
    {
        const size_t end = list.find('\n');
        if (end == std::string_view::npos)
            return std::nullopt;
        std::vector<std::string>& words = lines.emplace_back();
        for (std::string_view line = list.substr(0, end); !line.empty();)
        {
            const size_t space = std::min(line.find(' '), line.size());
            if (space == 0 || space + 1 == line.size())
                return std::nullopt;
            words.emplace_back(line.substr(0, space));
            line.remove_prefix(std::min(space + 1, line.size()));
        }
        list.remove_prefix(end + 1);
    }
    return lines.size() == count ? std::optional(std::move(lines)) : std::nullopt;
}

void addWords(const std::vector<std::string>& values, Action& action)
{
    for (const std::string& value : values)
        for (const std::string& word : {std::string(kFormatOption), value})
            action.words.push_back({Word::Kind::text, word, 0});
}

/// Return the numbers of the sources that an action reads, in the order of its inputs.
std::vector<size_t> listSources(const Graph& graph, const Action& action)
{
    std::vector<size_t> sources;
    for (const Input& input : action.inputs)
        sources.push_back(graph.actions[input.action].source);
    return sources;
}

/// Call a function for each action that a list completes, with its line.
template <typename Lines, typename Add>
void visitListed(Graph& graph, size_t lister, const std::vector<size_t>& sources, const Lines& lines,
                 const Add& add)
{
    for (Action& action : graph.actions)
    {
        const auto line = static_cast<size_t>(std::ranges::find(sources, action.source) - sources.begin());
        if (action.lister == lister && line != sources.size())
            add(lines[line], action);
    }
}

} // namespace

void removeListed(Graph& graph, size_t lister)
{
    const bool has_words = listContent(graph.actions[lister]) == Lists::words;
    for (Action& action : graph.actions)
        if (action.lister == lister && has_words)
            action.words.resize(findOption(action, kFormatOption));
        else if (action.lister == lister)
            removeInputs(graph, action);
}

bool applyList(Graph& graph, size_t lister, std::string_view list)
{
    removeListed(graph, lister);
    const std::vector<size_t> sources = listSources(graph, graph.actions[lister]);
    if (listContent(graph.actions[lister]) == Lists::words)
    {
        const auto lines = parseWords(list, sources.size());
        if (lines)
            visitListed(graph, lister, sources, *lines, addWords);
        return lines.has_value();
    }
    const auto lines = parseNumbers(list, sources.size());
    if (!lines)
        return false;
    const SourceActions actions = indexActions(graph);
    visitListed(graph, lister, sources, *lines,
                [&](const std::vector<size_t>& numbers, Action& action)
                {
                    std::vector<size_t> neighbours;
                    for (const size_t number : numbers)
                        neighbours.push_back(sources[number]);
                    addInputs(graph, actions, neighbours, action);
                });
    return true;
}

} // namespace hearth::graph

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/graph/causes.h"

#include "pipelines/graph/skip_source.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace hearth::graph
{

namespace
{

/// Options of a command line with their values: "--quality" -> "high"; "" where an option has no value, or a
/// file for one. "--set", "clusters.influences=4" is "clusters.influences" -> "4".
using Options = std::map<std::string, std::string>;

constexpr std::string_view kText = "text ";

Options parseOptions(const Record& record)
{
    Options options;
    std::string option;
    for (const auto& [name, value] : record)
    {
        if (name != "word")
            continue;
        const bool is_text = value.starts_with(kText);
        const std::string word = is_text ? value.substr(kText.size()) : "";
        if (is_text && word.starts_with("-"))
            option = word;
        else if (is_text && option == "--set" && word.find('=') != std::string::npos)
            options[word.substr(0, word.find('='))] = word.substr(word.find('=') + 1);
        else if (is_text && !option.empty())
            options[option] = word;
        if (is_text && word.starts_with("-") && word != "--set")
            options[word];
    }
    // skipped sources are causes of their own
    options.erase(std::string(kSkippedOption));
    return options;
}

std::string optionText(const std::string& option, const std::string& value)
{
    return value.empty() ? option : option + " " + value;
}

void addOptionCauses(const Record& before, const Record& now, std::vector<std::string>& causes)
{
    const Options old_options = parseOptions(before);
    const Options new_options = parseOptions(now);
    for (const auto& [option, value] : new_options)
        if (const auto old = old_options.find(option); old == old_options.end())
            causes.push_back(fmt::format("parameter {}: new", optionText(option, value)));
        else if (old->second != value)
            causes.push_back(fmt::format("parameter {}: {} -> {}", option, old->second, value));
    for (const auto& [option, value] : old_options)
        if (!new_options.contains(option))
            causes.push_back(fmt::format("parameter {}: no longer given", optionText(option, value)));
}

/// Return the input and found files of a record with their values, by field name.
std::map<std::string, std::string> readFiles(const Record& record)
{
    std::map<std::string, std::string> files;
    for (const auto& [name, value] : record)
        if (name.starts_with("input ") || name.starts_with(kFound))
            files[name] = value;
    return files;
}

/// Return the user's name for the file of a field: its path, or the action that made it.
std::string fileLabel(const Action& action, const Graph& graph, const std::string& field)
{
    if (field.starts_with(kFound))
        return field.substr(field.find('/') + 1);
    for (const Input& input : action.inputs)
        if ("input " + input.role == field)
            return input.action == kNoAction
                       ? input.path
                       : fmt::format("what {} made of {}", graph.actions[input.action].cooker,
                                     graph.actions[input.action].subject);
    return field.substr(field.find(' ') + 1);
}

std::string fileCause(const std::string& name, const std::string& before, const std::string& now)
{
    if (before == kAbsent)
        return name + ": is there now";
    if (now == kAbsent)
        return name + ": is not there any more";
    // for user files the hash is followed by the name
    const size_t hash_size = std::min(before.find(' '), before.size());
    const bool same_content =
        before.substr(0, hash_size) == now.substr(0, std::min(now.find(' '), now.size()));
    return name + (same_content ? ": its name has changed" : ": its content has changed");
}

void addFileCauses(const Action& action, const Graph& graph, const Record& before, const Record& now,
                   std::vector<std::string>& causes)
{
    const auto old_files = readFiles(before);
    const auto new_files = readFiles(now);
    for (const auto& [field, value] : new_files)
    {
        const auto old = old_files.find(field);
        if (old != old_files.end() && old->second != value)
            causes.push_back(fileCause(fileLabel(action, graph, field), old->second, value));
        else if (old == old_files.end())
            causes.push_back(fileLabel(action, graph, field) + ": is read now");
    }
    for (const auto& [field, value] : old_files)
        // files that only the run will find are no cause
        if (!new_files.contains(field) && !field.starts_with(kFound))
            causes.push_back(fileLabel(action, graph, field) + ": is not read any more");
}

/// Return the sources of a cook, in order.
std::vector<std::string> listSources(const Graph& graph)
{
    std::vector<std::string> sources(graph.source_count);
    for (const Action& action : graph.actions)
        if (action.source < graph.source_count)
            sources[action.source] = action.subject;
    return sources;
}

/// Add causes for an action that reads all sources: sources added, removed, reordered.
void addSourceCauses(const Graph& before, const Graph& now, std::vector<std::string>& causes)
{
    const std::vector<std::string> old_sources = listSources(before);
    const std::vector<std::string> new_sources = listSources(now);
    const size_t causes_before = causes.size();
    const auto addMissing =
        [&](const std::vector<std::string>& from, const std::vector<std::string>& in, const char* what)
    {
        for (const std::string& source : from)
            if (std::count(from.begin(), from.end(), source) > std::count(in.begin(), in.end(), source))
                causes.push_back(source + what);
    };
    addMissing(new_sources, old_sources, ": source added");
    addMissing(old_sources, new_sources, ": source removed");
    if (causes.size() == causes_before && old_sources != new_sources)
        causes.emplace_back("the sources are in another order");
}

/// Return the sources that a cook's link has read, by name.
std::vector<std::string> listLinkedSources(const Graph& graph)
{
    const std::vector<std::string> sources = listSources(graph);
    std::vector<std::string> linked;
    for (const size_t source : sourcesRead(graph, graph.actions.back()))
        linked.push_back(sources[source]);
    return linked;
}

/// Add causes for an action that reads all sources: sources that one of the cooks skips.
void addSkippedCauses(const Graph& before, const Graph& now, std::vector<std::string>& causes)
{
    const std::vector<std::string> old_linked = listLinkedSources(before);
    const std::vector<std::string> new_linked = listLinkedSources(now);
    const auto has = [](const std::vector<std::string>& list, const std::string& name)
    { return std::find(list.begin(), list.end(), name) != list.end(); };
    for (const std::string& source : listSources(now))
        if (has(listSources(before), source) && has(old_linked, source) != has(new_linked, source))
            causes.push_back(source + (has(new_linked, source) ? ": was skipped last time" : ": is skipped"));
}

bool hasSameField(std::string_view field, const Record& a, const Record& b)
{
    return cache::fieldValue(a, field) == cache::fieldValue(b, field);
}

} // namespace

const JournalAction* findLastAction(const Action& action, const Graph& graph, const Journal& journal)
{
    const bool is_of_all = action.source == graph.source_count;
    for (size_t i = 0; i < journal.graph.actions.size(); ++i)
    {
        const Action& other = journal.graph.actions[i];
        const bool other_is_of_all = other.source == journal.graph.source_count;
        if (other.cooker == action.cooker && other_is_of_all == is_of_all &&
            (is_of_all || other.subject == action.subject))
            return &journal.actions[i];
    }
    return nullptr;
}

std::vector<std::string> findCauses(const Action& action, const Graph& graph, const ActionState& state,
                                    const std::optional<Journal>& journal)
{
    if (state.is_forced)
        return {"forced"};
    if (!journal)
        return {"never cooked into this pack before"};
    const JournalAction* last = findLastAction(action, graph, *journal);
    if (last == nullptr)
        return {"new in this pack"};
    std::vector<std::string> causes;
    if (action.source == graph.source_count)
    {
        addSourceCauses(journal->graph, graph, causes);
        addSkippedCauses(journal->graph, graph, causes);
    }
    if (last->ending == Outcome::failed)
        causes.emplace_back("it failed last time");
    for (const std::string& cooker : state.pending_cookers)
        causes.push_back(cooker + " runs before it");
    if (!state.pending_cookers.empty())
        return causes;
    if (state.record.empty())
        causes.emplace_back("a file that it reads cannot be read");
    else if (!last->record.empty())
    {
        if (!hasSameField("version", last->record, state.record))
            causes.push_back("hearth-" + action.cooker + " has changed");
        if (!hasSameField("processor", last->record, state.record))
            causes.emplace_back("this processor is of another class");
        addOptionCauses(last->record, state.record, causes);
        if (causes.empty() || action.source < graph.source_count)
            addFileCauses(action, graph, last->record, state.record, causes);
    }
    if (state.is_damaged)
        causes.emplace_back("its result in the cache is damaged");
    else if (causes.empty())
        causes.emplace_back("its result is not in the cache");
    return causes;
}

} // namespace hearth::graph

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/graph/cook_graph.h"

#include "cook/tools/lod_files.h"
#include "pipelines/cookers/registry.h"
#include "pipelines/graph/estimate.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace hearth::graph
{

namespace
{

using cookers::Cooker;
using settings::Scope;
using settings::Values;

/// Indices of actions by the names of their cookers.
using ActionIndices = std::map<std::string_view, size_t>;

/// Graph under construction.
struct Draft
{
    const CookSettings& settings;
    std::vector<Values> values_of_source; ///< [sources]
    Graph graph{};
    std::vector<ActionIndices> actions_of_source; ///< [sources]
    ActionIndices actions_of_pack{};
};

Action makeAction(const Cooker& cooker, size_t source, const std::string& subject)
{
    Action action;
    action.cooker = cooker.name;
    action.source = source;
    action.subject = subject;
    action.finds_files = cooker.reads_files;
    return action;
}

void addWord(Action& action, std::string_view word)
{
    action.words.push_back({Word::Kind::text, std::string(word), 0});
}

void addInput(Action& action, Input input, const std::string& before_path = "")
{
    action.words.push_back({Word::Kind::input, before_path, action.inputs.size()});
    action.inputs.push_back(std::move(input));
}

void addOutput(Action& action, std::string_view option, const std::string& name)
{
    addWord(action, option);
    action.words.push_back({Word::Kind::output, "", action.outputs.size()});
    action.outputs.push_back(name);
}

/// Return an input that is the first output of an earlier action.
Input partInput(const Graph& graph, size_t action)
{
    return {"part of " + graph.actions[action].cooker, action, "", 0};
}

/// Return an input that is the statistics of an earlier action, with the source's index in its role.
Input sourceStatisticsInput(const Graph& graph, size_t action)
{
    // finishAction adds them after the part
    return {fmt::format("statistics of {} {}", graph.actions[action].cooker, graph.actions[action].source),
            action, "", 1};
}

/// Return partInput with the source's index in its role, for actions that read parts of several sources.
Input sourcePartInput(const Graph& graph, size_t action)
{
    Input part = partInput(graph, action);
    part.role += fmt::format(" {}", graph.actions[action].source);
    return part;
}

/// Add the source and its authored LODs. errors: those of parseLodFiles
Status addSourceFiles(const CookSettings& settings, size_t source, Action& action)
{
    addInput(action, {"source", kNoAction, settings.sources[source], 0});
    if (settings.lods_of_source.empty())
        return success();
    HEARTH_ASSIGN_OR_RETURN(const std::vector<tools::LodFile> lods,
                            tools::parseLodFiles(settings.lods_of_source[source]));
    for (const tools::LodFile& lod : lods)
    {
        addWord(action, "--lod");
        addInput(action, {fmt::format("lod {}", lod.level), kNoAction, lod.path, 0},
                 fmt::format("{}=", lod.level));
    }
    return success();
}

/// Add the words that settings make. errors: those of Cooker::makeArguments
Status addArguments(const Cooker& cooker, const Values& values, Action& action)
{
    if (cooker.makeArguments == nullptr)
        return success();
    HEARTH_ASSIGN_OR_RETURN(const cookers::Arguments arguments, cooker.makeArguments(values));
    for (const std::string& word : arguments.words)
        addWord(action, word);
    action.depends_on_processor = arguments.depends_on_processor;
    return success();
}

/// Add the outputs of the cooker and its arguments, then add the action to the graph.
/// returns  its index. errors: those of Cooker::makeArguments
Result<size_t> finishAction(const Cooker& cooker, const Values& values, Action action, Graph& graph)
{
    const std::string name(cooker.name);
    addOutput(action, "-o", name + std::string(cooker.extension));
    HEARTH_TRY(addArguments(cooker, values, action));
    // small and always written, so that any cook can be reported on without running anything again
    if (cooker.has_statistics)
        addOutput(action, "--stats", name + ".json");
    if (!cooker.image_option.empty())
        addOutput(action, cooker.image_option, name + ".png");
    graph.actions.push_back(std::move(action));
    return graph.actions.size() - 1;
}

/// True if a cooker of the pack runs; an empty name runs always.
bool runsInPack(std::string_view cooker, const Draft& draft)
{
    return cooker.empty() || cookers::isEnabled(*cookers::findCooker(cooker), draft.settings.values_of_pack,
                                                draft.values_of_source);
}

/// True if a cooker runs for a source.
bool runsForSource(const Cooker& cooker, const Values& values, const Draft& draft)
{
    return cooker.scope == Scope::source && cookers::isEnabled(cooker, {}, {&values, 1}) &&
           runsInPack(cooker.needed_by, draft);
}

/// True if a cooker gets more for a source than its own parts: a source alone has no neighbours.
bool isListed(const Cooker& cooker, const Values& values, const Draft& draft)
{
    if (cooker.listed_by.empty() || !runsInPack(cooker.listed_by, draft))
        return false;
    const bool has_neighbours = draft.settings.sources.size() > 1;
    return (has_neighbours || cookers::findCooker(cooker.listed_by)->lists != cookers::Lists::neighbours) &&
           (cooker.needsList == nullptr || cooker.needsList(values));
}

/// Add the parts that a cooker of sources reads where they are made.
void addReadsOfSome(const Cooker& cooker, const Values& values, const ActionIndices& actions,
                    const Draft& draft, Action& action)
{
    if (cooker.needsSome != nullptr && !cooker.needsSome(values))
        return;
    for (const std::string_view read : cooker.reads_of_some)
        if (const auto found = actions.find(read); found != actions.end())
        {
            addWord(action, cookers::findCooker(read)->link_option);
            addInput(action, partInput(draft.graph, found->second));
        }
}

/// Add the actions of one source, in two steps: first those that read its own files and parts only, then
/// those that another action lists more for. errors: those of addSourceFiles and finishAction
Status addSource(size_t source, bool is_listed, Draft& draft)
{
    const Values& values = draft.values_of_source[source];
    ActionIndices& actions = draft.actions_of_source[source];
    for (const Cooker& cooker : cookers::allCookers())
    {
        if (!runsForSource(cooker, values, draft) || isListed(cooker, values, draft) != is_listed)
            continue;
        Action action = makeAction(cooker, source, draft.settings.sources[source]);
        if (is_listed)
            action.lister = draft.actions_of_pack.at(cooker.listed_by);
        if (cooker.reads_files)
            HEARTH_TRY(addSourceFiles(draft.settings, source, action));
        for (const std::string_view read : cooker.reads)
            if (const auto found = actions.find(read); found != actions.end())
                addInput(action, partInput(draft.graph, found->second));
        addReadsOfSome(cooker, values, actions, draft, action);
        if (cooker.makeWordsOfPack != nullptr)
            for (const std::string& word : cooker.makeWordsOfPack(draft.settings.values_of_pack))
                addWord(action, word);
        HEARTH_ASSIGN_OR_RETURN(actions[cooker.name],
                                finishAction(cooker, values, std::move(action), draft.graph));
    }
    return success();
}

/// Add the part that a source's action makes, after the option by which programs know parts of some sources.
void addPartOfSome(const Draft& draft, size_t source, size_t part_action, Action& action)
{
    addWord(action, cookers::findCooker(draft.graph.actions[part_action].cooker)->link_option);
    addInput(action, sourcePartInput(draft.graph, part_action), fmt::format("{}=", source));
}

/// Add the parts that a cooker of the pack reads of the sources that have them.
void addReadsOfSomeSources(const Cooker& cooker, const Draft& draft, Action& action)
{
    if (cooker.needsSome != nullptr && !cooker.needsSome(draft.settings.values_of_pack))
        return;
    for (size_t source = 0; source < draft.actions_of_source.size(); ++source)
        for (const std::string_view read : cooker.reads_of_some)
            if (const auto found = draft.actions_of_source[source].find(read);
                found != draft.actions_of_source[source].end())
                addPartOfSome(draft, source, found->second, action);
}

/// Add an action that runs once for all sources. errors: those of finishAction
Status addCookerOfPack(const Cooker& cooker, Draft& draft)
{
    Action action = makeAction(cooker, draft.settings.sources.size(), draft.settings.output);
    action.is_lister = cooker.lists != cookers::Lists::nothing;
    const Values& values = draft.settings.values_of_pack;
    if (const settings::Value* const file = settings::findValue(values, cooker.file_setting); file != nullptr)
        addInput(action,
                 {std::string(cooker.file_setting), kNoAction, settings::valueTexts(*file).front(), 0});
    for (const ActionIndices& actions : draft.actions_of_source)
        for (const std::string_view read : cooker.reads)
        {
            if (!actions.contains(read))
                continue; // it does not run for this source
            addInput(action, cooker.reads_statistics ? sourceStatisticsInput(draft.graph, actions.at(read))
                                                     : sourcePartInput(draft.graph, actions.at(read)));
        }
    addReadsOfSomeSources(cooker, draft, action);
    for (const std::string_view read : cooker.reads_of_pack)
        if (const auto found = draft.actions_of_pack.find(read); found != draft.actions_of_pack.end())
        {
            addWord(action, fmt::format("--{}", read));
            addInput(action, partInput(draft.graph, found->second));
        }
    HEARTH_ASSIGN_OR_RETURN(draft.actions_of_pack[cooker.name],
                            finishAction(cooker, values, std::move(action), draft.graph));
    return success();
}

/// Add the actions that list what cookers of sources need, if any does. errors: those of finishAction
Status addListers(Draft& draft)
{
    for (const Cooker& lister : cookers::allCookers())
    {
        const auto isNeeded = [&](const Values& values)
        {
            return std::ranges::any_of(cookers::allCookers(),
                                       [&](const Cooker& cooker)
                                       {
                                           return cooker.listed_by == lister.name &&
                                                  runsForSource(cooker, values, draft) &&
                                                  isListed(cooker, values, draft);
                                       });
        };
        if (lister.lists != cookers::Lists::nothing && std::ranges::any_of(draft.values_of_source, isNeeded))
            HEARTH_TRY(addCookerOfPack(lister, draft));
    }
    return success();
}

/// Add the actions that run once for all sources, except the link and those that write lists.
/// errors: those of finishAction
Status addCookersOfPack(Draft& draft)
{
    for (const Cooker& cooker : cookers::allCookers())
    {
        const bool is_link = &cooker == &cookers::allCookers().back();
        if (cooker.scope == Scope::pack && !is_link && cooker.lists == cookers::Lists::nothing &&
            cookers::isEnabled(cooker, draft.settings.values_of_pack, draft.values_of_source))
            HEARTH_TRY(addCookerOfPack(cooker, draft));
    }
    return success();
}

/// Return the action whose part is linked in place of the cooker's: that of the cooker which replaces it, or
/// its own.
size_t linkedAction(const Cooker& cooker, const ActionIndices& actions)
{
    for (const auto& [name, index] : actions)
        if (cookers::findCooker(name)->replaces == cooker.name)
            return index;
    return actions.at(cooker.name);
}

/// Add the parts of cookers that need not run for each source.
void addPartsOfSomeSources(const Draft& draft, Action& link)
{
    for (size_t source = 0; source < draft.actions_of_source.size(); ++source)
        for (const auto& [name, index] : draft.actions_of_source[source])
        {
            const Cooker& cooker = *cookers::findCooker(name);
            if (cooker.is_linked && !cooker.link_option.empty())
                addPartOfSome(draft, source, index, link);
        }
}

/// Add the action that makes the pack. errors: those of addArguments
Status addLink(Draft& draft)
{
    const Cooker& cooker = cookers::allCookers().back();
    Action link = makeAction(cooker, draft.settings.sources.size(), draft.settings.output);
    for (const ActionIndices& actions : draft.actions_of_source)
        for (const Cooker& read : cookers::allCookers())
            if (actions.contains(read.name) && read.is_linked && read.replaces.empty() &&
                read.link_option.empty())
                addInput(link, sourcePartInput(draft.graph, linkedAction(read, actions)));
    addPartsOfSomeSources(draft, link);
    for (const Cooker& read : cookers::allCookers())
    {
        const auto found = draft.actions_of_pack.find(read.name);
        if (found == draft.actions_of_pack.end() || !read.is_linked)
            continue;
        addWord(link, read.link_option);
        addInput(link, partInput(draft.graph, found->second));
    }
    addOutput(link, "-o", "pack.hearth");
    HEARTH_TRY(addArguments(cooker, draft.settings.values_of_pack, link));
    draft.graph.actions.push_back(std::move(link));
    return success();
}

} // namespace

Result<Graph> makeCookGraph(const CookSettings& settings)
{
    const size_t sources = settings.sources.size();
    HEARTH_ASSERT(settings.values_of_source.empty() || settings.values_of_source.size() == sources);
    HEARTH_ASSERT(settings.lods_of_source.empty() || settings.lods_of_source.size() == sources);
    Draft draft{settings, settings.values_of_source, {}, std::vector<ActionIndices>(sources)};
    draft.values_of_source.resize(sources);
    draft.graph.source_count = sources;
    for (size_t source = 0; source < sources; ++source)
        HEARTH_TRY(addSource(source, false, draft));
    HEARTH_TRY(addListers(draft));
    for (size_t source = 0; source < sources; ++source)
        HEARTH_TRY(addSource(source, true, draft));
    HEARTH_TRY(addCookersOfPack(draft));
    HEARTH_TRY(addLink(draft));
    addEstimates(draft.graph);
    return std::move(draft.graph);
}

} // namespace hearth::graph

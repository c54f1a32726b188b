// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cook/why.h"

#include "pipelines/command/cook/cook_state.h"
#include "pipelines/command/cook/cook_tools.h"
#include "pipelines/command/cook/dry_run.h"
#include "pipelines/command/cook/reason_groups.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace hearth::command
{

namespace
{

/// Index of the only source whose actions are shown; nullopt: all actions are.
using SourceFilter = std::optional<size_t>;

const char* outcomeText(graph::Outcome ending)
{
    switch (ending)
    {
    case graph::Outcome::failed:
        return " (failed)";
    case graph::Outcome::skipped:
        return " (left out: a dependency failed)";
    case graph::Outcome::unknown:
        return " (did not come to its end)";
    default:
        return "";
    }
}

std::string lastCookText(const graph::Journal& journal, SourceFilter only)
{
    ReasonGroups groups;
    for (size_t i = 0; i < journal.actions.size(); ++i)
    {
        const graph::JournalAction& last = journal.actions[i];
        const graph::Action& action = journal.graph.actions[i];
        if (last.ending != graph::Outcome::cached && (!only || action.source == *only))
            groups.add(action, outcomeText(last.ending), last.causes);
    }
    std::string text = groups.text();
    if (!journal.output_cause.empty() && !only)
        text += fmt::format("  {:<11}{}: {}\n", "pack", journal.output, journal.output_cause);
    return text.empty() ? "  nothing\n" : text;
}

Result<std::string> nextCookText(const graph::Journal& journal, const std::vector<cache::CacheSpec>& caches,
                                 SourceFilter only)
{
    // relative paths of the user start here
    std::error_code error;
    const std::string here = graph::workingFolder();
    const auto state = CookState::openSpecs(caches, journal.output, journal.folder, printError);
    std::filesystem::current_path(journal.folder, error);
    if (error)
        return std::string("  the folder of the last cook is not there any more\n");
    graph::Graph graph = journal.graph;
    state->enablePrefetch(graph);
    graph::Resolver resolver(
        graph, &state->cache(), &state->actions(),
        [&]() -> const std::optional<graph::Journal>& { return state->journal(); }, false);
    const graph::Forecast forecast = graph::forecast(graph, resolver);
    const std::string cause = packCause(forecast, state->hashes().hashFile(journal.output));
    std::filesystem::current_path(here, error);
    ReasonGroups groups;
    for (size_t i = 0; i < forecast.actions.size(); ++i)
    {
        const graph::Action& action = graph.actions[i];
        if (forecast.actions[i].runs && (!only || action.source == *only))
            groups.add(action, "", forecast.actions[i].causes);
    }
    std::string text = groups.text();
    if (!cause.empty() && !only)
        text += fmt::format("  {:<11}{}: {}\n", "pack", journal.output, cause);
    return text.empty() ? std::string("  nothing: it is up to date\n") : text;
}

Result<std::string> explainJournal(const graph::Journal& journal, const std::vector<cache::CacheSpec>& caches,
                                   SourceFilter only)
{
    HEARTH_ASSIGN_OR_RETURN(const std::string next, nextCookText(journal, caches, only));
    return fmt::format("{}\nran in the last cook:\n{}would run now:\n{}", journal.output,
                       lastCookText(journal, only), next);
}

SourceFilter findSourceOfFile(const graph::Journal& journal, const std::string& absolute)
{
    for (const graph::Action& action : journal.graph.actions)
    {
        const auto is_it = [&](const graph::Input& input)
        {
            return input.action == graph::kNoAction &&
                   (std::filesystem::path(journal.folder) / input.path).lexically_normal() == absolute;
        };
        if (std::any_of(action.inputs.begin(), action.inputs.end(), is_it))
            return action.source;
    }
    return std::nullopt;
}

} // namespace

Result<std::string> why(const std::string& file, const std::vector<cache::CacheSpec>& caches)
{
    const std::string absolute = graph::absolutePath(file);
    std::string text;
    for (const graph::Journal& journal : readAllJournals(caches))
    {
        const SourceFilter source = findSourceOfFile(journal, absolute);
        if (journal.output != absolute && !source)
            continue;
        HEARTH_ASSIGN_OR_RETURN(
            const std::string about,
            explainJournal(journal, caches, journal.output == absolute ? std::nullopt : source));
        text += about;
    }
    if (text.empty())
        return Error{Issue::usage, file, "", "no cook of it is remembered in the cache"};
    return text;
}

} // namespace hearth::command

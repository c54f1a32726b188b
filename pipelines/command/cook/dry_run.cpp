// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cook/dry_run.h"

#include "formats/base/atomic_file.h"
#include "pipelines/command/cook/cook_state.h"
#include "pipelines/command/shell/messages.h"
#include "pipelines/graph/plan_json.h"

#include <algorithm>
#include <fmt/format.h>

namespace hearth::command
{

namespace
{

/// Return a line for each action that would run: cooker, subject, causes; empty if none would.
std::string forecastText(const graph::Graph& graph, const graph::Forecast& forecast)
{
    std::string text;
    for (size_t i = 0; i < graph.actions.size(); ++i)
    {
        if (!forecast.actions[i].runs)
            continue;
        text += fmt::format("{:<11}{}: ", graph.actions[i].cooker, graph.actions[i].subject);
        for (size_t cause = 0; cause < forecast.actions[i].causes.size(); ++cause)
            text += (cause == 0 ? "" : "; ") + forecast.actions[i].causes[cause];
        text += '\n';
    }
    return text;
}

constexpr int kSomethingWouldRun = 1;

struct DryRun
{
    std::string text;
    bool is_up_to_date = false; ///< nothing would run, and the pack is in its place
};

Result<DryRun> forecastCook(const CookOptions& options)
{
    HEARTH_ASSIGN_OR_RETURN(graph::Graph graph, graph::makeCookGraph(options));
    const bool is_json = options.dry_run_format == "json";
    if (is_json && !options.dry_run_checks)
        return DryRun{graph::planJson(graph)};
    HEARTH_ASSIGN_OR_RETURN(const auto state,
                            CookState::open(options.caches, options.output, graph::workingFolder(),
                                            [](const Error& warning)
                                            { printMessage(formatMessage(warning)); }));
    state->enablePrefetch(graph);
    const bool has_cache = !options.no_cache && !state->cache().isEmpty();
    graph::Resolver resolver(
        graph, has_cache ? &state->cache() : nullptr, &state->actions(),
        [&]() -> const std::optional<graph::Journal>& { return state->journal(); }, options.force);
    const graph::Forecast forecast = graph::forecast(graph, resolver);
    const auto runs = std::count_if(forecast.actions.begin(), forecast.actions.end(),
                                    [](const graph::Forecast::Entry& entry) { return entry.runs; });
    const std::string cause = packCause(forecast, state->hashes().hashFile(options.output));
    const bool is_up_to_date = runs == 0 && cause.empty();
    if (is_json)
        return DryRun{graph::planJson(graph), is_up_to_date};
    std::string text = forecastText(graph, forecast);
    if (!cause.empty())
        text += fmt::format("{:<11}{}: {}\n", "pack", options.output, cause);
    text += fmt::format("{} of {} cookers would run\n", runs, graph.actions.size());
    return DryRun{text, is_up_to_date};
}

} // namespace

std::string packCause(const graph::Forecast& forecast, const std::optional<std::string>& old_pack_hash)
{
    if (!forecast.result || old_pack_hash == forecast.result->hash)
        return "";
    return old_pack_hash ? "it is not what was cooked: changed since, or damaged" : "it is not there";
}

int dryRun(const CookOptions& options)
{
    const Result<DryRun> dry_run = forecastCook(options);
    const Status printed = dry_run.ok() ? writeText("-", dry_run->text) : Status(dry_run.error());
    if (printed.ok())
        return options.dry_run_checks && !dry_run->is_up_to_date ? kSomethingWouldRun : 0;
    printMessage(formatMessage(printed.error()));
    return exitCode(printed.error());
}

} // namespace hearth::command

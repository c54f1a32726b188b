// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/graph/resolver.h"

#include "formats/base/assert.h"
#include "pipelines/graph/causes.h"
#include "pipelines/graph/lists.h"

#include <algorithm>

namespace hearth::graph
{

/// Return the record with the current hashes of the files that the last run found, so that it can be compared
/// with the record of that run.
Record Resolver::comparableRecord(size_t action, const std::optional<Record>& record)
{
    if (!record)
        return {};
    Record now = *record;
    const std::optional<Journal>& journal = journal_();
    const auto isFound = [](const auto& field) { return field.first.starts_with(kFound); };
    if (!journal || std::any_of(now.begin(), now.end(), isFound) || !graph_.actions[action].finds_files)
        return now;
    if (const JournalAction* last = findLastAction(graph_.actions[action], graph_, *journal))
        for (const auto& field : actions_->withCurrentHashes(graph_.actions[action], last->record))
            if (field.first.starts_with(kFound))
                now.push_back(field);
    return now;
}

Resolution Resolver::resolve(size_t index, const std::vector<std::string>& part_hashes)
{
    const Action& action = graph_.actions[index];
    if (cache_ == nullptr)
        return {std::nullopt, std::nullopt, {"no cache is used"}};
    ActionState state;
    Resolution resolved;
    resolved.record = actions_->makeRecord(action, part_hashes);
    state.is_forced = is_forced_;
    if (resolved.record && !is_forced_)
    {
        ActionCache::LookupResult found = actions_->find(action, *resolved.record);
        resolved.record = std::move(found.record);
        resolved.result = std::move(found.result);
        state.is_damaged = found.is_damaged;
    }
    if (resolved.result)
        return resolved;
    state.record = comparableRecord(index, resolved.record);
    resolved.causes = findCauses(action, graph_, state, journal_());
    return resolved;
}

std::vector<std::string> Resolver::causesAfter(size_t index, const std::vector<std::string>& cookers) const
{
    if (cache_ == nullptr)
        return {"no cache is used"};
    ActionState state;
    state.is_forced = is_forced_;
    state.pending_cookers = cookers;
    return findCauses(graph_.actions[index], graph_, state, journal_());
}

namespace
{

/// Return the cookers of the actions that an action waits for, of those that run.
std::vector<std::string> listPendingCookers(const Graph& graph, const Action& action,
                                            const Forecast& forecast)
{
    std::vector<std::string> cookers;
    const auto add = [&](size_t before)
    {
        if (before == kNoAction || !forecast.actions[before].runs)
            return;
        const std::string& cooker = graph.actions[before].cooker;
        if (std::find(cookers.begin(), cookers.end(), cooker) == cookers.end())
            cookers.push_back(cooker);
    };
    for (const Input& input : action.inputs)
        add(input.action);
    add(action.lister);
    return cookers;
}

} // namespace

Forecast forecast(Graph& graph, Resolver& resolver)
{
    Forecast forecast;
    OutputHashes hashes(graph.actions.size());
    for (size_t i = 0; i < graph.actions.size(); ++i)
    {
        const std::vector<std::string> pending = listPendingCookers(graph, graph.actions[i], forecast);
        if (!pending.empty())
        {
            forecast.actions.push_back({true, resolver.causesAfter(i, pending)});
            continue;
        }
        const auto part_hashes = findPartHashes(graph.actions[i], hashes);
        HEARTH_ASSERT(part_hashes.has_value()); // nothing before it runs
        Resolution resolved = resolver.resolve(i, *part_hashes);
        if (resolved.result && graph.actions[i].is_lister && !applyList(graph, i, resolved.result->list))
            resolved.result.reset();
        forecast.actions.push_back({!resolved.result, resolved.causes});
        if (resolved.result)
            hashes[i] = listHashes(*resolved.result);
        if (resolved.result && i + 1 == graph.actions.size())
            forecast.result = resolved.result->outputs.front();
    }
    return forecast;
}

} // namespace hearth::graph

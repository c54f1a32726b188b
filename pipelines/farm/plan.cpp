// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/farm/plan.h"

#include "pipelines/graph/cooker_version.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace hearth::farm
{

namespace
{

std::string cookerPath(const std::string& programs, const std::string& cooker)
{
    return programs + "/hearth-" + cooker;
}

/// True if the action belongs to one of the sources, or to all sources together where all are listed, or
/// lists what sources get.
bool isSelected(const graph::Graph& graph, const graph::Action& action, const std::vector<size_t>& sources)
{
    return action.is_lister || std::binary_search(sources.begin(), sources.end(), action.source) ||
           (action.source == graph.source_count && sources.size() == graph.source_count);
}

Status checkCooker(const Plan& plan, const graph::Action& action, const std::string& programs,
                   graph::FileHashes& hashes)
{
    const std::string program = cookerPath(programs, action.cooker);
    if (graph::cookerVersion(program, hashes) != plan.version_of_cooker.at(action.cooker))
        return Error{Issue::plan_build, program, "", "is not the build that the plan was made with"};
    if (action.depends_on_processor && plan.processor != graph::processorClass())
        return Error{
            Issue::plan_processor, program, "",
            fmt::format("this processor is of class {}, the plan's of class {}: rays would differ in "
                        "their last bits",
                        graph::processorClass(), plan.processor)};
    return success();
}

/// Check that the files which a cooker was known to find are unchanged.
Status checkFound(const graph::Action& action, const graph::Record& found, graph::ActionCache& actions)
{
    const graph::Record now = actions.withCurrentHashes(action, found);
    for (size_t field = 0; field < now.size(); ++field)
        if (now[field].second != found[field].second)
            return Error{Issue::plan_stale, action.subject, "",
                         now[field].first.substr(now[field].first.find('/') + 1) +
                             ", which it refers to, has changed since it was planned"};
    return success();
}

} // namespace

Result<Plan> makePlan(const Request& request, const std::string& folder, const ShardingOptions& sharding,
                      const std::string& programs, graph::ActionCache& actions, graph::FileHashes& hashes)
{
    Plan plan;
    plan.request = request;
    plan.folder = folder;
    HEARTH_ASSIGN_OR_RETURN(plan.settings, makeCookSettings(request));
    HEARTH_ASSIGN_OR_RETURN(plan.graph, graph::makeCookGraph(plan.settings));
    applyMeasurements(sharding.measured, request.sources, plan.graph);
    for (size_t i = 0; i < plan.graph.actions.size(); ++i)
    {
        const graph::Action& action = plan.graph.actions[i];
        const std::string program = cookerPath(programs, action.cooker);
        if (action.depends_on_processor)
            plan.processor = graph::processorClass();
        std::string& version = plan.version_of_cooker[action.cooker];
        if (version.empty())
            version = graph::cookerVersion(program, hashes);
        if (version.empty())
            return Error{Issue::plan_build, program, "", "is not there"};
        for (const graph::Input& input : action.inputs)
        {
            if (input.action != graph::kNoAction)
                continue;
            const auto hash = hashes.hashFile(input.path);
            if (!hash)
                return Error{Issue::input_missing, input.path, "", ""};
            plan.hash_of_file[input.path] = *hash;
        }
        if (!action.finds_files)
            continue;
        // the found files are known where this state of the source has been cooked before
        const auto record = actions.makeRecord(action, std::vector<std::string>(action.inputs.size()));
        if (!record)
            continue;
        for (const auto& field : actions.find(action, *record).record)
            if (field.first.starts_with(graph::kFound))
                plan.found_of_action[i].push_back(field);
    }
    const std::vector<double> seconds = estimateSourceTimes(plan.graph);
    plan.shards =
        distribute(seconds, sharding.shard_count ? *sharding.shard_count : chooseShardCount(seconds));
    return plan;
}

Status checkPlan(const Plan& plan, const std::vector<size_t>& sources, const std::string& programs,
                 graph::ActionCache& actions, graph::FileHashes& hashes)
{
    std::set<std::string> checked_cookers;
    for (size_t i = 0; i < plan.graph.actions.size(); ++i)
    {
        const graph::Action& action = plan.graph.actions[i];
        if (!isSelected(plan.graph, action, sources))
            continue;
        if (checked_cookers.insert(action.cooker).second)
            HEARTH_TRY(checkCooker(plan, action, programs, hashes));
        for (const graph::Input& input : action.inputs)
        {
            if (input.action != graph::kNoAction)
                continue;
            const auto hash = hashes.hashFile(input.path);
            if (!hash)
                return Error{Issue::input_missing, input.path, "", ""};
            if (*hash != plan.hash_of_file.at(input.path))
                return Error{Issue::plan_stale, input.path, "",
                             "its content has changed since it was planned"};
        }
        if (const auto found = plan.found_of_action.find(i); found != plan.found_of_action.end())
            HEARTH_TRY(checkFound(action, found->second, actions));
    }
    return success();
}

} // namespace hearth::farm

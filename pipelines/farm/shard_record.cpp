// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/farm/shard_record.h"

#include "cook/json/json.h"
#include "cook/tools/sha256.h"
#include "pipelines/graph/lists.h"
#include "pipelines/graph/skip_source.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <fmt/format.h>
#include <set>
#include <unistd.h>

namespace hearth::farm
{

namespace
{

constexpr const char* kSchema = "hearth.shard/1";
constexpr std::array<std::string_view, 5> kOutcomeNames{"unknown", "cooked", "kept", "failed", "left out"};

std::optional<uint64_t> wholeNumber(std::string_view text)
{
    uint64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

std::string milliseconds(double seconds)
{
    return fmt::format("{:.0f}", seconds * 1e3);
}

/// Read one field of an action; false where the field is invalid.
bool readField(const std::string& name, const std::string& value, ShardAction& action)
{
    const std::optional<uint64_t> number = wholeNumber(value);
    if (name == "ending")
    {
        const auto ending = std::find(kOutcomeNames.begin(), kOutcomeNames.end(), value);
        if (ending == kOutcomeNames.end())
            return false;
        action.ending = static_cast<graph::Outcome>(ending - kOutcomeNames.begin());
        return true;
    }
    if (name == cache::kContentField)
    {
        action.result.outputs.push_back({value, 0});
        return tools::isSha256(value);
    }
    if (!number)
        return false;
    if (name == "bytes" && !action.result.outputs.empty())
        action.result.outputs.back().bytes = *number;
    else if (name == "milliseconds")
        action.result.seconds = static_cast<double>(*number) * 1e-3;
    else if (name == "peak_rss_bytes")
        action.result.peak_rss_bytes = *number;
    else
        return false;
    return true;
}

/// True if the cache has the content, intact.
bool isIntact(const std::string& hash, cache::Cache& cache, const std::string& scratch)
{
    const std::string path = scratch + "/content";
    const bool fetched = cache.fetch(hash, path, cache::FileAccess::read_only);
    ::unlink(path.c_str());
    return fetched;
}

bool areIntact(const graph::CachedResult& result, cache::Cache& cache, const std::string& scratch)
{
    return std::all_of(result.outputs.begin(), result.outputs.end(),
                       [&](const graph::CachedOutput& output)
                       { return isIntact(output.hash, cache, scratch); });
}

/// True if the record of an action has all its outputs.
bool hasAllOutputs(const ShardAction& recorded, const Plan& plan)
{
    return recorded.action < plan.graph.actions.size() &&
           recorded.result.outputs.size() == plan.graph.actions[recorded.action].outputs.size();
}

/// True if the record has all actions of the shard's step, each with all its outputs.
bool isComplete(const ShardRecord& record, const Plan& plan, size_t shard, Step step)
{
    const std::vector<size_t> actions = listActions(plan.graph, plan.shards[shard], step);
    return std::equal(record.actions.begin(), record.actions.end(), actions.begin(), actions.end(),
                      [&](const ShardAction& recorded, size_t action)
                      { return recorded.action == action && hasAllOutputs(recorded, plan); });
}

/// Remove sources whose inputs are missing from an action that writes a list.
/// hashes  of the outputs that are there
void skipMissingInputs(graph::Graph& graph, size_t lister, const graph::OutputHashes& hashes)
{
    std::set<size_t> sources;
    for (const graph::Input& input : graph.actions[lister].inputs)
        if (hashes[input.action].empty())
            sources.insert(graph.actions[input.action].source);
    for (const size_t source : sources)
        graph::skipSource(graph, source, {});
}

} // namespace

size_t countActions(const ShardRecord& record, graph::Outcome ending)
{
    return static_cast<size_t>(std::count_if(record.actions.begin(), record.actions.end(),
                                             [&](const ShardAction& action)
                                             { return action.ending == ending; }));
}

std::string recordKey(const std::string& plan_hash, size_t shard, Step step)
{
    return tools::computeSha256(
        fmt::format("{}\n{}\n{}\n", step == Step::prepare ? "prepared shard" : "shard", plan_hash, shard));
}

std::optional<ShardRecord> readRecord(const std::string& plan_hash, size_t shard, Step step,
                                      cache::Cache& cache)
{
    const std::optional<cache::Fields> fields = cache.entry(recordKey(plan_hash, shard, step));
    return fields ? parseRecord(*fields) : std::nullopt;
}

std::map<size_t, graph::CachedResult> readOtherResults(const Plan& plan, const std::string& plan_hash,
                                                       size_t shard, cache::Cache& cache)
{
    std::map<size_t, graph::CachedResult> results;
    for (size_t other = 0; other < plan.shards.size(); ++other)
    {
        if (other == shard || plan.shards[other].empty())
            continue;
        const std::optional<ShardRecord> record = readRecord(plan_hash, other, Step::prepare, cache);
        if (!record)
            continue;
        const std::vector<size_t> actions = listActions(plan.graph, plan.shards[other], Step::prepare);
        for (const ShardAction& recorded : record->actions)
            if (std::ranges::binary_search(actions, recorded.action) && hasAllOutputs(recorded, plan))
                results[recorded.action] = recorded.result;
    }
    return results;
}

cache::Fields recordFields(const ShardRecord& record)
{
    cache::Fields fields{{"schema", kSchema},
                         {"exit", std::to_string(record.exit_code)},
                         {"shard milliseconds", milliseconds(record.seconds)},
                         {"machine", record.machine}};
    for (const std::string& error : record.errors)
        fields.emplace_back("error", error);
    for (const ShardAction& action : record.actions)
    {
        fields.emplace_back("action", std::to_string(action.action));
        fields.emplace_back("ending", kOutcomeNames[static_cast<size_t>(action.ending)]);
        fields.emplace_back("milliseconds", milliseconds(action.result.seconds));
        fields.emplace_back("peak_rss_bytes", std::to_string(action.result.peak_rss_bytes));
        for (const graph::CachedOutput& output : action.result.outputs)
        {
            fields.emplace_back(cache::kContentField, output.hash);
            fields.emplace_back("bytes", std::to_string(output.bytes));
        }
    }
    return fields;
}

std::optional<ShardRecord> parseRecord(const cache::Fields& fields)
{
    if (cache::fieldValue(fields, "schema") != kSchema)
        return std::nullopt;
    ShardRecord record;
    for (const auto& [name, value] : fields)
    {
        if (name == "schema")
            continue;
        const std::optional<uint64_t> number = wholeNumber(value);
        if (name == "machine")
            record.machine = value;
        else if (name == "error")
            record.errors.push_back(value);
        else if (name == "exit" && number && *number < 256)
            record.exit_code = static_cast<int>(*number);
        else if (name == "shard milliseconds" && number)
            record.seconds = static_cast<double>(*number) * 1e-3;
        else if (name == "action" && number)
            record.actions.emplace_back().action = *number;
        else if (record.actions.empty() || !readField(name, value, record.actions.back()))
            return std::nullopt;
    }
    return record;
}

std::string recordJson(const ShardRecord& record, const Plan& plan, size_t shard)
{
    Json json{{"schema", kSchema},
              {"shard", shard},
              {"shards", plan.shards.size()},
              {"exit", record.exit_code},
              {"machine", record.machine},
              {"seconds", record.seconds},
              {"errors", record.errors},
              {"actions", Json::array()}};
    for (const ShardAction& recorded : record.actions)
    {
        const graph::Action& action = plan.graph.actions[recorded.action];
        Json outputs = Json::object();
        for (size_t i = 0; i < recorded.result.outputs.size(); ++i)
            outputs[action.outputs[i]] = {{"sha256", recorded.result.outputs[i].hash},
                                          {"bytes", recorded.result.outputs[i].bytes}};
        json["actions"].push_back({{"cooker", action.cooker},
                                   {"subject", action.subject},
                                   {"state", kOutcomeNames[static_cast<size_t>(recorded.ending)]},
                                   {"seconds", recorded.result.seconds},
                                   {"peak_rss", recorded.result.peak_rss_bytes},
                                   {"outputs", outputs}});
    }
    return json.dump(1) + "\n";
}

ShardState verifyShard(const Plan& plan, const std::string& plan_hash, size_t shard, Step step,
                       cache::Cache& cache, const std::string& scratch)
{
    const std::optional<ShardRecord> record = readRecord(plan_hash, shard, step, cache);
    if (!record)
        return {};
    ShardState state{ShardState::Kind::failed, *record};
    if (record->exit_code != 0)
        return state;
    const bool is_whole =
        isComplete(*record, plan, shard, step) &&
        std::all_of(record->actions.begin(), record->actions.end(),
                    [&](const ShardAction& action) { return areIntact(action.result, cache, scratch); });
    state.kind = is_whole ? ShardState::Kind::intact : ShardState::Kind::lost;
    return state;
}

std::vector<size_t> missingResults(graph::Graph graph, cache::Cache& cache, graph::ActionCache& actions,
                                   const std::string& scratch)
{
    std::vector<size_t> missing;
    graph::OutputHashes hashes(graph.actions.size());
    for (size_t i = 0; i < graph.actions.size(); ++i)
    {
        const bool is_lister = graph.actions[i].is_lister;
        if (graph.actions[i].source == graph.source_count && !is_lister)
            continue;
        if (is_lister)
            skipMissingInputs(graph, i, hashes);
        const graph::Action& action = graph.actions[i];
        const size_t lister = action.lister;
        const bool waits = lister != graph::kNoAction && hashes[lister].empty();
        const auto part_hashes = waits ? std::nullopt : graph::findPartHashes(action, hashes);
        const auto record = part_hashes ? actions.makeRecord(action, *part_hashes) : std::nullopt;
        const auto result = record ? actions.find(action, *record).result : std::nullopt;
        const bool is_there = result && areIntact(*result, cache, scratch) &&
                              (!is_lister || graph::applyList(graph, i, result->list));
        if (is_there)
            hashes[i] = graph::listHashes(*result);
        else if (!is_lister)
            missing.push_back(i);
    }
    return missing;
}

} // namespace hearth::farm

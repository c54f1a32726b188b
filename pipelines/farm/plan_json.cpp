// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/graph/plan_json.h"
#include "cook/json/json.h"
#include "cook/tools/sha256.h"
#include "pipelines/farm/plan.h"

#include <algorithm>
#include <set>

namespace hearth::farm
{

namespace
{

Json foundJson(const Plan& plan)
{
    Json list = Json::array();
    for (const auto& [action, found] : plan.found_of_action)
    {
        Json files = Json::object();
        for (const auto& [name, hash] : found)
            files[name.substr(graph::kFound.size())] = hash;
        list.push_back({{"action", action}, {"files", files}});
    }
    return list;
}

/// Read the members of a plan beside its graph.
void readMembers(const Json& json, Plan& plan)
{
    const Json& cook = json.at("cook");
    cook.at("sources").get_to(plan.request.sources);
    cook.at("lods").get_to(plan.request.lods_of_source);
    cook.at("settings").get_to(plan.request.settings_of_source);
    cook.at("pack").get_to(plan.request.settings_of_pack);
    json.at("folder").get_to(plan.folder);
    plan.processor = json.value("processor", "");
    json.at("cookers").get_to(plan.version_of_cooker);
    json.at("files").get_to(plan.hash_of_file);
    json.at("shards").get_to(plan.shards);
    for (const Json& found : json.at("found"))
        for (const auto& [name, hash] : found.at("files").items())
            plan.found_of_action[found.at("action").get<size_t>()].emplace_back(
                std::string(graph::kFound) + name, hash.get<std::string>());
}

/// Read the estimates. Throws, as readMembers does, where a member is missing or of another type.
void readEstimates(const Json& actions, graph::Graph& graph)
{
    for (size_t i = 0; i < graph.actions.size(); ++i)
    {
        const Json& estimate = actions.at(i).at("estimate");
        estimate.at("memory_bytes").get_to(graph.actions[i].estimate.memory_bytes);
        estimate.at("seconds").get_to(graph.actions[i].estimate.seconds);
    }
}

/// Return the JSON pointer of a value that is not allowed; empty where all are allowed.
std::string findInvalidMember(const Plan& plan)
{
    const auto isPath = [](const std::string& path)
    // a cooker would take it for an option
    { return !path.empty() && path[0] != '-'; };
    const auto areHashes = [](const std::map<std::string, std::string>& hashes)
    {
        return std::all_of(hashes.begin(), hashes.end(),
                           [](const auto& field) { return tools::isSha256(field.second); });
    };
    if (!plan.folder.starts_with('/'))
        return "/folder";
    std::set<std::string> files;
    std::set<std::string> cookers;
    bool needs_processor = false;
    for (const graph::Action& action : plan.graph.actions)
    {
        cookers.insert(action.cooker);
        needs_processor = needs_processor || action.depends_on_processor;
        if (action.estimate.memory_bytes > kMaxBytes || !(action.estimate.seconds >= 0) ||
            action.estimate.seconds > kMaxSeconds)
            return "/actions";
        for (const graph::Input& input : action.inputs)
            if (input.action == graph::kNoAction)
            {
                files.insert(input.path);
                if (!isPath(input.path))
                    return "/cook";
            }
    }
    const auto areKeys = [](const std::map<std::string, std::string>& map, const std::set<std::string>& keys)
    {
        return std::equal(map.begin(), map.end(), keys.begin(), keys.end(),
                          [](const auto& field, const std::string& key) { return field.first == key; });
    };
    if (!areKeys(plan.version_of_cooker, cookers) || !areHashes(plan.version_of_cooker))
        return "/cookers";
    if (!areKeys(plan.hash_of_file, files) || !areHashes(plan.hash_of_file))
        return "/files";
    if (needs_processor == plan.processor.empty())
        return "/processor";
    for (const auto& [action, found] : plan.found_of_action)
        if (action >= plan.graph.actions.size() || !plan.graph.actions[action].finds_files)
            return "/found";
    return "";
}

/// True if each source is in exactly one shard, in ascending order.
bool areShardsValid(const Shards& shards, size_t source_count)
{
    std::vector<size_t> sources;
    for (const std::vector<size_t>& shard : shards)
    {
        if (!std::is_sorted(shard.begin(), shard.end()))
            return false;
        sources.insert(sources.end(), shard.begin(), shard.end());
    }
    std::sort(sources.begin(), sources.end());
    for (size_t i = 0; i < sources.size(); ++i)
        if (sources[i] != i)
            return false;
    return sources.size() == source_count && !shards.empty() && shards.size() <= kMaxShards;
}

std::map<std::string_view, const Json*> membersByKey(const Json& object)
{
    std::map<std::string_view, const Json*> members;
    for (const auto& [key, value] : object.items())
        members[key] = &value;
    return members;
}

std::optional<std::string> firstDifference(const Json& a, const Json& b, const std::string& place);

std::optional<std::string> firstDifferenceOfArrays(const Json& a, const Json& b, const std::string& place)
{
    for (size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        if (auto difference = firstDifference(a[i], b[i], place + "/" + std::to_string(i)))
            return difference;
    if (a.size() == b.size())
        return std::nullopt;
    // "-" is the JSON pointer of the element after the last one
    return place + "/" + (a.size() < b.size() ? "-" : std::to_string(a.size() - 1));
}

std::optional<std::string> firstDifferenceOfObjects(const Json& a, const Json& b, const std::string& place)
{
    const auto members_of_a = membersByKey(a), members_of_b = membersByKey(b);
    for (const auto& [key, value] : members_of_a)
    {
        const auto other = members_of_b.find(key);
        if (other == members_of_b.end())
            return place + pointerStep(key);
        if (auto difference = firstDifference(*value, *other->second, place + pointerStep(key)))
            return difference;
    }
    for (const auto& [key, value] : members_of_b)
        if (!members_of_a.contains(key))
            return place + pointerStep(key);
    return std::nullopt;
}

/// Return the JSON pointer of the first difference between two documents, ignoring the order of members;
/// nullopt where they are equal.
std::optional<std::string> firstDifference(const Json& a, const Json& b, const std::string& place)
{
    if (a.is_array() && b.is_array())
        return firstDifferenceOfArrays(a, b, place);
    if (a.is_object() && b.is_object())
        return firstDifferenceOfObjects(a, b, place);
    return a == b ? std::nullopt : std::optional(place);
}

} // namespace

std::string planText(const Plan& plan)
{
    Json json = Json::parse(graph::planJson(plan.graph)).value();
    json["cook"] = {{"sources", plan.request.sources},
                    {"lods", plan.request.lods_of_source},
                    {"settings", plan.request.settings_of_source},
                    {"pack", plan.request.settings_of_pack}};
    json["folder"] = plan.folder;
    if (!plan.processor.empty())
        json["processor"] = plan.processor;
    json["cookers"] = plan.version_of_cooker;
    json["files"] = plan.hash_of_file;
    json["found"] = foundJson(plan);
    json["shards"] = plan.shards;
    return json.dump(1) + "\n";
}

Result<Plan> parsePlan(std::string_view text, const std::string& file)
{
    const auto wrong = [&](const std::string& where, const std::string& what) {
        return Error{Issue::plan_syntax, file, where, what};
    };
    // C strings would end there
    if (text.find("\\u0000") != std::string_view::npos)
        return wrong("", "has a text with a zero in it");
    const std::optional<Json> parsed = Json::parse(text);
    if (!parsed)
        return Error{Issue::json_syntax, file, "", ""};
    const Json& json = *parsed;
    if (json.is_object() && json.contains("actions") && !json.contains("shards"))
        return wrong("", "has no shards: it shows a cook, and is none to be run");
    Plan plan;
    // the JSON reader throws where a member is missing or of another type; its message does not help users
    try
    {
        readMembers(json, plan);
    }
    catch (const JsonError&)
    {
        return wrong("", "a member is missing, or of another type");
    }
    const Result<graph::CookSettings> settings = makeCookSettings(plan.request);
    if (!settings.ok())
        return wrong("/cook", settings.error().detail);
    plan.settings = *settings;
    Result<graph::Graph> graph = graph::makeCookGraph(plan.settings);
    if (!graph.ok())
        return wrong("/cook", graph.error().detail);
    plan.graph = std::move(graph).value();
    try
    {
        readEstimates(json.at("actions"), plan.graph);
    }
    catch (const JsonError&)
    {
        return wrong("/actions", "are not those that the cook would have");
    }
    if (const std::string place = findInvalidMember(plan); !place.empty())
        return wrong(place, "has a value that is not allowed");
    if (!areShardsValid(plan.shards, plan.graph.source_count))
        return wrong("/shards", "do not have each source once");
    // serializing the parsed plan must give the same document: nothing was ignored
    if (const auto place = firstDifference(Json::parse(planText(plan)).value(), json, ""))
        return wrong(*place,
                     "is not what the cook would have there: it was edited, or made by another version");
    return plan;
}

} // namespace hearth::farm

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/report/cook_report.h"

#include "cook/json/json.h"
#include "formats/records/chunk_list.h"
#include "pipelines/graph/message.h"
#include "pipelines/report/base64.h"

#include <algorithm>

namespace hearth::report
{

using graph::Action;
using graph::ActionOutcome;
using graph::Outcome;

namespace
{

const char* stateName(Outcome ending)
{
    switch (ending)
    {
    case Outcome::cooked:
        return "cooked";
    case Outcome::cached:
        return "cached";
    case Outcome::failed:
        return "failed";
    case Outcome::skipped:
        return "dependency failed";
    case Outcome::unknown:
        break;
    }
    return "not cooked";
}

bool hasResult(Outcome ending)
{
    return ending == Outcome::cooked || ending == Outcome::cached;
}

Json messageJson(const std::string& line)
{
    const graph::Message message = graph::parseMessage(line);
    Json json{{"code", message.code}, {"severity", message.severity}, {"text", message.text}};
    if (!message.file.empty())
        json["file"] = message.file;
    if (!message.pointer.empty())
        json["pointer"] = message.pointer;
    if (!message.hint.empty())
        json["hint"] = message.hint;
    return json;
}

Json stageJson(const CookReport& cook, size_t index)
{
    const ActionOutcome& outcome = cook.outcomes[index];
    const graph::CachedResult& result = outcome.result;
    Json json{{"stage", cook.graph->actions[index].cooker}, {"state", stateName(outcome.ending)}};
    if (outcome.ending == Outcome::cached)
        json["cached"] = true;
    if (!outcome.record.empty())
        json["key"] = graph::resultKey(outcome.record);
    if (hasResult(outcome.ending))
    {
        if (!result.outputs.front().hash.empty())
            json["sha256"] = result.outputs.front().hash;
        json["bytes"] = result.outputs.front().bytes;
    }
    if (hasResult(outcome.ending) || outcome.ending == Outcome::failed)
        json.update({{"seconds", result.seconds},
                     {"cpu_seconds", result.cpu_seconds},
                     {"peak_rss_bytes", result.peak_rss_bytes}});
    if (const auto time = cook.times.find(index); time != cook.times.end())
    {
        json["start_s"] = time->second.start_seconds;
        json["lane"] = time->second.lane;
        json["why"] = outcome.causes;
    }
    if (const auto error = cook.errors.find(index); error != cook.errors.end())
        json["error"] = messageJson(error->second);
    return json;
}

/// Return the statistics that a cooker wrote beside its part; null where there are none.
Json parseStatistics(const CookReport& cook, size_t index)
{
    const auto text = cook.statistics.find(index);
    Json json = text == cook.statistics.end() ? Json() : Json::parse(text->second).value_or(Json());
    return json.is_object() ? json : Json();
}

/// Return a list of an object, or an empty one.
Json listMember(const Json& object, const char* key)
{
    const Json* list = object.find(key);
    return list != nullptr && list->is_array() ? *list : Json::array();
}

uint64_t getNumber(const Json& object, const char* key)
{
    const Json* number = object.find(key);
    return number != nullptr && number->is_number_unsigned() ? number->get<uint64_t>() : 0;
}

/// Actions of a source.
struct Asset
{
    size_t source = 0;
    std::vector<size_t> actions;
};

std::vector<Asset> makeAssets(const CookReport& cook)
{
    std::vector<Asset> assets(cook.sources.size());
    for (size_t i = 0; i < assets.size(); ++i)
        assets[i].source = i;
    for (size_t i = 0; cook.graph != nullptr && i < cook.graph->actions.size(); ++i)
        if (const size_t source = cook.graph->actions[i].source; source < assets.size())
            assets[source].actions.push_back(i);
    return assets;
}

const char* stateName(const CookReport& cook, const Asset& asset)
{
    const auto any = [&](Outcome ending)
    {
        return std::any_of(asset.actions.begin(), asset.actions.end(),
                           [&](size_t action) { return cook.outcomes[action].ending == ending; });
    };
    for (const Outcome ending : {Outcome::failed, Outcome::skipped, Outcome::unknown, Outcome::cooked})
        if (any(ending))
            return stateName(ending);
    return asset.actions.empty() ? "not cooked" : "cached";
}

/// Return the files that the import read besides the source, under the names that the source uses, and the
/// files that it missed.
Json dependenciesJson(const CookReport& cook, const Asset& asset, const Json& import_report)
{
    Json dependencies = Json::array();
    const Json files = listMember(import_report, "sources");
    for (size_t i = 1; i < files.size(); ++i)
        dependencies.push_back(files[i]);
    for (const size_t action : asset.actions)
        for (const auto& [name, value] : cook.outcomes[action].record)
            if (name.starts_with(graph::kFound) && value == graph::kAbsent)
                dependencies.push_back({{"name", name.substr(name.find('/') + 1)}, {"missing", true}});
    return dependencies;
}

/// Return the messages about an asset. The import's warnings are taken from its report, which has them
/// already split into members.
Json messagesJson(const CookReport& cook, const Asset& asset, const Json& import_report)
{
    Json messages = listMember(import_report, "messages");
    for (const size_t action : asset.actions)
        if (cook.graph->actions[action].cooker != "import" || import_report.is_null())
            for (const std::string& line : cook.outcomes[action].result.warnings)
                messages.push_back(messageJson(line));
    if (const auto warning = cook.source_warnings.find(asset.source); warning != cook.source_warnings.end())
        messages.push_back(messageJson(warning->second));
    for (const size_t action : asset.actions)
        if (const auto error = cook.errors.find(action); error != cook.errors.end())
            messages.push_back(messageJson(error->second));
    return messages;
}

std::string pngUri(const std::string& png)
{
    return "data:image/png;base64," + base64(png);
}

Json visibilityJson(const CookReport& cook, size_t action)
{
    Json json = parseStatistics(cook, action);
    if (json.is_null())
        return json;
    json.erase("source");
    if (const auto image = cook.images.find(action); image != cook.images.end())
        json["image"] = pngUri(image->second);
    return json;
}

uint64_t sumMember(const Json& list, const char* group, const char* key)
{
    uint64_t sum = 0;
    for (const Json& item : list)
        sum += getNumber(group == nullptr ? item : item.value(group, Json::object()), key);
    return sum;
}

/// Return the textures of a source as they are in the pack.
/// textures, texels  statistics of their mips, and of their encoding, if they were encoded
Json texturesJson(Json textures, const Json& texels)
{
    for (size_t i = 0; i < textures.size() && i < texels.size(); ++i)
    {
        const Json& encoded = texels[i];
        for (const char* key : {"format", "bytes", "bytes_stored"})
            textures[i][key] = encoded[key];
        for (const char* key : {"role", "error", "error_p999", "error_smooth", "coverage_error", "target",
                                "target_smooth", "holds_target", "reason", "estimates", "picture"})
            if (encoded.contains(key))
                textures[i]["encoding"][key] = encoded[key];
    }
    return textures;
}

/// Return the proxies of a source: those that hearth-proxy wrote, or else of the import. Names of meshes
/// are those of the clusters.
Json proxiesJson(const Json& import_report, const Json& proxy_report, const Json& clusters)
{
    Json rows = Json::array();
    const Json meshes = listMember(clusters, "meshes");
    for (const Json& proxy :
         proxy_report.is_null() ? listMember(import_report, "proxies") : listMember(proxy_report, "meshes"))
    {
        if (proxy.value("triangles", 0) == 0)
            continue;
        Json row = Json::object();
        for (const char* key :
             {"mesh", "origin", "triangles", "vertices", "closed", "distance", "mesh_distance", "bytes"})
            row[key] = proxy.value(key, Json());
        const auto mesh = proxy.value("mesh", size_t{0});
        row["name"] = mesh < meshes.size() ? meshes[mesh].value("name", "") : "";
        rows.push_back(std::move(row));
    }
    return rows;
}

Json assetJson(const CookReport& cook, const Asset& asset)
{
    Json json{{"source", cook.sources[asset.source]}, {"state", stateName(cook, asset)}};
    const auto findAction = [&](const char* cooker)
    {
        const auto found =
            std::find_if(asset.actions.begin(), asset.actions.end(),
                         [&](size_t action) { return cook.graph->actions[action].cooker == cooker; });
        return found == asset.actions.end() ? graph::kNoAction : *found;
    };
    const size_t import_action = findAction("import");
    const Json import_report = parseStatistics(cook, import_action);
    if (import_action != graph::kNoAction)
    {
        const graph::Record& record = cook.outcomes[import_action].record;
        if (!record.empty())
        {
            json["key"] = graph::resultKey(record);
            // the hash, a space, and the name
            const std::string_view source = cache::fieldValue(record, "input source");
            json["sha256"] = source.substr(0, source.find(' '));
        }
    }
    double seconds = 0;
    double cpu_seconds = 0;
    uint64_t peak = 0;
    Json why = Json::array();
    Json stages = Json::array();
    for (const size_t action : asset.actions)
    {
        stages.push_back(stageJson(cook, action));
        const ActionOutcome& outcome = cook.outcomes[action];
        if (!cook.times.contains(action))
            continue;
        seconds += outcome.result.seconds;
        cpu_seconds += outcome.result.cpu_seconds;
        peak = std::max(peak, outcome.result.peak_rss_bytes);
        for (const std::string& cause : outcome.causes)
            if (std::find(why.begin(), why.end(), cause) == why.end())
                why.push_back(cause);
    }
    json.update({{"seconds", seconds}, {"cpu_seconds", cpu_seconds}, {"peak_rss_bytes", peak}});
    json["bytes_in"] = sumMember(listMember(import_report, "sources"), nullptr, "bytes");
    json["why"] = why;
    json["deps"] = dependenciesJson(cook, asset, import_report);
    json["stages"] = stages;

    const Json clusters = parseStatistics(cook, findAction("clusters"));
    const Json textures = texturesJson(listMember(parseStatistics(cook, findAction("textures")), "images"),
                                       listMember(parseStatistics(cook, findAction("texels")), "images"));
    json["sizes"] = {{"geometry", sumMember(listMember(clusters, "meshes"), "bytes", "pages_stored")},
                     {"textures", sumMember(textures, nullptr, "bytes_stored")}};
    if (import_report.contains("counts"))
        json["counts"] = import_report["counts"];
    if (!clusters.is_null())
        json["clusters"] = {{"meshes", listMember(clusters, "meshes")},
                            {"totals", clusters.value("totals", Json::object())}};
    if (Json proxies = proxiesJson(import_report, parseStatistics(cook, findAction("proxy")), clusters);
        !proxies.empty())
        json["proxies"] = std::move(proxies);
    json["textures"] = textures;
    if (const auto sheet = cook.images.find(findAction("texels")); sheet != cook.images.end())
        json["texture_pictures"] = pngUri(sheet->second);
    if (const size_t action = findAction("visibility"); action != graph::kNoAction)
        json["visibility"] = visibilityJson(cook, action);
    json["messages"] = messagesJson(cook, asset, import_report);
    json["dropped"] = listMember(import_report, "dropped");
    return json;
}

/// Return the failures, each with the actions that could not run because of it.
Json failuresJson(const CookReport& cook)
{
    Json failures = Json::array();
    for (const auto& [index, line] : cook.errors)
    {
        const Action& action = cook.graph->actions[index];
        Json failure{{"subject", action.subject}, {"stage", action.cooker}};
        failure.update(messageJson(line));
        failure["not_made"] = Json::array();
        // actions come after the actions that they read from
        std::vector<bool> depends(cook.graph->actions.size(), false);
        depends[index] = true;
        for (size_t i = index + 1; i < depends.size(); ++i)
            for (const graph::Input& input : cook.graph->actions[i].inputs)
                if (input.action != graph::kNoAction && depends[input.action] && !depends[i])
                {
                    depends[i] = true;
                    const Action& dependent = cook.graph->actions[i];
                    failure["not_made"].push_back(
                        {{"subject", dependent.subject}, {"stage", dependent.cooker}});
                }
        failures.push_back(failure);
    }
    if (failures.empty() && !cook.error.empty())
    {
        Json failure{{"subject", cook.output}, {"stage", "cook"}};
        failure.update(messageJson(cook.error));
        failure["not_made"] = Json::array();
        failures.push_back(failure);
    }
    return failures;
}

const char* purposeName(formats::ChunkPurpose purpose)
{
    using formats::ChunkPurpose;
    switch (purpose)
    {
    case ChunkPurpose::geometry:
        return "geometry";
    case ChunkPurpose::textures:
        return "textures";
    case ChunkPurpose::animation:
        return "animation";
    case ChunkPurpose::light:
        return "light";
    case ChunkPurpose::scene:
        return "scene";
    case ChunkPurpose::other:
        break;
    }
    return "other";
}

/// Return the bytes of the pack by purpose.
Json sizesJson(const std::map<uint32_t, uint64_t>& bytes_of_chunks)
{
    Json sizes{{"geometry", 0}, {"textures", 0}, {"animation", 0}, {"light", 0}, {"scene", 0}, {"other", 0}};
    for (const auto& [type, bytes] : bytes_of_chunks)
    {
        const formats::ChunkInfo* info = formats::chunkInfo(type);
        Json& size = sizes[purposeName(info == nullptr ? formats::ChunkPurpose::other : info->purpose)];
        size = size.get<uint64_t>() + bytes;
    }
    return sizes;
}

Json totalsJson(const CookReport& cook, const Json& assets)
{
    std::map<std::string, uint64_t> assets_of_state;
    for (const Json& asset : assets)
        ++assets_of_state[asset["state"].get<std::string>()];
    Json actions{{"cooked", 0}, {"cached", 0}, {"failed", 0}, {"dependency failed", 0}, {"not cooked", 0}};
    double cpu_seconds = 0;
    uint64_t peak = 0;
    for (size_t i = 0; i < cook.outcomes.size(); ++i)
    {
        const ActionOutcome& outcome = cook.outcomes[i];
        Json& count = actions[stateName(outcome.ending)];
        count = count.get<uint64_t>() + 1;
        if (!cook.times.contains(i))
            continue;
        cpu_seconds += outcome.result.cpu_seconds;
        peak = std::max(peak, outcome.result.peak_rss_bytes);
    }
    Json totals{{"assets", cook.sources.size()},
                {"cooked", assets_of_state["cooked"]},
                {"cached", assets_of_state["cached"]},
                {"failed", assets_of_state["failed"]},
                {"wall_s", cook.seconds},
                {"cpu_s", cpu_seconds},
                {"peak_rss", peak},
                {"bytes_in", sumMember(assets, nullptr, "bytes_in")},
                {"bytes_out", cook.output_bytes},
                {"actions", actions}};
    if (!cook.bytes_of_chunks.empty())
        totals["sizes"] = sizesJson(cook.bytes_of_chunks);
    return totals;
}

/// Join the lists of all assets into one; each item gets its source.
Json joinLists(const Json& assets, const char* key)
{
    Json all = Json::array();
    for (const Json& asset : assets)
        for (const Json& item : asset[key])
        {
            Json named{{"source", asset["source"]}};
            named.update(item.is_object() ? item : Json{{"text", item}});
            all.push_back(named);
        }
    return all;
}

} // namespace

std::string reportJson(const CookReport& cook)
{
    Json assets = Json::array();
    for (const Asset& asset : makeAssets(cook))
        assets.push_back(assetJson(cook, asset));
    Json report{{"schema", "hearth.report/1"},
                {"tool", {{"name", "hearth"}, {"version", HEARTH_VERSION}}},
                {"started", cook.started},
                {"status", !cook.has_pack         ? "failed"
                           : cook.skipped.empty() ? "ok"
                                                  : "incomplete"},
                {"exit", cook.exit_code},
                {"output", cook.output},
                {"up_to_date", cook.is_up_to_date},
                {"totals", totalsJson(cook, assets)},
                {"skipped", Json::array()},
                {"failures", failuresJson(cook)},
                {"messages", joinLists(assets, "messages")},
                {"dropped", joinLists(assets, "dropped")}};
    for (const size_t source : cook.skipped)
        report["skipped"].push_back(cook.sources[source]);
    for (size_t i = 0; i < cook.outcomes.size(); ++i)
        if (const Action& action = cook.graph->actions[i]; action.source >= cook.sources.size())
        {
            report[action.cooker] = stageJson(cook, i);
            const Json statistics = parseStatistics(cook, i);
            if (action.cooker == "bricks" && !statistics.is_null())
                report["bricks"]["grid"] = statistics;
            if (action.cooker == "receivers" && !statistics.is_null())
                report["receivers"]["atlas"] = statistics;
            if (action.cooker == "budget" && !statistics.is_null())
                report["budget"]["share"] = statistics;
        }
    if (!cook.error.empty())
        report["error"] = cook.error;
    report["assets"] = std::move(assets);
    return report.dump(1) + "\n";
}

} // namespace hearth::report

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cook.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace hearth::command
{

using Json = nlohmann::ordered_json;

namespace
{

Json stageJson(const StageRecord& stage)
{
    Json json{{"stage", stage.stage},
              {"seconds", stage.seconds},
              {"cpu_seconds", stage.cpu_seconds},
              {"peak_rss_bytes", stage.peak_rss_bytes},
              {"bytes", stage.output_bytes}};
    if (stage.cached)
        json["cached"] = true;
    return json;
}

/// What hearth-clusters wrote of a source, without what the report says anyway.
Json clustersJson(const std::string& statistics)
{
    const Json json = Json::parse(statistics, nullptr, false);
    if (!json.is_object())
        return nullptr;
    return {{"meshes", json.value("meshes", Json::array())},
            {"totals", json.value("totals", Json::object())}};
}

std::string base64(std::string_view bytes)
{
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3)
    {
        uint32_t bits = 0;
        for (size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (i + k < bytes.size() ? static_cast<uint8_t>(bytes[i + k]) : 0u);
        for (size_t k = 0; k < 4; ++k)
            text += i + k <= bytes.size() ? kDigits[bits >> (18 - 6 * k) & 63u] : '=';
    }
    return text;
}

/// What hearth-visibility wrote of a source, and its picture, which a browser shows as it stands there.
Json visibilityJson(const VisibilityReport& visibility)
{
    Json json = Json::parse(visibility.statistics, nullptr, false);
    if (!json.is_object())
        return nullptr;
    json.erase("source");
    if (!visibility.picture.empty())
        json["picture"] = "data:image/png;base64," + base64(visibility.picture);
    return json;
}

Json assetJson(const CookOptions& options, const CookOutcome& outcome, size_t source)
{
    const bool failed =
        outcome.exit_code != 0 &&
        std::any_of(outcome.failed_sources.begin(), outcome.failed_sources.end(),
                    [&](size_t index) { return index == source || index == options.sources.size(); });
    const char* state = outcome.exit_code == 0 ? "cooked" : failed ? "failed" : "not cooked";
    Json asset{{"source", options.sources[source]}, {"state", state}, {"stages", Json::array()}};
    for (const StageRecord& stage : outcome.stages)
        if (stage.source == source)
            asset["stages"].push_back(stageJson(stage));
    if (source < outcome.cluster_statistics.size())
        asset["clusters"] = clustersJson(outcome.cluster_statistics[source]);
    if (source < outcome.visibility.size() && !outcome.visibility[source].statistics.empty())
        asset["visibility"] = visibilityJson(outcome.visibility[source]);
    return asset;
}

/// A list of the pack's META, or an empty one.
Json listOf(const Json& meta, const char* key)
{
    return meta.is_object() && meta.contains(key) ? meta[key] : Json::array();
}

Json totalsJson(const CookOptions& options, const CookOutcome& outcome, const Json& sources)
{
    uint64_t bytes_in = 0;
    for (const Json& source : sources)
        if (source.is_object() && source.contains("bytes") && source["bytes"].is_number_unsigned())
            bytes_in += source["bytes"].get<uint64_t>();
    double cpu_seconds = 0;
    uint64_t peak_rss_bytes = 0;
    const auto cached = std::count_if(outcome.stages.begin(), outcome.stages.end(),
                                      [](const StageRecord& stage) { return stage.cached; });
    for (const StageRecord& stage : outcome.stages)
    {
        if (stage.cached)
            continue;
        cpu_seconds += stage.cpu_seconds;
        peak_rss_bytes = std::max(peak_rss_bytes, stage.peak_rss_bytes);
    }
    return {{"assets", options.sources.size()},
            {"wall_s", outcome.seconds},
            {"cpu_s", cpu_seconds},
            {"peak_rss", peak_rss_bytes},
            {"bytes_in", bytes_in},
            {"bytes_out", outcome.output_bytes},
            {"cached", cached}};
}

} // namespace

std::string reportJson(const CookOptions& options, const CookOutcome& outcome, std::string_view meta_text)
{
    const Json meta = Json::parse(meta_text, nullptr, false);
    const Json sources = listOf(meta, "sources");
    Json report{{"schema", "hearth.report/1"},
                {"tool", {{"name", "hearth"}, {"version", HEARTH_VERSION}}},
                {"status", outcome.exit_code == 0 ? "ok" : "failed"},
                {"exit", outcome.exit_code},
                {"output", options.output},
                {"totals", totalsJson(options, outcome, sources)},
                {"assets", Json::array()}};
    for (size_t i = 0; i < options.sources.size(); ++i)
        report["assets"].push_back(assetJson(options, outcome, i));
    for (const StageRecord& stage : outcome.stages)
        if (stage.source == options.sources.size())
            report[stage.stage] = stageJson(stage);
    if (const Json grid = Json::parse(outcome.brick_statistics, nullptr, false); grid.is_object())
        report["bricks"]["grid"] = grid;
    report["sources"] = sources;
    report["messages"] = listOf(meta, "messages");
    report["dropped"] = listOf(meta, "dropped");
    if (!outcome.error.empty())
        report["error"] = outcome.error;
    return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace hearth::command

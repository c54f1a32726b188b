// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/farm/measurements.h"

#include "cook/json/json.h"
#include "pipelines/cookers/registry.h"
#include "pipelines/farm/plan.h"

#include <algorithm>

namespace hearth::farm
{

namespace
{

// Memory needs change with the cooker's release and with the content of the source; the margin equals that of
// the estimates by file size.
constexpr double kMemoryMargin = 4.0 / 3;

/// Add the measurement of one stage. Throws where a member is missing or of another type.
/// returns  false where the time or memory is beyond any machine
bool addStage(const Json& stage, const std::string& source, Measurements& measured)
{
    const auto state = stage.at("state").get<std::string>();
    if (state != "cooked" && state != "cached")
        return true;
    const double bytes = stage.at("peak_rss_bytes").get<double>() * kMemoryMargin;
    const auto seconds = stage.at("seconds").get<double>();
    if (!(bytes >= 0) || bytes > static_cast<double>(kMaxBytes) || !(seconds >= 0) || seconds > kMaxSeconds)
        return false;
    measured[{source, stage.at("stage").get<std::string>()}] = {static_cast<uint64_t>(bytes), seconds};
    return true;
}

/// Add all stages of a report. Throws and returns as addStage does.
bool addStages(const Json& report, Measurements& measured)
{
    for (const Json& asset : report.at("assets"))
        for (const Json& stage : asset.at("stages"))
            if (!addStage(stage, asset.at("source").get<std::string>(), measured))
                return false;
    for (const cookers::Cooker& cooker : cookers::allCookers())
        if (cooker.scope == settings::Scope::pack && report.contains(cooker.name) &&
            !addStage(report[cooker.name], "", measured))
            return false;
    return true;
}

} // namespace

Result<Measurements> readMeasurements(std::string_view report, const std::string& file)
{
    const Json json = Json::parse(report).value_or(Json());
    if (!json.is_object() || json.value("schema", Json()) != "hearth.report/1")
        return Error{Issue::json_syntax, file, "", "is no report that hearth cook --report wrote as JSON"};
    Measurements measured;
    try
    {
        if (!addStages(json, measured))
            return Error{Issue::json_syntax, file, "", "has a time or memory that no machine has"};
    }
    catch (const JsonError& wrong)
    {
        return Error{Issue::json_syntax, file, "",
                     std::string("is no report of hearth cook: ") + wrong.what()};
    }
    return measured;
}

void applyMeasurements(const Measurements& measured, const std::vector<std::string>& sources,
                       graph::Graph& graph)
{
    for (graph::Action& action : graph.actions)
    {
        const bool is_of_all = action.source >= sources.size();
        const auto found = measured.find({is_of_all ? "" : sources[action.source], action.cooker});
        if (found != measured.end())
            action.estimate = found->second;
    }
}

size_t countMeasured(const Measurements& measured, const std::vector<std::string>& sources)
{
    const auto is_known = [&](const std::string& source)
    {
        const auto first = measured.lower_bound({source, ""});
        return first != measured.end() && first->first.first == source;
    };
    return static_cast<size_t>(std::count_if(sources.begin(), sources.end(), is_known));
}

} // namespace hearth::farm

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/farm/request.h"

#include "pipelines/cookers/registry.h"
#include "pipelines/profiles/assignment.h"

namespace hearth::farm
{

namespace
{

/// Return the texts of a setting that a cooker gets as separate words.
std::vector<std::string> textWords(const std::pair<std::string, settings::Value>& setting)
{
    const settings::Kind kind = settings::findSetting(cookers::profileSettings(), setting.first)->kind;
    const bool has_texts = kind == settings::Kind::text || kind == settings::Kind::texts;
    return has_texts ? settings::valueTexts(setting.second) : std::vector<std::string>();
}

Result<settings::Values> parseAssignments(const Assignments& assignments)
{
    settings::Values values;
    for (const std::string& assignment : assignments)
    {
        HEARTH_ASSIGN_OR_RETURN(auto parsed, profiles::parseAssignment(assignment));
        for (const std::string& word : textWords(parsed))
            if (word.starts_with('-'))
                return Error{Issue::usage, assignment, "", "looks like an option"};
        if (!values.insert(std::move(parsed)).second)
            return Error{Issue::usage, assignment, "", "is set twice"};
    }
    return values;
}

} // namespace

Result<graph::CookSettings> makeCookSettings(const Request& request)
{
    if (request.sources.empty())
        return Error{Issue::usage, "hearth", "", "there are no sources"};
    if (request.settings_of_source.size() != request.sources.size() ||
        request.lods_of_source.size() != request.sources.size())
        return Error{Issue::usage, "hearth", "", "each source needs its settings and its levels of detail"};
    graph::CookSettings settings;
    settings.sources = request.sources;
    settings.lods_of_source = request.lods_of_source;
    settings.output = kPackName;
    for (const Assignments& assignments : request.settings_of_source)
    {
        HEARTH_ASSIGN_OR_RETURN(settings::Values values, parseAssignments(assignments));
        HEARTH_TRY(cookers::checkSourceSettings(values));
        settings.values_of_source.push_back(std::move(values));
    }
    HEARTH_ASSIGN_OR_RETURN(settings.values_of_pack, parseAssignments(request.settings_of_pack));
    return settings;
}

} // namespace hearth::farm

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/shell/config_schema.h"

#include "cook/json/json.h"
#include "pipelines/cookers/registry.h"
#include "pipelines/profiles/command_settings.h"

#include <cmath>

namespace hearth::command
{

namespace
{

using settings::Kind;
using settings::Scope;
using settings::Setting;

Json settingSchema(const Setting& setting);

Json objectSchema(Json properties)
{
    return {{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
}

Json tableSchema(const std::vector<Setting>& members)
{
    Json properties = Json::object();
    Json required = Json::array();
    for (const Setting& member : members)
    {
        properties[member.key] = settingSchema(member);
        if (member.is_required)
            required.push_back(member.key);
    }
    Json table = objectSchema(std::move(properties));
    table["required"] = std::move(required);
    return table;
}

Json numberSchema(const Setting& setting)
{
    Json json{{"type", setting.kind == Kind::whole ? "integer" : "number"}};
    if (!setting.choices.empty())
        for (const std::string_view choice : setting.choices)
            json["enum"].push_back(std::stoi(std::string(choice)));
    else
        json[setting.is_above_low ? "exclusiveMinimum" : "minimum"] = setting.low;
    if (setting.choices.empty() && std::isfinite(setting.high))
        json["maximum"] = setting.high;
    return json;
}

Json typeSchema(const Setting& setting)
{
    const Json text{{"type", "string"}, {"minLength", 1}};
    switch (setting.kind)
    {
    case Kind::flag:
        return {{"type", "boolean"}};
    case Kind::whole:
    case Kind::number:
        return numberSchema(setting);
    case Kind::choice:
        return {{"enum", setting.choices}};
    case Kind::text:
        return text;
    case Kind::texts:
        return {{"oneOf", {text, {{"type", "array"}, {"items", text}}}}};
    case Kind::size:
        return {{"oneOf",
                 {{{"type", "integer"}, {"minimum", 1}},
                  {{"type", "string"}, {"pattern", "^[1-9][0-9]*[KMGT]?$"}}}}};
    case Kind::tables:
        return {{"type", "array"}, {"minItems", 1}, {"items", tableSchema(setting.members)}};
    }
    return {};
}

Json settingSchema(const Setting& setting)
{
    Json json = typeSchema(setting);
    std::string what(setting.what);
    if (!setting.default_text.empty())
        what += ". By default " + std::string(setting.default_text);
    json["description"] = what;
    return json;
}

/// Return the groups of settings as tables: of a profile, or of a rule, which has only settings of sources.
Json groupSchemas(bool for_rule)
{
    Json groups = Json::object();
    for (const Setting& setting : cookers::profileSettings())
    {
        if (for_rule && setting.scope != Scope::source)
            continue;
        const std::string group(settings::settingGroup(setting.key));
        if (!groups.contains(group))
            groups[group] = objectSchema(Json::object());
        groups[group]["properties"][setting.key.substr(group.size() + 1)] = settingSchema(setting);
    }
    return groups;
}

} // namespace

std::string configSchema()
{
    Json defaults = Json::object();
    for (const Setting& setting : profiles::commandSettings())
        defaults[setting.key] = settingSchema(setting);
    const Json text{{"type", "string"}, {"minLength", 1}};
    Json profile = groupSchemas(false);
    profile["inherits"] = text;
    profile["inherits"]["description"] =
        "the name of another profile: mobile-high, mobile-low, gles3 and desktop are built in";
    Json rule = groupSchemas(true);
    rule["match"] = text;
    rule["match"]["description"] = "which sources, by their path from here: * in a name, ** for any folders";
    rule["in_profile"] = text;
    rule["in_profile"]["description"] = "only where the profile is called so; * and ? are wildcards";
    Json rule_table = objectSchema(std::move(rule));
    rule_table["required"] = {"match"};
    Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                {"title", "hearth.toml: the settings of a project"}};
    schema.update(objectSchema(
        {{"defaults", objectSchema(std::move(defaults))},
         {"profile", {{"type", "object"}, {"additionalProperties", objectSchema(std::move(profile))}}},
         {"rule", {{"type", "array"}, {"items", std::move(rule_table)}}}}));
    return schema.dump(1) + "\n";
}

} // namespace hearth::command

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/profiles/config_file.h"

#include "cook/clusters/profile.h"
#include "pipelines/profiles/toml_value.h"

#include <algorithm>
#include <fmt/format.h>
#include <toml++/toml.h>

namespace hearth::profiles
{

namespace
{

Value placed(std::string text, const toml::node& node, const Place& place, const std::string& of)
{
    return {std::move(text), fmt::format("{}:{}{}", place.file, node.source().begin.line, of)};
}

/// Settings of `known` whose keys start with `prefix` ("clusters."), from a table.
Status readGroup(const toml::node& node, const Place& place, std::span<const Setting> known,
                 const std::string& prefix, const std::string& of, Values& values)
{
    const toml::table* table = node.as_table();
    if (table == nullptr)
        return place.wrong(Issue::profile_value, node, "must be a table");
    Keys keys;
    for (const Setting& setting : known)
        if (setting.key.starts_with(prefix))
            keys.push_back(setting.key.substr(prefix.size()));
    for (const auto& [key, value] : *table)
    {
        const Setting* setting = findSetting(known, prefix + std::string(key.str()));
        if (setting == nullptr)
            return unknownKey(place, value, key.str(), keys);
        HEARTH_ASSIGN_OR_RETURN(std::string text, checkedTextOf(value, *setting, place.at(key.str())));
        values[setting->key] = placed(std::move(text), value, place, of);
    }
    return success();
}

Result<std::string> nameAt(const toml::node& node, const Place& place)
{
    const auto* text = node.as_string();
    if (text == nullptr || text->get().empty())
        return place.wrong(Issue::profile_value, node, "must be a text that is not empty");
    return text->get();
}

/// The groups of profileSettings() that a table may have; a rule has those of sources only.
Keys groupsOf(bool of_rule)
{
    Keys groups;
    for (const Setting& setting : profileSettings())
        if ((!of_rule || setting.scope == Scope::source) &&
            std::find(groups.begin(), groups.end(), groupOf(setting.key)) == groups.end())
            groups.emplace_back(groupOf(setting.key));
    return groups;
}

bool isIn(const Keys& keys, std::string_view key)
{
    return std::find(keys.begin(), keys.end(), key) != keys.end();
}

Result<Profile> readProfile(const toml::table& table, const std::string& name, const Place& place,
                            const std::string& of)
{
    Profile profile;
    profile.name = name;
    const Keys groups = groupsOf(false);
    Keys known = groups;
    known.emplace_back("inherits");
    for (const auto& [key, node] : table)
    {
        const Place at = place.at(key.str());
        if (key.str() == "inherits")
        {
            HEARTH_ASSIGN_OR_RETURN(profile.inherits, nameAt(node, at));
            profile.place = at.of(node);
        }
        else if (!isIn(groups, key.str()))
            return unknownKey(place, node, key.str(), known);
        else
            HEARTH_TRY(
                readGroup(node, at, profileSettings(), std::string(key.str()) + ".", of, profile.values));
    }
    return profile;
}

Result<Rule> readRule(const toml::node& node, const Place& place)
{
    const toml::table* table = node.as_table();
    if (table == nullptr)
        return place.wrong(Issue::profile_value, node, "must be a table");
    Rule rule;
    const toml::node* match = table->get("match");
    if (match == nullptr)
        return place.at("match").wrong(Issue::profile_value, node,
                                       "is missing: say which sources, as match = \"assets/props/**\"");
    HEARTH_ASSIGN_OR_RETURN(rule.match, nameAt(*match, place.at("match")));
    rule.place = place.at("match").of(*match);
    const Keys groups = groupsOf(true);
    Keys known = groups;
    known.insert(known.end(), {"match", "in_profile"});
    for (const auto& [key, value] : *table)
    {
        const Place at = place.at(key.str());
        if (key.str() == "in_profile")
        {
            HEARTH_ASSIGN_OR_RETURN(rule.in_profile, nameAt(value, at));
        }
        else if (isIn(groups, key.str()))
            HEARTH_TRY(readGroup(value, at, profileSettings(), std::string(key.str()) + ".",
                                 fmt::format(" (rule {})", rule.match), rule.values));
        else if (isIn(groupsOf(false), key.str()))
            return at.wrong(Issue::profile_key, value,
                            "is of all sources together: set it in a profile, not in a rule");
        else if (key.str() != "match")
            return unknownKey(place, value, key.str(), known);
    }
    return rule;
}

Status readProfiles(const toml::node& node, const Place& place, ConfigFile& file)
{
    const toml::table* table = node.as_table();
    if (table == nullptr)
        return place.wrong(Issue::profile_value, node, "must be a table: [profile.NAME]");
    for (const auto& [key, value] : *table)
    {
        const Place at = place.at(key.str());
        const toml::table* body = value.as_table();
        if (body == nullptr)
            return at.wrong(Issue::profile_value, value, "must be a table: [profile.NAME]");
        const std::string name(key.str());
        HEARTH_ASSIGN_OR_RETURN(Profile profile,
                                readProfile(*body, name, at, fmt::format(" (profile {})", name)));
        file.profiles.push_back(std::move(profile));
    }
    return success();
}

Status readRules(const toml::node& node, const Place& place, ConfigFile& file)
{
    const toml::array* array = node.as_array();
    if (array == nullptr)
        return place.wrong(Issue::profile_value, node, "must be an array of tables: [[rule]]");
    for (size_t i = 0; i < array->size(); ++i)
    {
        HEARTH_ASSIGN_OR_RETURN(Rule rule, readRule(*array->get(i), place.at(i)));
        file.rules.push_back(std::move(rule));
    }
    return success();
}

Result<ConfigFile> configOf(const toml::table& root, const std::string& path, bool has_rules)
{
    ConfigFile file;
    file.path = path;
    const Place place{path, ""};
    Keys known{"defaults", "profile"};
    if (has_rules)
        known.emplace_back("rule");
    for (const auto& [key, node] : root)
    {
        const Place at = place.at(key.str());
        if (key.str() == "defaults")
            HEARTH_TRY(readGroup(node, at, commandSettings(), "", "", file.defaults));
        else if (key.str() == "profile")
            HEARTH_TRY(readProfiles(node, at, file));
        else if (key.str() == "rule" && has_rules)
            HEARTH_TRY(readRules(node, at, file));
        else if (key.str() == "rule")
            return at.wrong(Issue::profile_key, node,
                            "rules go by the paths of a project: they stand in its hearth.toml");
        else
            return unknownKey(place, node, key.str(), known);
    }
    return file;
}

/// Hand the text's root to `read`. errors: profile_syntax, and those of `read`.
template <typename Read>
auto parsed(std::string_view text, const std::string& path, const Read& read) -> decltype(read(toml::table()))
{
    try
    {
        return read(toml::parse(text));
    }
    catch (const toml::parse_error& wrong)
    {
        const toml::source_position begin = wrong.source().begin;
        return Error{Issue::profile_syntax, path, fmt::format("line {}, column {}", begin.line, begin.column),
                     std::string(wrong.description())};
    }
}

} // namespace

bool Rule::holdsIn(std::string_view profile) const
{
    return in_profile.empty() || clusters::matchesPattern(in_profile, profile);
}

Result<ConfigFile> parseConfig(std::string_view text, const std::string& path, bool has_rules)
{
    return parsed(text, path, [&](const toml::table& root) { return configOf(root, path, has_rules); });
}

Result<Profile> parseProfileFile(std::string_view text, const std::string& path)
{
    return parsed(text, path,
                  [&](const toml::table& root) {
                      return readProfile(root, path, {path, ""}, "");
                  });
}

} // namespace hearth::profiles

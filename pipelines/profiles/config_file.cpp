// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/profiles/config_file.h"

#include "cook/tools/name_pattern.h"
#include "pipelines/cookers/registry.h"
#include "pipelines/profiles/command_settings.h"
#include "pipelines/settings/toml_value.h"

#include <algorithm>
#include <fmt/format.h>

namespace hearth::profiles
{

namespace
{

using namespace settings;
using cookers::profileSettings;
using tools::TomlNode;

Value makeValue(std::string text, const TomlNode& node, const TomlLocation& place, const std::string& of)
{
    return {std::move(text), fmt::format("{}:{}{}", place.file, node.line, of)};
}

/// Read the settings of `known` whose keys start with `prefix` ("clusters.") from a table.
Status readGroup(const TomlNode& node, const TomlLocation& place, std::span<const Setting> known,
                 const std::string& prefix, const std::string& of, Values& values)
{
    if (!node.isTable())
        return place.wrong(Issue::profile_value, node, "must be a table");
    Keys keys;
    for (const Setting& setting : known)
        if (setting.key.starts_with(prefix))
            keys.push_back(setting.key.substr(prefix.size()));
    for (const TomlNode& member : node.children)
    {
        const Setting* setting = findSetting(known, prefix + member.key);
        if (setting == nullptr)
            return unknownKey(place, member, member.key, keys);
        HEARTH_ASSIGN_OR_RETURN(std::string text, canonicalText(member, *setting, place.at(member.key)));
        values[setting->key] = makeValue(std::move(text), member, place, of);
    }
    return success();
}

Result<std::string> readName(const TomlNode& node, const TomlLocation& place)
{
    if (!node.isText() || node.text.empty())
        return place.wrong(Issue::profile_value, node, "must be a text that is not empty");
    return node.text;
}

/// Return the groups of profileSettings() that a table may have; a rule may have groups of source settings
/// only.
Keys settingGroups(bool of_rule)
{
    Keys groups;
    for (const Setting& setting : profileSettings())
        if ((!of_rule || setting.scope == Scope::source) &&
            std::find(groups.begin(), groups.end(), settingGroup(setting.key)) == groups.end())
            groups.emplace_back(settingGroup(setting.key));
    return groups;
}

bool contains(const Keys& keys, std::string_view key)
{
    return std::find(keys.begin(), keys.end(), key) != keys.end();
}

Result<Profile> readProfile(const TomlNode& table, const std::string& name, const TomlLocation& place,
                            const std::string& of)
{
    Profile profile;
    profile.name = name;
    const Keys groups = settingGroups(false);
    Keys known = groups;
    known.emplace_back("inherits");
    for (const TomlNode& member : table.children)
    {
        const TomlLocation at = place.at(member.key);
        if (member.key == "inherits")
        {
            HEARTH_ASSIGN_OR_RETURN(profile.inherits, readName(member, at));
            profile.place = at.of(member);
        }
        else if (!contains(groups, member.key))
            return unknownKey(place, member, member.key, known);
        else
            HEARTH_TRY(readGroup(member, at, profileSettings(), member.key + ".", of, profile.values));
    }
    return profile;
}

Result<Rule> readRule(const TomlNode& node, const TomlLocation& place)
{
    if (!node.isTable())
        return place.wrong(Issue::profile_value, node, "must be a table");
    Rule rule;
    const TomlNode* match = node.find("match");
    if (match == nullptr)
        return place.at("match").wrong(Issue::profile_value, node,
                                       "is missing: say which sources, as match = \"assets/props/**\"");
    HEARTH_ASSIGN_OR_RETURN(rule.match, readName(*match, place.at("match")));
    rule.place = place.at("match").of(*match);
    const Keys groups = settingGroups(true);
    Keys known = groups;
    known.insert(known.end(), {"match", "in_profile"});
    for (const TomlNode& member : node.children)
    {
        const TomlLocation at = place.at(member.key);
        if (member.key == "in_profile")
        {
            HEARTH_ASSIGN_OR_RETURN(rule.in_profile, readName(member, at));
        }
        else if (contains(groups, member.key))
            HEARTH_TRY(readGroup(member, at, profileSettings(), member.key + ".",
                                 fmt::format(" (rule {})", rule.match), rule.values));
        else if (contains(settingGroups(false), member.key))
            return at.wrong(Issue::profile_key, member,
                            "is of all sources together: set it in a profile, not in a rule");
        else if (member.key != "match")
            return unknownKey(place, member, member.key, known);
    }
    return rule;
}

Status readProfiles(const TomlNode& node, const TomlLocation& place, ConfigFile& file)
{
    if (!node.isTable())
        return place.wrong(Issue::profile_value, node, "must be a table: [profile.NAME]");
    for (const TomlNode& member : node.children)
    {
        const TomlLocation at = place.at(member.key);
        if (!member.isTable())
            return at.wrong(Issue::profile_value, member, "must be a table: [profile.NAME]");
        HEARTH_ASSIGN_OR_RETURN(
            Profile profile, readProfile(member, member.key, at, fmt::format(" (profile {})", member.key)));
        file.profiles.push_back(std::move(profile));
    }
    return success();
}

Status readRules(const TomlNode& node, const TomlLocation& place, ConfigFile& file)
{
    if (!node.isArray())
        return place.wrong(Issue::profile_value, node, "must be an array of tables: [[rule]]");
    for (size_t i = 0; i < node.children.size(); ++i)
    {
        HEARTH_ASSIGN_OR_RETURN(Rule rule, readRule(node.children[i], place.at(i)));
        file.rules.push_back(std::move(rule));
    }
    return success();
}

Result<ConfigFile> readConfig(const TomlNode& root, const std::string& path, bool has_rules)
{
    ConfigFile file;
    file.path = path;
    const TomlLocation place{path, ""};
    Keys known{"defaults", "profile"};
    if (has_rules)
        known.emplace_back("rule");
    for (const TomlNode& node : root.children)
    {
        const TomlLocation at = place.at(node.key);
        if (node.key == "defaults")
            HEARTH_TRY(readGroup(node, at, commandSettings(), "", "", file.defaults));
        else if (node.key == "profile")
            HEARTH_TRY(readProfiles(node, at, file));
        else if (node.key == "rule" && has_rules)
            HEARTH_TRY(readRules(node, at, file));
        else if (node.key == "rule")
            return at.wrong(Issue::profile_key, node,
                            "rules match paths of a project: put them into its hearth.toml");
        else
            return unknownKey(place, node, node.key, known);
    }
    return file;
}

/// Parse the root table of a text. errors: profile_syntax.
Result<TomlNode> parseRoot(std::string_view text, const std::string& path)
{
    tools::TomlError fault;
    std::optional<TomlNode> root = tools::parseToml(text, fault);
    if (!root)
        return Error{Issue::profile_syntax, path, fmt::format("line {}, column {}", fault.line, fault.column),
                     fault.text};
    return std::move(*root);
}

} // namespace

bool Rule::appliesTo(std::string_view profile) const
{
    return in_profile.empty() || tools::matchesPattern(in_profile, profile);
}

Result<ConfigFile> parseConfig(std::string_view text, const std::string& path, bool has_rules)
{
    HEARTH_ASSIGN_OR_RETURN(const TomlNode root, parseRoot(text, path));
    return readConfig(root, path, has_rules);
}

Result<Profile> parseProfileFile(std::string_view text, const std::string& path)
{
    HEARTH_ASSIGN_OR_RETURN(const TomlNode root, parseRoot(text, path));
    return readProfile(root, path, {path, ""}, "");
}

} // namespace hearth::profiles

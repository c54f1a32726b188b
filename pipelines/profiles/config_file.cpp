// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/profiles/config_file.h"

#include "cook/clusters/profile.h"
#include "cook/tools/suggest.h"
#include "pipelines/cache/open_cache.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sstream>
#include <toml++/toml.h>

namespace hearth::profiles
{

namespace
{

// One word of a command line may have 128 KiB on Linux: it holds a setting with its key.
constexpr size_t kLongestValue = 100'000;

/// Where in a file a node stands, for messages.
struct Place
{
    const std::string& file;
    std::string key;
    bool has_lines = true; ///< what stands on a command line has none

    Place at(std::string_view name) const
    {
        return {file, key.empty() ? std::string(name) : key + "." + std::string(name), has_lines};
    }
    Place at(size_t index) const { return {file, fmt::format("{}[{}]", key, index), has_lines}; }

    std::string of(const toml::node& node) const
    {
        const toml::source_position begin = node.source().begin;
        return has_lines ? fmt::format("line {}, column {}, {}", begin.line, begin.column, key) : key;
    }
    Error wrong(Issue issue, const toml::node& node, std::string detail) const
    {
        return {issue, file, of(node), std::move(detail)};
    }
};

using Keys = std::vector<std::string>;

Error unknownKey(const Place& place, const toml::node& node, std::string_view key, const Keys& known)
{
    const std::string nearest = tools::nearestMatch(key, known);
    return place.at(key).wrong(
        Issue::profile_key, node,
        nearest.empty() ? fmt::format("this key is not known; known are {}", fmt::join(known, ", "))
                        : fmt::format("this key is not known: did you mean '{}'?", nearest));
}

// ---- values

std::string quoted(std::string_view text)
{
    std::string word = "\"";
    for (const char c : text)
        if (c == '"' || c == '\\')
            word += {'\\', c};
        else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F)
            word += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
        else
            word += c;
    return word + '"';
}

Result<std::string> textOf(const toml::node& node, const Setting& setting, const Place& place);

Error outOfRange(const toml::node& node, const Setting& setting, const Place& place)
{
    return place.wrong(Issue::profile_value, node, "must be " + rangeText(setting));
}

bool isInRange(double value, const Setting& setting)
{
    const bool is_above = setting.is_above_low ? value > setting.low : value >= setting.low;
    return std::isfinite(value) && is_above && value <= setting.high;
}

Result<std::string> wholeText(const toml::node& node, const Setting& setting, const Place& place)
{
    const auto* whole = node.as_integer();
    if (whole == nullptr)
        return outOfRange(node, setting, place);
    std::string text = std::to_string(whole->get());
    const bool is_allowed =
        setting.choices.empty()
            ? isInRange(static_cast<double>(whole->get()), setting)
            : std::find(setting.choices.begin(), setting.choices.end(), text) != setting.choices.end();
    return is_allowed ? Result<std::string>(std::move(text)) : outOfRange(node, setting, place);
}

Result<std::string> numberText(const toml::node& node, const Setting& setting, const Place& place)
{
    const double value = node.value<double>().value_or(NAN);
    if (!node.is_number() || !isInRange(value, setting))
        return outOfRange(node, setting, place);
    return fmt::format("{}", value);
}

Result<std::string> wordText(const toml::node& node, const Setting& setting, const Place& place)
{
    const auto* text = node.as_string();
    const bool is_allowed =
        text != nullptr && !text->get().empty() &&
        (setting.kind != Kind::choice ||
         std::find(setting.choices.begin(), setting.choices.end(), text->get()) != setting.choices.end());
    if (is_allowed)
        return quoted(text->get());
    if (text == nullptr || setting.kind != Kind::choice)
        return outOfRange(node, setting, place);
    const Keys choices(setting.choices.begin(), setting.choices.end());
    const std::string nearest = tools::nearestMatch(text->get(), choices);
    return place.wrong(Issue::profile_value, node,
                       fmt::format("'{}' must be {}{}", text->get(), rangeText(setting),
                                   nearest.empty() ? "" : ": did you mean '" + nearest + "'?"));
}

Result<std::string> textsText(const toml::node& node, const Setting& setting, const Place& place)
{
    const Setting one{setting.key, Kind::text, "", ""};
    const toml::array* array = node.as_array();
    if (array == nullptr)
    {
        if (!node.is_string())
            return outOfRange(node, setting, place);
        HEARTH_ASSIGN_OR_RETURN(const std::string text, textOf(node, one, place));
        return "[" + text + "]";
    }
    std::vector<std::string> texts;
    for (size_t i = 0; i < array->size(); ++i)
    {
        HEARTH_ASSIGN_OR_RETURN(std::string text, textOf(*array->get(i), one, place.at(i)));
        texts.push_back(std::move(text));
    }
    return fmt::format("[{}]", fmt::join(texts, ","));
}

Result<std::string> sizeText(const toml::node& node, const Setting& setting, const Place& place)
{
    if (const auto* whole = node.as_integer(); whole != nullptr && whole->get() > 0)
        return std::to_string(whole->get());
    const auto* text = node.as_string();
    const auto size = text == nullptr ? Result<uint64_t>(outOfRange(node, setting, place))
                                      : cache::parseSize(text->get(), "");
    return size.ok() ? Result<std::string>(std::to_string(*size)) : outOfRange(node, setting, place);
}

Result<std::string> tableText(const toml::table& table, const Setting& setting, const Place& place)
{
    Keys known;
    for (const Setting& member : setting.members)
        known.push_back(member.key);
    for (const auto& [key, node] : table)
        if (findSetting(setting.members, key.str()) == nullptr)
            return unknownKey(place, node, key.str(), known);
    std::vector<std::string> members;
    for (const Setting& member : setting.members)
    {
        const toml::node* node = table.get(member.key);
        if (node == nullptr && member.is_required)
            return place.at(member.key)
                .wrong(Issue::profile_value, table, "is missing: it must be " + rangeText(member));
        if (node == nullptr)
            continue;
        HEARTH_ASSIGN_OR_RETURN(const std::string text, textOf(*node, member, place.at(member.key)));
        members.push_back(member.key + "=" + text);
    }
    return fmt::format("{{{}}}", fmt::join(members, ","));
}

Result<std::string> tablesText(const toml::node& node, const Setting& setting, const Place& place)
{
    const toml::array* array = node.as_array();
    if (array == nullptr || array->empty())
        return outOfRange(node, setting, place);
    std::vector<std::string> tables;
    for (size_t i = 0; i < array->size(); ++i)
    {
        const toml::table* table = array->get(i)->as_table();
        if (table == nullptr)
            return place.at(i).wrong(Issue::profile_value, *array->get(i), "must be a table");
        HEARTH_ASSIGN_OR_RETURN(std::string text, tableText(*table, setting, place.at(i)));
        tables.push_back(std::move(text));
    }
    return fmt::format("[{}]", fmt::join(tables, ","));
}

/// The node's value, in the one form. errors: profile_key, profile_value.
Result<std::string> textOf(const toml::node& node, const Setting& setting, const Place& place)
{
    switch (setting.kind)
    {
    case Kind::flag:
        if (const auto* flag = node.as_boolean())
            return std::string(flag->get() ? "true" : "false");
        return outOfRange(node, setting, place);
    case Kind::whole:
        return wholeText(node, setting, place);
    case Kind::number:
        return numberText(node, setting, place);
    case Kind::choice:
    case Kind::text:
        return wordText(node, setting, place);
    case Kind::texts:
        return textsText(node, setting, place);
    case Kind::size:
        return sizeText(node, setting, place);
    case Kind::tables:
        return tablesText(node, setting, place);
    }
    return outOfRange(node, setting, place);
}

/// The same, and what the cooker itself says of it: values of several members may not go together.
Result<std::string> checkedTextOf(const toml::node& node, const Setting& setting, const Place& place)
{
    HEARTH_ASSIGN_OR_RETURN(std::string text, textOf(node, setting, place));
    if (text.size() > kLongestValue)
        return place.wrong(Issue::profile_value, node,
                           fmt::format("has {} characters, the limit is {}", text.size(), kLongestValue));
    if (groupOf(setting.key) == "clusters")
        if (const auto read = clusters::parseProfile(setting.key + "=" + text, ""); !read.ok())
            return place.wrong(Issue::profile_value, node, read.error().detail);
    return text;
}

// ---- tables

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
                                       "is missing: say which sources, as match = \"props/**/*.glb\"");
    HEARTH_ASSIGN_OR_RETURN(rule.match, nameAt(*match, place.at("match")));
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

bool isWord(Kind kind)
{
    return kind == Kind::choice || kind == Kind::text || kind == Kind::texts || kind == Kind::size;
}

} // namespace

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

Result<Value> valueOf(const Setting& setting, const std::vector<std::string>& words,
                      const std::string& origin)
{
    const Place place{origin, "", false};
    const auto checked = [&](const toml::node& node) -> Result<Value>
    {
        HEARTH_ASSIGN_OR_RETURN(std::string text, checkedTextOf(node, setting, place));
        return Value{std::move(text), origin};
    };
    if (setting.kind == Kind::texts)
    {
        toml::array array;
        for (const std::string& word : words)
            array.push_back(word);
        return checked(array);
    }
    if (isWord(setting.kind))
        return checked(toml::value<std::string>(words.back()));
    // what is no TOML is out of every range
    toml::table root;
    try
    {
        root = toml::parse("x=" + words.back());
    }
    catch (const toml::parse_error&)
    {
        return Error{Issue::profile_value, origin, "",
                     fmt::format("'{}' must be {}", words.back(), rangeText(setting))};
    }
    return checked(*root.get("x"));
}

Result<std::pair<std::string, Value>> parseAssignment(const std::string& text)
{
    const std::string key = text.substr(0, text.find('='));
    const Setting* setting = findSetting(profileSettings(), key);
    if (setting == nullptr)
    {
        Keys known;
        for (const Setting& one : profileSettings())
            known.push_back(one.key);
        const std::string nearest = tools::nearestMatch(key, known);
        return Error{Issue::profile_key, "--set " + text, "",
                     nearest.empty() ? "this key is not known"
                                     : fmt::format("this key is not known: did you mean '{}'?", nearest)};
    }
    if (key.size() == text.size())
        return Error{Issue::profile_value, "--set " + text, "", "write KEY=VALUE"};
    const std::string value = text.substr(key.size() + 1);
    const std::string origin = "--set " + text;
    // a text may stand without quotation marks, or with them
    const bool is_toml = isWord(setting->kind) && !value.empty() &&
                         std::string_view("\"'[").find(value.front()) != std::string_view::npos;
    if (!is_toml)
    {
        HEARTH_ASSIGN_OR_RETURN(Value checked, valueOf(*setting, {value}, origin));
        return std::pair(key, std::move(checked));
    }
    HEARTH_ASSIGN_OR_RETURN(std::string checked,
                            parsed("x=" + value, origin,
                                   [&](const toml::table& root) -> Result<std::string> {
                                       return checkedTextOf(*root.get("x"), *setting, {origin, "", false});
                                   }));
    return std::pair(key, Value{std::move(checked), origin});
}

std::vector<std::string> textsOf(const Value& value)
{
    std::vector<std::string> texts;
    const toml::table root = toml::parse("x=" + value.text);
    const toml::node* node = root.get("x");
    if (const auto* text = node->as_string())
        texts.push_back(text->get());
    if (const toml::array* array = node->as_array())
        for (const toml::node& one : *array)
            texts.push_back(one.value<std::string>().value_or(""));
    return texts;
}

std::string jsonOf(const Value& value)
{
    std::ostringstream json;
    const toml::table root = toml::parse("x=" + value.text);
    json << toml::json_formatter(*root.get("x"));
    return json.str();
}

} // namespace hearth::profiles

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/settings/toml_value.h"

#include "formats/base/nearest_match.h"
#include "pipelines/cache/cache_spec.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hearth::settings
{

using tools::TomlKind;
using tools::TomlNode;

namespace
{

// A word of a command line may have 128 KiB on Linux; it holds a setting with its key.
constexpr size_t kMaxValueSize = 100'000;

std::string quoteToml(std::string_view text)
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

Result<std::string> formatNode(const TomlNode& node, const Setting& setting, const TomlLocation& place);

Error outOfRange(const TomlNode& node, const Setting& setting, const TomlLocation& place)
{
    return place.wrong(Issue::profile_value, node, "must be " + rangeText(setting));
}

bool isInRange(double value, const Setting& setting)
{
    const bool is_above = setting.is_above_low ? value > setting.low : value >= setting.low;
    return std::isfinite(value) && is_above && value <= setting.high;
}

Result<std::string> wholeText(const TomlNode& node, const Setting& setting, const TomlLocation& place)
{
    if (!node.isWhole())
        return outOfRange(node, setting, place);
    std::string text = std::to_string(node.whole);
    const bool is_allowed =
        setting.choices.empty()
            ? isInRange(static_cast<double>(node.whole), setting)
            : std::find(setting.choices.begin(), setting.choices.end(), text) != setting.choices.end();
    return is_allowed ? Result<std::string>(std::move(text)) : outOfRange(node, setting, place);
}

Result<std::string> numberText(const TomlNode& node, const Setting& setting, const TomlLocation& place)
{
    const double value = node.asNumber().value_or(NAN);
    if (!isInRange(value, setting))
        return outOfRange(node, setting, place);
    return fmt::format("{}", value);
}

Result<std::string> wordText(const TomlNode& node, const Setting& setting, const TomlLocation& place)
{
    const bool is_allowed =
        node.isText() && !node.text.empty() &&
        (setting.kind != Kind::choice ||
         std::find(setting.choices.begin(), setting.choices.end(), node.text) != setting.choices.end());
    if (is_allowed)
        return quoteToml(node.text);
    if (!node.isText() || setting.kind != Kind::choice)
        return outOfRange(node, setting, place);
    const Keys choices(setting.choices.begin(), setting.choices.end());
    const std::string nearest = nearestMatch(node.text, choices);
    return place.wrong(Issue::profile_value, node,
                       fmt::format("'{}' must be {}{}", node.text, rangeText(setting),
                                   nearest.empty() ? "" : ": did you mean '" + nearest + "'?"));
}

Result<std::string> textsText(const TomlNode& node, const Setting& setting, const TomlLocation& place)
{
    const Setting one{setting.key, Kind::text, "", ""};
    if (!node.isArray())
    {
        if (!node.isText())
            return outOfRange(node, setting, place);
        HEARTH_ASSIGN_OR_RETURN(const std::string text, formatNode(node, one, place));
        return "[" + text + "]";
    }
    std::vector<std::string> texts;
    for (size_t i = 0; i < node.children.size(); ++i)
    {
        HEARTH_ASSIGN_OR_RETURN(std::string text, formatNode(node.children[i], one, place.at(i)));
        texts.push_back(std::move(text));
    }
    return fmt::format("[{}]", fmt::join(texts, ","));
}

Result<std::string> sizeText(const TomlNode& node, const Setting& setting, const TomlLocation& place)
{
    if (node.isWhole() && node.whole > 0)
        return std::to_string(node.whole);
    const auto size =
        node.isText() ? cache::parseSize(node.text, "") : Result<uint64_t>(outOfRange(node, setting, place));
    return size.ok() ? Result<std::string>(std::to_string(*size)) : outOfRange(node, setting, place);
}

Result<std::string> tableText(const TomlNode& table, const Setting& setting, const TomlLocation& place)
{
    Keys known;
    for (const Setting& member : setting.members)
        known.push_back(member.key);
    for (const TomlNode& node : table.children)
        if (findSetting(setting.members, node.key) == nullptr)
            return unknownKey(place, node, node.key, known);
    std::vector<std::string> members;
    for (const Setting& member : setting.members)
    {
        const TomlNode* node = table.find(member.key);
        if (node == nullptr && member.is_required)
            return place.at(member.key)
                .wrong(Issue::profile_value, table, "is missing: it must be " + rangeText(member));
        if (node == nullptr)
            continue;
        HEARTH_ASSIGN_OR_RETURN(const std::string text, formatNode(*node, member, place.at(member.key)));
        members.push_back(member.key + "=" + text);
    }
    return fmt::format("{{{}}}", fmt::join(members, ","));
}

Result<std::string> tablesText(const TomlNode& node, const Setting& setting, const TomlLocation& place)
{
    if (!node.isArray() || node.children.empty())
        return outOfRange(node, setting, place);
    std::vector<std::string> tables;
    for (size_t i = 0; i < node.children.size(); ++i)
    {
        const TomlNode& table = node.children[i];
        if (!table.isTable())
            return place.at(i).wrong(Issue::profile_value, table, "must be a table");
        HEARTH_ASSIGN_OR_RETURN(std::string text, tableText(table, setting, place.at(i)));
        tables.push_back(std::move(text));
    }
    return fmt::format("[{}]", fmt::join(tables, ","));
}

/// Return the node's value in canonical form. errors: profile_key, profile_value.
Result<std::string> formatNode(const TomlNode& node, const Setting& setting, const TomlLocation& place)
{
    switch (setting.kind)
    {
    case Kind::flag:
        if (node.kind == TomlKind::flag)
            return std::string(node.flag ? "true" : "false");
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

} // namespace

TomlLocation TomlLocation::at(std::string_view name) const
{
    return {file, key.empty() ? std::string(name) : key + "." + std::string(name), has_lines};
}

TomlLocation TomlLocation::at(size_t index) const
{
    return {file, fmt::format("{}[{}]", key, index), has_lines};
}

std::string TomlLocation::of(const TomlNode& node) const
{
    return has_lines ? fmt::format("line {}, column {}, {}", node.line, node.column, key) : key;
}

Error TomlLocation::wrong(Issue issue, const TomlNode& node, std::string detail) const
{
    return {issue, file, of(node), std::move(detail)};
}

Error unknownKey(const TomlLocation& place, const TomlNode& node, std::string_view key, const Keys& known)
{
    const std::string nearest = nearestMatch(key, known);
    return place.at(key).wrong(
        Issue::profile_key, node,
        nearest.empty() ? fmt::format("this key is not known; known are {}", fmt::join(known, ", "))
                        : fmt::format("this key is not known: did you mean '{}'?", nearest));
}

Result<std::string> canonicalText(const TomlNode& node, const Setting& setting, const TomlLocation& place)
{
    HEARTH_ASSIGN_OR_RETURN(std::string text, formatNode(node, setting, place));
    if (text.size() > kMaxValueSize)
        return place.wrong(Issue::profile_value, node,
                           fmt::format("has {} characters, the limit is {}", text.size(), kMaxValueSize));
    if (setting.check != nullptr)
        if (const Status checked = setting.check(setting.key, text); !checked.ok())
            return place.wrong(Issue::profile_value, node, checked.error().detail);
    return text;
}

} // namespace hearth::settings

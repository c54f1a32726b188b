// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/profiles/value.h"

#include "cook/json/json.h"
#include "formats/base/nearest_match.h"
#include "pipelines/profiles/toml_value.h"

#include <fmt/format.h>

namespace hearth::profiles
{

namespace
{

using tools::TomlKind;
using tools::TomlNode;

bool isWord(Kind kind)
{
    return kind == Kind::choice || kind == Kind::text || kind == Kind::texts || kind == Kind::size;
}

Result<Value> checkedValue(const TomlNode& node, const Setting& setting, const std::string& origin)
{
    HEARTH_ASSIGN_OR_RETURN(std::string text, canonicalText(node, setting, {origin, "", false}));
    return Value{std::move(text), origin};
}

/// Parse a word in TOML syntax; a word that is not TOML is out of range.
Result<Value> parseTomlValue(const std::string& word, const Setting& setting, const std::string& origin)
{
    tools::TomlError fault;
    const std::optional<TomlNode> root = tools::parseToml("x=" + word, fault);
    if (!root)
        return Error{Issue::profile_value, origin, "",
                     fmt::format("'{}' must be {}", word, rangeText(setting))};
    return checkedValue(*root->find("x"), setting, origin);
}

TomlNode textNode(const std::string& text)
{
    TomlNode node;
    node.kind = TomlKind::text;
    node.text = text;
    return node;
}

/// Parse the text of a value.
TomlNode parseNode(const Value& value)
{
    tools::TomlError fault;
    return *tools::parseToml("x=" + value.text, fault).value().find("x");
}

Json toJson(const TomlNode& node)
{
    switch (node.kind)
    {
    case TomlKind::table:
    {
        Json json = Json::object();
        for (const TomlNode& member : node.children)
            json[member.key] = toJson(member);
        return json;
    }
    case TomlKind::array:
    {
        Json json = Json::array();
        for (const TomlNode& element : node.children)
            json.push_back(toJson(element));
        return json;
    }
    case TomlKind::text:
        return node.text;
    case TomlKind::whole:
        return node.whole;
    case TomlKind::number:
        return node.number;
    case TomlKind::flag:
        return node.flag;
    case TomlKind::time: // no setting has one
        break;
    }
    return nullptr;
}

} // namespace

Result<Value> parseValue(const Setting& setting, const std::vector<std::string>& words,
                         const std::string& origin)
{
    if (setting.kind == Kind::texts)
    {
        TomlNode array;
        array.kind = TomlKind::array;
        for (const std::string& word : words)
            array.children.push_back(textNode(word));
        return checkedValue(array, setting, origin);
    }
    if (isWord(setting.kind))
        return checkedValue(textNode(words.back()), setting, origin);
    return parseTomlValue(words.back(), setting, origin);
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
        const std::string nearest = nearestMatch(key, known);
        return Error{Issue::profile_key, "--set " + text, "",
                     nearest.empty() ? "this key is not known"
                                     : fmt::format("this key is not known: did you mean '{}'?", nearest)};
    }
    if (key.size() == text.size())
        return Error{Issue::profile_value, "--set " + text, "", "write KEY=VALUE"};
    const std::string value = text.substr(key.size() + 1);
    const std::string origin = "--set " + text;
    // a text may be written with or without quotation marks
    const bool is_toml = isWord(setting->kind) && !value.empty() &&
                         std::string_view("\"'[").find(value.front()) != std::string_view::npos;
    HEARTH_ASSIGN_OR_RETURN(Value checked, is_toml ? parseTomlValue(value, *setting, origin)
                                                   : parseValue(*setting, {value}, origin));
    return std::pair(key, std::move(checked));
}

std::vector<std::string> valueTexts(const Value& value)
{
    std::vector<std::string> texts;
    const TomlNode node = parseNode(value);
    if (node.isText())
        texts.push_back(node.text);
    if (node.isArray())
        for (const TomlNode& element : node.children)
            texts.push_back(element.text);
    return texts;
}

Json toJson(const Value& value)
{
    return toJson(parseNode(value));
}

} // namespace hearth::profiles

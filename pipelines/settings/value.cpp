// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/settings/value.h"

#include "cook/json/json.h"
#include "pipelines/settings/toml_value.h"

#include <fmt/format.h>

namespace hearth::settings
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

Result<Value> parseAssignedValue(const Setting& setting, const std::string& text, const std::string& origin)
{
    const bool is_toml = isWord(setting.kind) && !text.empty() &&
                         std::string_view("\"'[").find(text.front()) != std::string_view::npos;
    return is_toml ? parseTomlValue(text, setting, origin) : parseValue(setting, {text}, origin);
}

const Value* findValue(const Values& values, std::string_view key)
{
    const auto found = values.find(key);
    return found == values.end() ? nullptr : &found->second;
}

bool isOn(const Values& values, std::string_view key)
{
    const Value* value = findValue(values, key);
    return value != nullptr && value->text == "true";
}

std::string choiceOr(const Values& values, std::string_view key, std::string_view otherwise)
{
    const Value* value = findValue(values, key);
    return value == nullptr ? std::string(otherwise) : valueTexts(*value).front();
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

} // namespace hearth::settings

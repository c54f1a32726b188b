// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/profiles/value.h"

#include "cook/tools/suggest.h"
#include "pipelines/profiles/toml_value.h"

#include <fmt/format.h>
#include <sstream>
#include <toml++/toml.h>

namespace hearth::profiles
{

namespace
{

bool isWord(Kind kind)
{
    return kind == Kind::choice || kind == Kind::text || kind == Kind::texts || kind == Kind::size;
}

Result<Value> checkedValue(const toml::node& node, const Setting& setting, const std::string& origin)
{
    HEARTH_ASSIGN_OR_RETURN(std::string text, checkedTextOf(node, setting, {origin, "", false}));
    return Value{std::move(text), origin};
}

/// Of a word that is written as in a file; what is no TOML is out of every range.
Result<Value> valueOfToml(const std::string& word, const Setting& setting, const std::string& origin)
{
    toml::table root;
    try
    {
        root = toml::parse("x=" + word);
    }
    catch (const toml::parse_error&)
    {
        return Error{Issue::profile_value, origin, "",
                     fmt::format("'{}' must be {}", word, rangeText(setting))};
    }
    return checkedValue(*root.get("x"), setting, origin);
}

} // namespace

Result<Value> valueOf(const Setting& setting, const std::vector<std::string>& words,
                      const std::string& origin)
{
    if (setting.kind == Kind::texts)
    {
        toml::array array;
        for (const std::string& word : words)
            array.push_back(word);
        return checkedValue(array, setting, origin);
    }
    if (isWord(setting.kind))
        return checkedValue(toml::value<std::string>(words.back()), setting, origin);
    return valueOfToml(words.back(), setting, origin);
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
    HEARTH_ASSIGN_OR_RETURN(Value checked, is_toml ? valueOfToml(value, *setting, origin)
                                                   : valueOf(*setting, {value}, origin));
    return std::pair(key, std::move(checked));
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

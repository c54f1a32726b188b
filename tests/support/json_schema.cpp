// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/json_schema.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <regex.h>

namespace hearth::test
{

namespace
{

/// True if the text matches. Patterns of the schemas are also extended regular expressions; an invalid one
/// matches nothing.
bool matches(const std::string& text, const std::string& pattern)
{
    regex_t compiled{};
    if (::regcomp(&compiled, pattern.c_str(), REG_EXTENDED | REG_NOSUB) != 0)
        return false;
    const bool found = ::regexec(&compiled, text.c_str(), 0, nullptr, 0) == 0;
    ::regfree(&compiled);
    return found;
}

/// Return the number of UTF-8 characters.
size_t getLength(const std::string& text)
{
    return static_cast<size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

bool isOfType(const Json& value, const std::string& type)
{
    if (type == "number")
        return value.is_number();
    if (type == "integer")
        return value.is_number_integer();
    return type == (value.is_object()    ? "object"
                    : value.is_array()   ? "array"
                    : value.is_string()  ? "string"
                    : value.is_boolean() ? "boolean"
                    : value.is_null()    ? "null"
                                         : "");
}

class Checker
{
public:
    explicit Checker(const Json& root) : root_(root) {}

    std::string fault(const Json& schema, const Json& value, const std::string& place) const
    {
        if (schema.is_boolean())
            return schema.get<bool>() ? "" : place + ": is not allowed";
        for (const auto& [keyword, rule] : schema.items())
            if (std::string found = findFault(keyword, rule, schema, value, place); !found.empty())
                return found;
        return "";
    }

private:
    std::string findFault(const std::string& keyword, const Json& rule, const Json& schema, const Json& value,
                          const std::string& place) const
    {
        const auto unless = [&](bool holds)
        { return holds ? "" : place + ": " + keyword + " " + rule.dump(); };
        if (keyword == "type")
            return unless(rule.is_array() ? std::any_of(rule.begin(), rule.end(),
                                                        [&](const Json& type)
                                                        { return isOfType(value, type.get<std::string>()); })
                                          : isOfType(value, rule.get<std::string>()));
        if (keyword == "enum")
            return unless(std::find(rule.begin(), rule.end(), value) != rule.end());
        if (keyword == "const")
            return unless(value == rule);
        if (keyword == "minimum")
            return unless(!value.is_number() || value.get<double>() >= rule.get<double>());
        if (keyword == "exclusiveMinimum")
            return unless(!value.is_number() || value.get<double>() > rule.get<double>());
        if (keyword == "maximum")
            return unless(!value.is_number() || value.get<double>() <= rule.get<double>());
        if (keyword == "minItems")
            return unless(!value.is_array() || value.size() >= rule.get<size_t>());
        if (keyword == "maxItems")
            return unless(!value.is_array() || value.size() <= rule.get<size_t>());
        if (keyword == "if")
        {
            const char* const next = fault(rule, value, place).empty() ? "then" : "else";
            return schema.contains(next) ? fault(schema[next], value, place) : "";
        }
        if (keyword == "minLength")
            return unless(!value.is_string() || getLength(value.get<std::string>()) >= rule.get<size_t>());
        if (keyword == "oneOf")
            return unless(std::count_if(rule.begin(), rule.end(),
                                        [&](const Json& one)
                                        { return fault(one, value, place).empty(); }) == 1);
        if (keyword == "pattern")
            return unless(!value.is_string() || matches(value.get<std::string>(), rule.get<std::string>()));
        if (keyword == "required")
            return unless(!value.is_object() ||
                          std::all_of(rule.begin(), rule.end(),
                                      [&](const Json& name)
                                      { return value.contains(name.get<std::string>()); }));
        if (keyword == "$ref")
            return fault(*root_.resolve(rule.get<std::string>().substr(1)), value, place);
        if (keyword == "properties" || keyword == "additionalProperties")
            return membersFault(keyword == "properties", rule, schema, value, place);
        if (keyword == "items" || keyword == "allOf")
            return listFault(keyword == "items", rule, value, place);
        const bool is_read_elsewhere = keyword == "description" || keyword == "title" ||
                                       keyword == "format" || keyword == "then" || keyword == "else" ||
                                       keyword == "$defs" || keyword == "$schema" || keyword == "$id";
        return is_read_elsewhere ? "" : place + ": unknown keyword " + keyword;
    }

    std::string membersFault(bool named, const Json& rule, const Json& schema, const Json& value,
                             const std::string& place) const
    {
        if (!value.is_object())
            return "";
        for (const auto& [name, member] : value.items())
        {
            const bool is_known = schema.contains("properties") && schema["properties"].contains(name);
            if (is_known != named)
                continue;
            if (std::string found = fault(named ? rule[name] : rule, member, place + "/" + name);
                !found.empty())
                return found;
        }
        return "";
    }

    std::string listFault(bool items, const Json& rule, const Json& value, const std::string& place) const
    {
        const size_t count = items ? (value.is_array() ? value.size() : 0) : rule.size();
        for (size_t i = 0; i < count; ++i)
            if (std::string found = items ? fault(rule, value[i], place + "/" + std::to_string(i))
                                          : fault(rule[i], value, place);
                !found.empty())
                return found;
        return "";
    }

    const Json& root_;
};

} // namespace

std::string findFault(const Json& schema, const Json& value)
{
    return Checker(schema).fault(schema, value, "");
}

std::string faultOfSchema(const std::string& schema_file, const Json& value)
{
    std::ifstream file(schema_file);
    const std::string text(std::istreambuf_iterator<char>(file), {});
    const std::optional<Json> schema = Json::parse(text);
    return schema ? findFault(*schema, value) : schema_file + " is no JSON";
}

} // namespace hearth::test

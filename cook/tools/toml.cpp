// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/tools/toml.h"

#include <algorithm>
#include <toml++/toml.h>

namespace hearth::tools
{

namespace
{

TomlNode convertNode(const toml::node& source)
{
    TomlNode node;
    node.line = source.source().begin.line;
    node.column = source.source().begin.column;
    if (const toml::table* table = source.as_table())
        for (const auto& [key, value] : *table)
            node.children.emplace_back(convertNode(value)).key = key.str();
    else if (const toml::array* array = source.as_array())
    {
        node.kind = TomlKind::array;
        for (const toml::node& element : *array)
            node.children.push_back(convertNode(element));
    }
    else if (const auto* text = source.as_string())
    {
        node.kind = TomlKind::text;
        node.text = text->get();
    }
    else if (const auto* whole = source.as_integer())
    {
        node.kind = TomlKind::whole;
        node.whole = whole->get();
    }
    else if (const auto* number = source.as_floating_point())
    {
        node.kind = TomlKind::number;
        node.number = number->get();
    }
    else if (const auto* flag = source.as_boolean())
    {
        node.kind = TomlKind::flag;
        node.flag = flag->get();
    }
    else
        node.kind = TomlKind::time;
    return node;
}

} // namespace

std::optional<double> TomlNode::asNumber() const
{
    constexpr int64_t kEndOfExact = int64_t{1} << 53;
    if (kind == TomlKind::number)
        return number;
    if (kind == TomlKind::whole && whole >= -kEndOfExact && whole <= kEndOfExact)
        return static_cast<double>(whole);
    return std::nullopt;
}

const TomlNode* TomlNode::find(std::string_view name) const
{
    if (!isTable())
        return nullptr;
    const auto found = std::find_if(children.begin(), children.end(),
                                    [&](const TomlNode& member) { return member.key == name; });
    return found == children.end() ? nullptr : &*found;
}

std::optional<TomlNode> parseToml(std::string_view text, TomlError& fault)
{
    try
    {
        return convertNode(toml::parse(text));
    }
    catch (const toml::parse_error& wrong)
    {
        const toml::source_position begin = wrong.source().begin;
        fault = {begin.line, begin.column, std::string(wrong.description())};
        return std::nullopt;
    }
}

} // namespace hearth::tools

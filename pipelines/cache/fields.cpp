// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/cache/fields.h"

#include <algorithm>

namespace hearth::cache
{

namespace
{

void append(std::string& text, std::string_view value)
{
    for (const char c : value)
        switch (c)
        {
        case '\\':
            text += "\\\\";
            break;
        case '\t':
            text += "\\t";
            break;
        case '\n':
            text += "\\n";
            break;
        default:
            text += c;
        }
}

std::optional<std::string> unescape(std::string_view text)
{
    std::string value;
    value.reserve(text.size());
    for (size_t i = 0; i < text.size(); ++i)
    {
        if (text[i] == '\t')
            return std::nullopt;
        if (text[i] != '\\')
        {
            value += text[i];
            continue;
        }
        if (++i == text.size() || (text[i] != '\\' && text[i] != 't' && text[i] != 'n'))
            return std::nullopt;
        value += text[i] == 't' ? '\t' : text[i] == 'n' ? '\n' : '\\';
    }
    return value;
}

} // namespace

std::string formatFields(const Fields& fields)
{
    std::string text;
    for (const auto& [name, value] : fields)
    {
        append(text, name);
        text += '\t';
        append(text, value);
        text += '\n';
    }
    return text;
}

std::optional<Fields> parseFields(std::string_view text)
{
    Fields fields;
    while (!text.empty())
    {
        const size_t end = text.find('\n');
        const size_t tab = text.find('\t');
        if (end == std::string_view::npos || tab > end)
            return std::nullopt;
        std::optional<std::string> name = unescape(text.substr(0, tab));
        std::optional<std::string> value = unescape(text.substr(tab + 1, end - tab - 1));
        if (!name || !value)
            return std::nullopt;
        fields.emplace_back(std::move(*name), std::move(*value));
        text.remove_prefix(end + 1);
    }
    return fields;
}

std::string_view fieldValue(const Fields& fields, std::string_view name)
{
    const auto found =
        std::find_if(fields.begin(), fields.end(), [&](const auto& field) { return field.first == name; });
    return found == fields.end() ? std::string_view() : found->second;
}

} // namespace hearth::cache

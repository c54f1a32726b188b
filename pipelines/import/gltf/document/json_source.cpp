// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf/document/json_source.h"

namespace hearth::import
{

namespace
{

constexpr std::string_view kSpace = " \t\r\n";

/// Return the end of the token that begins at `at`: punctuation, a string with its quotes, or a word.
size_t findTokenEnd(std::string_view text, size_t at)
{
    constexpr std::string_view kPunctuation = "{}[],:";
    if (kPunctuation.find(text[at]) != kPunctuation.npos)
        return at + 1;
    if (text[at] != '"')
        return std::min(text.find_first_of(" \t\r\n{}[],:", at), text.size());
    size_t end = at + 1;
    while (end < text.size() && text[end] != '"')
        end += text[end] == '\\' ? size_t{2} : size_t{1};
    return std::min(end + 1, text.size());
}

/// True if the token is a value or begins one, and is not a member's name.
bool beginsValue(std::string_view text, size_t at, size_t end)
{
    constexpr std::string_view kNoValue = "}],:";
    if (text[at] != '"')
        return kNoValue.find(text[at]) == kNoValue.npos;
    const size_t next = text.find_first_not_of(kSpace, end);
    return next == text.npos || text[next] != ':';
}

} // namespace

std::vector<std::string> cutValues(std::string_view text, std::span<const uint32_t> positions)
{
    std::vector<std::string> values;
    uint32_t position = 0; // of the next value
    size_t depth = 0;      // open containers of the value that is being cut
    bool cutting = false;
    for (size_t at = text.find_first_not_of(kSpace); at < text.size();)
    {
        const size_t end = findTokenEnd(text, at);
        if (beginsValue(text, at, end))
        {
            if (values.size() < positions.size() && positions[values.size()] == position)
            {
                values.emplace_back();
                cutting = true;
            }
            ++position;
        }
        if (cutting)
        {
            values.back() += text.substr(at, end - at);
            depth += text[at] == '{' || text[at] == '[' ? size_t{1} : size_t{0};
            depth -= text[at] == '}' || text[at] == ']' ? size_t{1} : size_t{0};
            cutting = depth > 0;
        }
        if (!cutting && values.size() == positions.size())
            break;
        at = text.find_first_not_of(kSpace, end);
    }
    return values;
}

} // namespace hearth::import

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/cache/entry_text.h"

#include "cook/tools/sha256.h"

namespace hearth::cache
{

namespace
{

constexpr std::string_view kStart = "hearth.entry/1 ";

} // namespace

std::string formatEntry(const Fields& fields)
{
    const std::string text = formatFields(fields);
    return std::string(kStart) + tools::computeSha256(text) + "\n" + text;
}

std::optional<Fields> parseEntry(std::string_view text)
{
    const size_t line = text.find('\n');
    if (line == std::string_view::npos || !text.starts_with(kStart) ||
        text.substr(kStart.size(), line - kStart.size()) != tools::computeSha256(text.substr(line + 1)))
        return std::nullopt;
    return parseFields(text.substr(line + 1));
}

} // namespace hearth::cache

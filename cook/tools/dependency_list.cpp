// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/tools/dependency_list.h"

#include "cook/tools/sha256.h"

#include <algorithm>

namespace hearth::tools
{

namespace
{

constexpr size_t kHashSize = 64;
const std::string kAbsent(kHashSize, '-');

std::string escapePath(const std::string& path)
{
    std::string text;
    for (const char c : path)
        text += c == '\\' ? "\\\\" : c == '\n' ? "\\n" : std::string(1, c);
    return text;
}

std::string unescapePath(std::string_view text)
{
    std::string path;
    for (size_t i = 0; i < text.size(); ++i)
    {
        const bool is_escape = text[i] == '\\' && i + 1 < text.size();
        i += is_escape ? 1 : 0;
        path += is_escape && text[i] == 'n' ? '\n' : text[i];
    }
    return path;
}

} // namespace

void DependencyList::addEntry(const std::string& path, std::optional<std::string> hash)
{
    const auto [known, is_new] = files_.emplace(path, hash);
    // if the file has changed between two reads, neither hash describes it
    if (!is_new && known->second != hash)
        known->second = std::nullopt;
}

void DependencyList::add(const std::string& path, std::span<const std::byte> content)
{
    addEntry(path, computeSha256(content));
}

void DependencyList::addFile(const std::string& path)
{
    addEntry(path, computeFileSha256(path));
}

void DependencyList::addAbsent(const std::string& path)
{
    addEntry(path, std::nullopt);
}

std::string DependencyList::text() const
{
    std::string text;
    for (const auto& [path, hash] : files_)
    {
        const std::string name = escapePath(path);
        text += (name == path ? "" : "\\") + hash.value_or(kAbsent) + "  " + name + "\n";
    }
    return text;
}

std::optional<DependencyList> DependencyList::parse(std::string_view text)
{
    DependencyList list;
    while (!text.empty())
    {
        const size_t end = text.find('\n');
        if (end == std::string_view::npos)
            return std::nullopt;
        std::string_view line = text.substr(0, end);
        text.remove_prefix(end + 1);
        const bool is_escaped = line.starts_with('\\');
        line.remove_prefix(is_escaped ? 1 : 0);
        if (line.size() <= kHashSize + 2 || line.substr(kHashSize, 2) != "  ")
            return std::nullopt;
        const std::string hash(line.substr(0, kHashSize));
        if (hash != kAbsent && !isSha256(hash))
            return std::nullopt;
        const std::string_view name = line.substr(kHashSize + 2);
        list.files_[is_escaped ? unescapePath(name) : std::string(name)] =
            hash == kAbsent ? std::nullopt : std::optional(hash);
    }
    return list;
}

} // namespace hearth::tools

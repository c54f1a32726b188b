// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cook/cache_maintenance.h"

#include "pipelines/cache/http_store.h"
#include "pipelines/cache/maintenance.h"
#include "pipelines/command/shell/terminal.h"

#include <fmt/format.h>

namespace hearth::command
{

namespace
{

std::string cacheLine(const cache::CacheSpec& spec, const cache::Occupancy& occupancy)
{
    return fmt::format("{}: {} entries, {} contents, {} of {}{}\n", spec.place, occupancy.entries,
                       occupancy.contents, readableSize(occupancy.bytes), readableSize(spec.limit_bytes),
                       spec.writable ? "" : ", read only");
}

// A server answers requests for keys, but lists no entries.
std::string serverLine(const cache::CacheSpec& spec)
{
    return cache::withoutCredentials(spec.place) + ": a server, which looks after itself\n";
}

std::string textOrNone(const std::string& text)
{
    return text.empty() ? "no cache is used\n" : text;
}

} // namespace

std::string cacheStatistics(std::span<const cache::CacheSpec> caches)
{
    std::string text;
    for (const cache::CacheSpec& spec : caches)
        text += spec.is_server ? serverLine(spec) : cacheLine(spec, cache::measureOccupancy(spec.place));
    return textOrNone(text);
}

std::string collectCacheGarbage(std::span<const cache::CacheSpec> caches, std::optional<uint64_t> limit_bytes)
{
    std::string text;
    for (const cache::CacheSpec& spec : caches)
        if (spec.is_server)
            text += serverLine(spec);
        else if (spec.writable)
            text +=
                cacheLine(spec, cache::collectGarbage(spec.place, limit_bytes.value_or(spec.limit_bytes)));
    return textOrNone(text);
}

CacheVerification verifyCaches(std::span<const cache::CacheSpec> caches)
{
    CacheVerification result;
    for (const cache::CacheSpec& spec : caches)
    {
        if (spec.is_server)
            result.text += serverLine(spec);
        if (spec.is_server || !spec.writable)
            continue;
        for (const std::string& damaged : cache::verifyFolder(spec.place))
        {
            result.text += fmt::format("{}: {}: damaged, removed\n", spec.place, damaged);
            result.is_intact = false;
        }
        result.text += cacheLine(spec, cache::measureOccupancy(spec.place));
    }
    result.text = textOrNone(result.text);
    return result;
}

} // namespace hearth::command

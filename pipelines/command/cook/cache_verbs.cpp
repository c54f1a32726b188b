// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cook/cache_verbs.h"

#include "pipelines/cache/http_level.h"
#include "pipelines/cache/upkeep.h"
#include "pipelines/command/shell/terminal.h"

#include <fmt/format.h>

namespace hearth::command
{

namespace
{

std::string lineOf(const cache::LevelSpec& spec, const cache::Occupancy& occupancy)
{
    return fmt::format("{}: {} entries, {} contents, {} of {}{}\n", spec.place, occupancy.entries,
                       occupancy.contents, readableSize(occupancy.bytes), readableSize(spec.limit_bytes),
                       spec.writable ? "" : ", read only");
}

// A server answers requests for keys, but lists no entries.
std::string lineOfServer(const cache::LevelSpec& spec)
{
    return cache::withoutUser(spec.place) + ": a server, which looks after itself\n";
}

std::string orNone(const std::string& text)
{
    return text.empty() ? "no cache is used\n" : text;
}

} // namespace

std::string cacheStat(std::span<const cache::LevelSpec> caches)
{
    std::string text;
    for (const cache::LevelSpec& spec : caches)
        text += spec.is_server ? lineOfServer(spec) : lineOf(spec, cache::occupancyOf(spec.place));
    return orNone(text);
}

std::string cacheGc(std::span<const cache::LevelSpec> caches, std::optional<uint64_t> limit_bytes)
{
    std::string text;
    for (const cache::LevelSpec& spec : caches)
        if (spec.is_server)
            text += lineOfServer(spec);
        else if (spec.writable)
            text += lineOf(spec, cache::collectGarbage(spec.place, limit_bytes.value_or(spec.limit_bytes)));
    return orNone(text);
}

CacheVerification cacheVerify(std::span<const cache::LevelSpec> caches)
{
    CacheVerification result;
    for (const cache::LevelSpec& spec : caches)
    {
        if (spec.is_server)
            result.text += lineOfServer(spec);
        if (spec.is_server || !spec.writable)
            continue;
        for (const std::string& damaged : cache::verifyFolder(spec.place))
        {
            result.text += fmt::format("{}: {}: damaged, removed\n", spec.place, damaged);
            result.is_whole = false;
        }
        result.text += lineOf(spec, cache::occupancyOf(spec.place));
    }
    result.text = orNone(result.text);
    return result;
}

} // namespace hearth::command

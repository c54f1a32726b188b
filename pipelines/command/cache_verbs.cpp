// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cache_verbs.h"

#include "pipelines/cache/open_cache.h"
#include "pipelines/cache/upkeep.h"
#include "pipelines/command/terminal.h"

#include <fmt/format.h>

namespace hearth::command
{

namespace
{

std::string lineOf(const cache::FolderSpec& spec, const cache::Occupancy& occupancy)
{
    return fmt::format("{}: {} entries, {} contents, {} of {}{}\n", spec.folder, occupancy.entries,
                       occupancy.contents, readableSize(occupancy.bytes), readableSize(spec.limit_bytes),
                       spec.writable ? "" : ", read only");
}

std::string orNone(const std::string& text)
{
    return text.empty() ? "no cache is used\n" : text;
}

} // namespace

Result<std::string> cacheStat(const std::vector<std::string>& caches)
{
    HEARTH_ASSIGN_OR_RETURN(const std::vector<cache::FolderSpec> specs, cache::cacheSpecs(caches));
    std::string text;
    for (const cache::FolderSpec& spec : specs)
        text += lineOf(spec, cache::occupancyOf(spec.folder));
    return orNone(text);
}

Result<std::string> cacheGc(const std::vector<std::string>& caches, std::optional<uint64_t> limit_bytes)
{
    HEARTH_ASSIGN_OR_RETURN(const std::vector<cache::FolderSpec> specs, cache::cacheSpecs(caches));
    std::string text;
    for (const cache::FolderSpec& spec : specs)
        if (spec.writable)
            text += lineOf(spec, cache::collectGarbage(spec.folder, limit_bytes.value_or(spec.limit_bytes)));
    return orNone(text);
}

Result<CacheVerification> cacheVerify(const std::vector<std::string>& caches)
{
    HEARTH_ASSIGN_OR_RETURN(const std::vector<cache::FolderSpec> specs, cache::cacheSpecs(caches));
    CacheVerification result;
    for (const cache::FolderSpec& spec : specs)
    {
        if (!spec.writable)
            continue;
        for (const std::string& damaged : cache::verifyFolder(spec.folder))
        {
            result.text += fmt::format("{}: {}: damaged, removed\n", spec.folder, damaged);
            result.is_whole = false;
        }
        result.text += lineOf(spec, cache::occupancyOf(spec.folder));
    }
    result.text = orNone(result.text);
    return result;
}

} // namespace hearth::command

// hearth cache: how full the caches are, and their upkeep.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/cache/open_cache.h"

#include <optional>
#include <span>
#include <string>

namespace hearth::command
{

std::string cacheStat(std::span<const cache::LevelSpec> caches);

/// limit_bytes  instead of each cache's own limit
std::string cacheGc(std::span<const cache::LevelSpec> caches, std::optional<uint64_t> limit_bytes);

struct CacheVerification
{
    std::string text;
    bool is_whole = true;
};

/// Read every byte of the caches that may be written, and remove what is damaged.
CacheVerification cacheVerify(std::span<const cache::LevelSpec> caches);

} // namespace hearth::command

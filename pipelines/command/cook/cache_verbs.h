// hearth cache: prints the sizes of caches, collects their garbage and verifies their contents.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/cache/open_cache.h"

#include <optional>
#include <span>
#include <string>

namespace hearth::command
{

std::string cacheStat(std::span<const cache::LevelSpec> caches);

/// Remove the least recently used entries of the writable caches, down to their limits.
/// limit_bytes  replaces each cache's own limit
std::string cacheGc(std::span<const cache::LevelSpec> caches, std::optional<uint64_t> limit_bytes);

struct CacheVerification
{
    std::string text;
    bool is_whole = true;
};

/// Read every byte of the writable caches, and remove damaged entries.
CacheVerification cacheVerify(std::span<const cache::LevelSpec> caches);

} // namespace hearth::command

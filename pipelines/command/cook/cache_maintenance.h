// hearth cache: prints the sizes of caches, collects their garbage and verifies their contents.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/cache/cache_spec.h"

#include <optional>
#include <span>
#include <string>

namespace hearth::command
{

std::string cacheStatistics(std::span<const cache::CacheSpec> caches);

/// Remove the least recently used entries of the writable caches, down to their limits.
/// limit_bytes  replaces each cache's own limit
std::string collectCacheGarbage(std::span<const cache::CacheSpec> caches,
                                std::optional<uint64_t> limit_bytes);

struct CacheVerification
{
    std::string text;
    bool is_intact = true;
};

/// Read every byte of the writable caches, and remove damaged entries.
CacheVerification verifyCaches(std::span<const cache::CacheSpec> caches);

} // namespace hearth::command

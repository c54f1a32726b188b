// hearth cache: how full the caches are, and their upkeep.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/result.h"

#include <optional>
#include <string>
#include <vector>

namespace hearth::command
{

/// caches  of --cache, here and below
Result<std::string> cacheStat(const std::vector<std::string>& caches);

/// limit_bytes  instead of each cache's own limit
Result<std::string> cacheGc(const std::vector<std::string>& caches, std::optional<uint64_t> limit_bytes);

struct CacheVerification
{
    std::string text;
    bool is_whole = true;
};

/// Read every byte of the caches that may be written, and remove what is damaged.
Result<CacheVerification> cacheVerify(const std::vector<std::string>& caches);

} // namespace hearth::command

// Chooses the caches of a cook: from the command line, else HEARTH_CACHE, else the user's own cache.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace hearth::cache
{

struct CacheSpec
{
    std::string place; ///< directory, or the URL of a server without a '/' at its end
    bool is_server = false;
    bool writable = true;
    /// of a directory: when it holds more, least recently used entries are removed
    uint64_t limit_bytes = uint64_t{20} << 30;
};

/// Parse cache specifications, "dir:PATH[,ro][,size=20G]" or "http(s)://HOST/PATH[,ro]"; several, nearest
/// first.
///
/// options   of --cache; where there is none, HEARTH_CACHE counts, with ';' between them, or "off" for none;
///           where that is not set either, $XDG_CACHE_HOME/hearth or ~/.cache/hearth. HEARTH_CACHE_MODE
///           overrides all: "ro", none is written; "off", none is used
/// errors    usage
Result<std::vector<CacheSpec>> resolveCacheSpecs(std::span<const std::string> options);

/// Parse a size in bytes, such as "512M", "20G" or "1000", in units of 1024. errors: usage, which names
/// `option`
Result<uint64_t> parseSize(const std::string& text, const std::string& option);

} // namespace hearth::cache

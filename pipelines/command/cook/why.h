// hearth why: why cookers ran for a pack or a source, and why they would run again.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/cache/open_cache.h"

#include <string>
#include <vector>

namespace hearth::command
{

/// file    a pack that was cooked here, or a source: then of all packs that it is in, what concerns it
/// errors  usage where no cook is remembered
Result<std::string> why(const std::string& file, const std::vector<cache::LevelSpec>& caches);

} // namespace hearth::command

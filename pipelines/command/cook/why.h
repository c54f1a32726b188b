// hearth why: explains why cookers ran for a pack or a source, and why they would run again.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/cache/cache_spec.h"

#include <string>
#include <vector>

namespace hearth::command
{

/// Return the explanation as text.
/// file    a pack that was cooked here, or a source: then its actions in all packs that contain it
/// errors: usage if no cook is recorded
Result<std::string> why(const std::string& file, const std::vector<cache::CacheSpec>& caches);

} // namespace hearth::command

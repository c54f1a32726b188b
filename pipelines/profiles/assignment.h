// Parses settings of cookers as they are written on a command line.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "pipelines/settings/value.h"

#include <string>
#include <utility>

namespace hearth::profiles
{

/// Parse an assignment as it follows --set, such as "clusters.influences=4".
/// errors: profile_key, profile_value.
Result<std::pair<std::string, settings::Value>> parseAssignment(const std::string& text);

} // namespace hearth::profiles

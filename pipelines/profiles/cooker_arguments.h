// Converts settings into command-line arguments of cookers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/graph/cook_graph.h"
#include "pipelines/profiles/config_file.h"

#include <optional>

namespace hearth::profiles
{

/// Return the command-line arguments for a source's cookers. Unset settings are omitted, so changing a
/// default only re-keys that setting. errors: profile_value where visibility.power is set without
/// visibility.distance.
Result<graph::SourceSettings> makeCookerArguments(const Values& values);

/// Return the options of hearth-bricks; nullopt where bricks are not enabled.
std::optional<graph::BrickOptions> makeBrickOptions(const Values& values);

} // namespace hearth::profiles

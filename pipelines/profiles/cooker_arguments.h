// What cookers are told of the settings that hold.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/graph/cook_graph.h"
#include "pipelines/profiles/config_file.h"

#include <optional>

namespace hearth::profiles
{

/// What the cookers of a source are told: nothing of what nobody has set, so that a default that is written down changes no
/// key but its own. errors: profile_value where visibility.power stands without visibility.distance.
Result<graph::SourceSettings> toldOfSource(const Values& values);

/// Nothing where bricks are not enabled.
std::optional<graph::BrickOptions> toldOfBricks(const Values& values);

} // namespace hearth::profiles

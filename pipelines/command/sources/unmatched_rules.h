// Warns of rules of hearth.toml that match nothing.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "pipelines/profiles/configuration.h"

#include <string>
#include <vector>

namespace hearth::command
{

/// Return a warning, rule_unmatched, for each rule that applies in the chosen profile and matches neither a
/// source nor a model in the project's folder or below. It names the rule's place and the nearest path. A
/// rule for models that are not cooked this time is fine.
/// sources  as the user typed them; none: only the models of the project count, and if it has none there is
///          no warning
std::vector<Error> findUnmatchedRules(const profiles::Configuration& configuration,
                                      const std::vector<std::string>& sources);

} // namespace hearth::command

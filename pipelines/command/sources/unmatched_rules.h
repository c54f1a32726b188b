// Warns of rules of hearth.toml that match nothing.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "pipelines/profiles/configuration.h"

#include <string>
#include <vector>

namespace hearth::command
{

/// A warning, rule_unmatched, for each rule that holds in the chosen profile and matches neither a source nor
/// a model in the project's folder or below: it names the rule's place and the path that is nearest. A rule
/// for models that are not cooked this time is fine.
/// sources  as the user typed them; none: what the project has counts alone, and where it has no model
///          nothing is amiss
std::vector<Error> unmatchedRules(const profiles::Configuration& configuration,
                                  const std::vector<std::string>& sources);

} // namespace hearth::command

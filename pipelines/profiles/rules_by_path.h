// Chooses the rules by path that are for a source, in settings that are lists of rules.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/settings/value.h"

#include <string>
#include <vector>

namespace hearth::profiles
{

/// Replace lists of rules by those for one source: rules whose path does not match it are left out, the
/// others lose their path, and those without a name get one that matches all. So caches and farms do not see
/// where a source lies. A list without rules is no value.
/// path  of the source, as matchesPath
void selectRulesByPath(const std::string& path, settings::Values& values);

/// Rule with a path.
struct PathRule
{
    std::string origin; ///< place where its list was set
    std::string place;  ///< "textures.image[1]"
    std::string path;   ///< pattern, see matchesPath
};

/// Return the rules of all lists that have a path.
std::vector<PathRule> listPathRules(const settings::Values& values);

} // namespace hearth::profiles

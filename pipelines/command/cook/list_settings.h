// hearth config: every setting, what it is, and where that was set.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/profiles/configuration.h"

#include <string>

namespace hearth::command
{

/// A line for each setting. What nobody has set stands in brackets.
/// source  whose rules hold, too; empty: those of all
std::string settingsText(const profiles::Configuration& configuration, const std::string& source,
                         bool shows_origin);

/// The same as JSON, with origins: schema hearth.settings/1.
std::string settingsJson(const profiles::Configuration& configuration, const std::string& source);

} // namespace hearth::command

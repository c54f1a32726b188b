// hearth config: lists every setting with its value and origin.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/profiles/configuration.h"

#include <string>

namespace hearth::command
{

/// Return a line for each setting. Defaults are in brackets.
/// source  whose rules apply, too; empty: settings of all sources
std::string settingsText(const profiles::Configuration& configuration, const std::string& source,
                         bool shows_origin);

/// Return the same as JSON, with origins: schema hearth.settings/1.
std::string settingsJson(const profiles::Configuration& configuration, const std::string& source);

} // namespace hearth::command

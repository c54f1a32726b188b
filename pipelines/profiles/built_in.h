// Built-in profiles.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/profiles/config_file.h"

namespace hearth::profiles
{

/// Return the built-in profiles "mobile-high", "mobile-low", "gles3" and "desktop" as a file of settings.
const ConfigFile& builtInProfiles();

/// Return the text of that file.
std::string_view builtInText();

} // namespace hearth::profiles

// The profiles that Hearth comes with.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/profiles/config_file.h"

namespace hearth::profiles
{

/// A file of settings with the profiles "mobile-high", "mobile-low" and "desktop".
const ConfigFile& builtIn();

/// Its text.
std::string_view builtInText();

} // namespace hearth::profiles

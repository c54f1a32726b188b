// Table of the settings of the hearth command, which change no byte of a pack.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/settings/setting.h"

#include <span>

namespace hearth::profiles
{

/// Return the settings of the table [defaults].
std::span<const settings::Setting> commandSettings();

} // namespace hearth::profiles

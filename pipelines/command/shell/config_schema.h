// Generates the JSON Schema of hearth.toml from the table of settings, for completion and checks in editors.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <string>

namespace hearth::command
{

std::string configSchema();

} // namespace hearth::command

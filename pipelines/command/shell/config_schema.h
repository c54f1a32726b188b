// The JSON Schema of hearth.toml, from the table of settings: editors complete and check by it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <string>

namespace hearth::command
{

std::string configSchema();

} // namespace hearth::command

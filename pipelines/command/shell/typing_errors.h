// Corrections for mistyped words of the command line.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/command_line/command_info.h"

#include <string>
#include <vector>

namespace hearth::command
{

/// returns  a message about the first of `words` that no verb or option is called, with the nearest that is;
///          empty where all are known
std::string unknownWord(const cli::CommandInfo& hearth, const std::vector<std::string>& words);

} // namespace hearth::command

// Suggests corrections for mistyped words of the command line.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/command_line/command_info.h"

#include <string>
#include <vector>

namespace hearth::command
{

/// Find the first of `words` that is no known verb or option.
/// returns  a message about it, with the nearest known word; empty if all are known
std::string findUnknownWord(const cli::CommandInfo& hearth, const std::vector<std::string>& words);

} // namespace hearth::command

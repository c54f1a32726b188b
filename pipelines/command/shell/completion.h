// hearth completion: what a shell needs to complete a line that starts with hearth.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/command_line/command_info.h"

#include <string>

namespace hearth::command
{

/// A script for bash, zsh or fish: verbs, options, the words that an option may have, and files where it has none.
std::string bashCompletion(const cli::CommandInfo& hearth);
std::string zshCompletion(const cli::CommandInfo& hearth);
std::string fishCompletion(const cli::CommandInfo& hearth);

} // namespace hearth::command

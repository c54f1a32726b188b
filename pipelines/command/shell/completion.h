// hearth completion: generates scripts that complete command lines of hearth in a shell.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/command_line/command_info.h"

#include <string>

namespace hearth::command
{

/// Return a script for bash, zsh or fish. It completes verbs, options, the choices of an option, and file
/// names for options without choices.
std::string bashCompletion(const cli::CommandInfo& hearth);
std::string zshCompletion(const cli::CommandInfo& hearth);
std::string fishCompletion(const cli::CommandInfo& hearth);

} // namespace hearth::command

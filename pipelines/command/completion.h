// hearth completion: what a shell needs to complete a line that starts with hearth.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/command/command_table.h"

#include <string>

namespace hearth::command
{

/// A script for bash, zsh or fish: verbs, options, the words that an option may have, and files where it has none.
std::string bashCompletion(const CommandTable& table);
std::string zshCompletion(const CommandTable& table);
std::string fishCompletion(const CommandTable& table);

} // namespace hearth::command

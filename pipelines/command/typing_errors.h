// What somebody may have meant who mistyped a word of the command line.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <string>
#include <vector>

namespace CLI
{
class App;
} // namespace CLI

namespace hearth::command
{

/// The first word that no verb or option is called, with the nearest that is; empty where all are known.
std::string unknownWord(const CLI::App& app, const std::vector<std::string>& words);

} // namespace hearth::command

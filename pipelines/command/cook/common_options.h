// Options of every verb: -C, --config, --color, --log-format.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/command_line/command_line.h"
#include "pipelines/cache/open_cache.h"
#include "pipelines/profiles/configuration.h"

#include <string>
#include <vector>

namespace hearth::command
{

/// Add them to the command; its verbs take them, too.
void addCommonOptions(cli::CommandLine& app);

/// Do what they say, before the verb does its work. errors: input_missing where there is no folder of -C.
Status applyCommonOptions();

/// The configuration with what the command line says, --config included. errors: those of Configuration::load.
Result<profiles::Configuration> loadConfiguration(profiles::Given given);

/// The caches of the configuration; none: as cache::cacheSpecs decides.
std::vector<std::string> cachesOf(const profiles::Configuration& configuration);

/// The same, read. errors: usage.
Result<std::vector<cache::LevelSpec>> levelsOf(const profiles::Configuration& configuration);

/// The words of a command line, each "@FILE" replaced by the lines of that file; empty lines and those that start with # are
/// left out. A file that starts with @ is named as ./@FILE. errors: input_missing.
Result<std::vector<std::string>> withArgumentFiles(const std::vector<std::string>& words);

} // namespace hearth::command

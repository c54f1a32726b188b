// Defines the options of every verb: -C, --config, --color, --log-format.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/command_line/command_line.h"
#include "pipelines/cache/cache_spec.h"
#include "pipelines/profiles/configuration.h"

#include <string>
#include <vector>

namespace hearth::command
{

/// Add the common options to the command; its verbs accept them, too.
void addCommonOptions(cli::CommandLine& app);

/// Apply the common options, before the verb does its work. errors: input_missing if the folder of -C does
/// not exist.
Status applyCommonOptions();

/// Load the configuration with the settings of the command line, --config included. errors: those of
/// Configuration::load.
Result<profiles::Configuration> loadConfiguration(profiles::CommandLineValues overrides);

/// Return the caches of the configuration; none: cache::resolveCacheSpecs decides.
std::vector<std::string> cacheSettings(const profiles::Configuration& configuration);

/// Parse the caches of the configuration. errors: usage.
Result<std::vector<cache::CacheSpec>> readCacheSpecs(const profiles::Configuration& configuration);

/// Replace each word "@FILE" of a command line by the lines of that file, without empty lines and lines that
/// start with #. A file whose name starts with @ is written as ./@FILE. errors: input_missing.
Result<std::vector<std::string>> expandArgumentFiles(const std::vector<std::string>& words);

} // namespace hearth::command

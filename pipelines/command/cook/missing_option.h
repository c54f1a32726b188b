// Option --missing of all verbs that make a pack: what becomes of it where a source cannot be cooked.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/command_line/command_line.h"

#include <string>
#include <vector>

namespace hearth::command
{

inline constexpr const char* kMissingError = "error"; ///< there is no pack
inline constexpr const char* kMissingSkip = "skip";   ///< the pack is made without the source; exit code 1

/// Add --missing with the words "error" and "skip", of which "error" is the default.
/// missing      receives the word
/// description  help text; `more_words` are further words that it explains
void addMissingOption(cli::CommandLine& verb, std::string& missing, const std::string& description,
                      const std::vector<std::string>& more_words = {});

} // namespace hearth::command

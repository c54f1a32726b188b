// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cook/missing_option.h"

namespace hearth::command
{

void addMissingOption(cli::CommandLine& verb, std::string& missing, const std::string& description,
                      const std::vector<std::string>& more_words)
{
    std::vector<std::string> words{kMissingError, kMissingSkip};
    words.insert(words.end(), more_words.begin(), more_words.end());
    missing = kMissingError;
    verb.addOption("--missing", missing, description).choices(words).showDefault();
}

} // namespace hearth::command

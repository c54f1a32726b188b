// Describes commands and options as data, for manual pages, completion and messages about mistyped words.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <string>
#include <vector>

namespace hearth::cli
{

struct OptionInfo
{
    std::vector<std::string> names; ///< "-j", "--jobs"; for a positional its name: "SOURCE"
    std::string value;              ///< placeholder, as "N"; empty for a flag or positional
    std::vector<std::string> choices;
    std::string description;
    bool is_required = false;
    bool may_repeat = false;
};

struct CommandInfo
{
    std::string name;
    std::string description;
    std::vector<OptionInfo> positionals; ///< this list and the ones below: in order of addition
    std::vector<OptionInfo> options;
    std::string footer; ///< examples
    std::vector<CommandInfo> subcommands;
};

} // namespace hearth::cli

// The verbs and options of the command as data, for what is made of them: completion and manual pages.
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

struct OptionEntry
{
    std::vector<std::string> names; ///< "-j", "--jobs"; of a positional its name: "SOURCE"
    std::string value;              ///< "N"; empty: a flag, or a positional
    std::vector<std::string> choices;
    std::string what;
    bool is_required = false;
    bool may_repeat = false;
};

struct VerbEntry
{
    std::string name;
    std::string what;
    std::vector<OptionEntry> positionals;
    std::vector<OptionEntry> options;
    std::string footer; ///< examples
};

struct CommandTable
{
    VerbEntry command; ///< "hearth" with the options that every verb takes
    std::vector<VerbEntry> verbs;
};

/// All that the command line knows of itself, in the order in which it was added.
CommandTable tableOf(const CLI::App& app);

} // namespace hearth::command

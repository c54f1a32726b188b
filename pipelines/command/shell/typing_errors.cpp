// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/shell/typing_errors.h"

#include "formats/base/nearest_match.h"

#include <algorithm>
#include <utility>

namespace hearth::command
{

namespace
{

std::string describeUnknown(const std::string& kind, const std::string& word, const std::string& nearest)
{
    return "unknown " + kind + " '" + word + "'" +
           (nearest.empty() ? std::string() : ": did you mean '" + nearest + "'?");
}

/// Find an option by name; null if there is none.
const cli::OptionInfo* findOption(const cli::CommandInfo& command, const std::string& name)
{
    const auto has_name = [&](const cli::OptionInfo& option)
    { return std::find(option.names.begin(), option.names.end(), name) != option.names.end(); };
    const auto found = std::find_if(command.options.begin(), command.options.end(), has_name);
    return found == command.options.end() ? nullptr : &*found;
}

std::string unknownOption(const cli::CommandInfo& hearth, const cli::CommandInfo& verb,
                          const std::string& name)
{
    std::vector<std::string> names;
    for (const cli::CommandInfo* known : {&verb, &hearth})
        for (const cli::OptionInfo& option : known->options)
            for (const std::string& known_name : option.names)
                if (known_name.starts_with("--"))
                    names.push_back(known_name);
    return describeUnknown("option", name, nearestMatch(name, names));
}

std::string unknownVerb(const cli::CommandInfo& command, const std::string& word)
{
    std::vector<std::string> names;
    for (const cli::CommandInfo& known : command.subcommands)
        names.push_back(known.name);
    return describeUnknown("verb", word, nearestMatch(word, names));
}

} // namespace

std::string findUnknownWord(const cli::CommandInfo& hearth, const std::vector<std::string>& words)
{
    const cli::CommandInfo* verb = &hearth;
    bool is_value = false; // the word is the value of an option before the verb
    for (const std::string& word : words)
    {
        if (std::exchange(is_value, false))
            continue;
        const bool is_option = word.size() > 1 && word[0] == '-' && word.find_first_of("0123456789.") != 1;
        if (word == "--")
            break;
        if (is_option)
        {
            const std::string name = word.substr(0, word.find('='));
            // -j4 and -qv are short options with a value or more options in the same word
            const std::string shortened = name[1] == '-' ? name : name.substr(0, 2);
            const cli::OptionInfo* common = findOption(hearth, shortened);
            if (common == nullptr && findOption(*verb, shortened) == nullptr)
                return unknownOption(hearth, *verb, name);
            is_value = verb == &hearth && !common->value.empty() && word == shortened;
            continue;
        }
        // verbs may have subcommands
        if (verb->subcommands.empty())
            continue;
        const auto chosen = std::find_if(verb->subcommands.begin(), verb->subcommands.end(),
                                         [&](const cli::CommandInfo& known) { return known.name == word; });
        if (chosen == verb->subcommands.end())
            return unknownVerb(*verb, word);
        verb = &*chosen;
    }
    return "";
}

} // namespace hearth::command

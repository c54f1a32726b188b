// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/typing_errors.h"

#include "cook/tools/suggest.h"

#include <CLI/CLI.hpp>
#include <utility>

namespace hearth::command
{

std::string unknownWord(const CLI::App& app, const std::vector<std::string>& words)
{
    const auto describe = [](const std::string& kind, const std::string& word, const std::string& nearest)
    {
        return "unknown " + kind + " '" + word + "'" +
               (nearest.empty() ? std::string() : ": did you mean '" + nearest + "'?");
    };
    const CLI::App* verb = &app;
    bool is_value = false; // of an option that stands before the verb
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
            // -j4 and -qv are short options with more in the same word
            const std::string shortened = name[1] == '-' ? name : name.substr(0, 2);
            const CLI::Option* common = app.get_option_no_throw(shortened);
            is_value = verb == &app && common != nullptr && common->get_items_expected_max() > 0 &&
                       word == shortened;
            if (common != nullptr || verb->get_option_no_throw(shortened) != nullptr)
                continue;
            std::vector<std::string> names;
            for (const CLI::App* known : {verb, &app})
                for (const CLI::Option* option : known->get_options())
                    for (const std::string& long_name : option->get_lnames())
                        names.push_back("--" + long_name);
            return describe("option", name, tools::nearestMatch(name, names));
        }
        // a verb may have verbs of its own
        const std::vector<const CLI::App*> known_verbs = verb->get_subcommands(nullptr);
        if (known_verbs.empty())
            continue;
        std::vector<std::string> names;
        const CLI::App* chosen = nullptr;
        for (const CLI::App* known : known_verbs)
        {
            names.push_back(known->get_name());
            if (known->get_name() == word)
                chosen = known;
        }
        if (chosen == nullptr)
            return describe("verb", word, tools::nearestMatch(word, names));
        verb = chosen;
    }
    return "";
}

} // namespace hearth::command

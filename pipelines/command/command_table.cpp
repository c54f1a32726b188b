// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/command_table.h"

#include <CLI/CLI.hpp>
#include <sstream>

namespace hearth::command
{

namespace
{

std::vector<std::string> split(const std::string& text, char separator)
{
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, separator);)
        parts.push_back(part);
    return parts;
}

OptionEntry entryOf(const CLI::Option& option)
{
    OptionEntry entry;
    for (const std::string& name : option.get_snames())
        entry.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames())
        entry.names.push_back("--" + name);
    if (entry.names.empty())
        entry.names.push_back(option.get_name(true));
    entry.what = option.get_description();
    entry.is_required = option.get_required();
    entry.may_repeat = option.get_items_expected_max() > 1 || option.get_expected_max() > 1;
    // "TEXT:{text,json}" of CLI11's own check, "draft|default|high" of ours, "UINT:INT in [1 - 9]" of a range
    const std::string type = option.get_type_name();
    const size_t open = type.find('{');
    if (open != std::string::npos)
        entry.choices = split(type.substr(open + 1, type.find('}') - open - 1), ',');
    else if (type.find('|') != std::string::npos)
        entry.choices = split(type, '|');
    if (option.get_items_expected_max() > 0 && option.nonpositional())
        entry.value = entry.choices.empty() ? type.substr(0, type.find(':')) : "NAME";
    return entry;
}

VerbEntry entryOf(const CLI::App& app)
{
    VerbEntry verb{app.get_name(), app.get_description(), {}, {}, app.get_footer()};
    for (const CLI::Option* option : app.get_options())
        (option->nonpositional() ? verb.options : verb.positionals).push_back(entryOf(*option));
    return verb;
}

} // namespace

CommandTable tableOf(const CLI::App& app)
{
    CommandTable table{entryOf(app), {}};
    for (const CLI::App* verb : app.get_subcommands(nullptr))
        table.verbs.push_back(entryOf(*verb));
    return table;
}

} // namespace hearth::command

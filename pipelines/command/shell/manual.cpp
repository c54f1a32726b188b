// Writes manual pages with the macros of man(7). A line that starts with . or ' is a macro and a backslash
// starts an escape, so text has to be escaped.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/shell/manual.h"

#include "pipelines/command/shell/explain.h"
#include "pipelines/cookers/registry.h"
#include "pipelines/profiles/built_in.h"
#include "pipelines/profiles/command_settings.h"

#include <algorithm>
#include <fmt/format.h>
#include <sstream>

namespace hearth::command
{

namespace
{

using settings::Kind;
using settings::Setting;

/// Escape text, so that it is printed as it is.
std::string plain(std::string_view text)
{
    std::string roff;
    for (const char c : text)
        if (c == '\\')
            roff += "\\e";
        else if (c == '-')
            roff += "\\-";
        else if (c == '\'')
            roff += "\\(aq";
        else if (c == '^')
            roff += "\\(ha";
        else if (c == '~')
            roff += "\\(ti";
        else if (c == '`')
            roff += "\\(ga";
        else
            roff += c;
    return roff.starts_with('.') ? "\\&" + roff : roff;
}

std::string bold(std::string_view text)
{
    return "\\fB" + plain(text) + "\\fR";
}

std::string italic(std::string_view text)
{
    return "\\fI" + plain(text) + "\\fR";
}

/// Format lines that are not filled (wrapped again).
std::string block(const std::string& text)
{
    std::string roff = ".nf\n";
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        roff += (line.empty() ? "\\&" : plain(line)) + "\n";
    return roff + ".fi\n";
}

std::string pageHead(const std::string& name, int section, const std::string& what)
{
    std::string title = name;
    std::transform(title.begin(), title.end(), title.begin(),
                   [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
    // no date, so that the page of a release does not depend on the day of its build
    return fmt::format(".TH {} {} \"\" \"hearth " HEARTH_VERSION "\" \"Hearth\"\n.SH NAME\n{} \\- {}\n",
                       title, section, plain(name), plain(what));
}

std::string optionText(const cli::OptionInfo& option)
{
    std::string text = ".TP\n";
    for (size_t i = 0; i < option.names.size(); ++i)
        text += (i == 0 ? "" : ", ") + bold(option.names[i]);
    if (!option.choices.empty())
    {
        text += " ";
        for (size_t i = 0; i < option.choices.size(); ++i)
            text += (i == 0 ? "" : "|") + bold(option.choices[i]);
    }
    else if (!option.value.empty())
        text += " " + italic(option.value);
    return text + "\n" + plain(option.description) + ".\n";
}

std::string synopsis(const cli::CommandInfo& verb)
{
    std::string text = ".SH SYNOPSIS\n" + bold("hearth " + verb.name) + " [" + italic("OPTIONS") + "]";
    for (const cli::OptionInfo& positional : verb.positionals)
    {
        const std::string name = italic(positional.names.front()) + (positional.may_repeat ? " ..." : "");
        text += positional.is_required ? " " + name : " [" + name + "]";
    }
    for (const cli::OptionInfo& option : verb.options)
        if (option.is_required)
            text += " " + bold(option.names.front()) + " " + italic(option.value);
    return text + "\n";
}

ManualPage verbPage(const cli::CommandInfo& verb)
{
    std::string text = pageHead("hearth-" + verb.name, 1, verb.description) + synopsis(verb);
    if (!verb.positionals.empty())
        text += ".SH ARGUMENTS\n";
    for (const cli::OptionInfo& positional : verb.positionals)
        text += optionText(positional);
    text += ".SH OPTIONS\n";
    for (const cli::OptionInfo& option : verb.options)
        text += optionText(option);
    if (!verb.footer.empty())
        text += ".SH EXAMPLES\n" + block(verb.footer);
    text += ".SH EXIT STATUS\n" + block(exitCodeTable());
    text += ".SH SEE ALSO\n.BR hearth (1),\n.BR hearth.toml (5)\n";
    return {"hearth-" + verb.name + ".1", text};
}

ManualPage commandPage(const cli::CommandInfo& hearth)
{
    std::string text = pageHead("hearth", 1, "cook assets into packs that a phone can stream and draw");
    text += ".SH SYNOPSIS\n" + bold("hearth") + " [" + italic("OPTIONS") + "] " + italic("VERB") + " ...\n";
    text += ".SH DESCRIPTION\nTurns glTF scenes and scans into one packed file, and looks into such files. "
            "Results go to standard output,\nmessages to standard error, each in one line with a number that "
            "\\fBhearth explain\\fR knows.\n.SH VERBS\n";
    for (const cli::CommandInfo& verb : hearth.subcommands)
        text += ".TP\n" + fmt::format("\\fB{}\\fR", plain(verb.name)) + "\n" + plain(verb.description) +
                ".\nSee " + bold("hearth-" + verb.name) + "(1).\n";
    text += ".SH OPTIONS\nEvery verb takes these. A word " + bold("@") + italic("FILE") +
            " stands for the lines of that file.\n";
    for (const cli::OptionInfo& option : hearth.options)
        text += optionText(option);
    text += ".SH ENVIRONMENT\n";
    for (const Setting& setting : profiles::commandSettings())
    {
        if (!setting.variable.empty())
            text += ".TP\n" + bold(setting.variable) + "\n" + plain(setting.what) +
                    (setting.kind == Kind::choice ? ": " + plain(settings::rangeText(setting)) : "") + ".\n";
        for (const settings::EnvironmentSwitch& one : setting.switches)
            text += ".TP\n" + bold(one.variable) + "\nset, and not 0: " + plain(setting.key) + " is " +
                    plain(one.value) + ".\n";
    }
    text += ".TP\n" + bold("HEARTH_CONFIG") +
            "\nfile of settings, instead of hearth.toml here or above; off: none.\n";
    text +=
        ".TP\n" + bold("HEARTH_CACHE_MODE") + "\nrw, ro: caches are not written, off: no cache is used.\n";
    text += ".PP\nThe command line goes over the environment, that over hearth.toml, that over "
            "\\(ti/.config/hearth/config.toml.\n";
    text += ".SH FILES\n.TP\n.I hearth.toml\nsettings of a project, see " + bold("hearth.toml") +
            "(5).\n.TP\n.I \\(ti/.config/hearth/config.toml\nsettings of a user.\n.TP\n.I "
            "\\(ti/.cache/hearth\nresults that are kept.\n";
    text += ".SH EXIT STATUS\n" + block(exitCodeTable());
    text += ".SH SEE ALSO\n.BR hearth.toml (5)\n";
    return {"hearth.1", text};
}

std::string settingText(const Setting& setting, const std::string& name)
{
    std::string text = ".TP\n" + bold(name) + "\n" + plain(setting.what) + ": " +
                       plain(settings::rangeText(setting)) + ".\n";
    if (!setting.default_text.empty())
        text += "By default " + plain(setting.default_text) + ".\n";
    if (!setting.option.empty())
        text += "On the command line " + bold(setting.option.substr(setting.option.find("--"))) + ".\n";
    if (setting.members.empty())
        return text;
    text += ".RS\n";
    for (const Setting& member : setting.members)
        text += settingText(member, member.key + (member.is_required ? " (needed)" : ""));
    return text + ".RE\n";
}

ManualPage configPage()
{
    std::string text = pageHead("hearth.toml", 5, "settings of a project");
    text +=
        ".SH DESCRIPTION\nA TOML file at the root of a project. hearth looks for it in the working folder "
        "and "
        "in those above. Strict: what\nis not known is an error. \\fBhearth config \\-\\-show\\-origin\\fR "
        "says which settings hold, and where they come from.\n";
    text += ".SH TABLES\n.TP\n" + bold("[defaults]") + "\noptions of the command, below.\n.TP\n" +
            bold("[profile.NAME]") + "\nsettings of sources and of the pack, and " + bold("inherits") +
            ": the name of another profile. Chosen by " + bold("hearth cook --profile") + " " +
            italic("NAME") + ", or by " + bold("profile") + " in [defaults].\n.TP\n" + bold("[[rule]]") +
            "\nsettings of the sources whose path from here matches the pattern " + bold("match") +
            ": * stands for any characters of a name, ? for one, ** for any number of folders. With " +
            bold("in_profile") +
            " only where the profile is called so. Of several rules, later ones go over "
            "earlier ones.\n";
    text += ".SH DEFAULTS\n";
    for (const Setting& setting : profiles::commandSettings())
        text += settingText(setting, setting.key);
    text += ".SH SETTINGS\n";
    for (const Setting& setting : cookers::profileSettings())
        text += settingText(setting, setting.key);
    text += ".SH PROFILES THAT ARE BUILT IN\n" + block(std::string(profiles::builtInText()));
    text += ".SH EXAMPLE\n" +
            block("[defaults]\nprofile = \"phone\"\n\n[profile.phone]\ninherits = \"mobile-low\"\n"
                  "clusters.levels = [{ keep = 0.45 }]\n\n[[rule]]\nmatch = \"assets/props/**\"\n"
                  "textures.max_size = 512\n");
    text += ".SH SEE ALSO\n.BR hearth (1),\n.BR hearth\\-config (1)\n";
    return {"hearth.toml.5", text};
}

} // namespace

std::vector<ManualPage> manualPages(const cli::CommandInfo& hearth)
{
    std::vector<ManualPage> pages{commandPage(hearth)};
    for (const cli::CommandInfo& verb : hearth.subcommands)
        pages.push_back(verbPage(verb));
    pages.push_back(configPage());
    return pages;
}

} // namespace hearth::command

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/profiles/command_settings.h"

#include "pipelines/settings/make_setting.h"

namespace hearth::profiles
{

using namespace settings;

namespace
{

Setting withVariable(Setting setting, std::string_view variable)
{
    setting.variable = variable;
    return setting;
}

Setting withSwitches(Setting setting, std::vector<EnvironmentSwitch> switches)
{
    setting.switches = std::move(switches);
    return setting;
}

std::vector<Setting> makeCommandSettings()
{
    std::vector<Setting> settings{
        withVariable(withOption({"profile", Kind::text,
                                 "how far sources are cooked down: mobile-high, mobile-low, gles3, desktop, "
                                 "one of hearth.toml, or a TOML file",
                                 "none: each cooker's defaults"},
                                "-p,--profile", "NAME"),
                     "HEARTH_PROFILE"),
        withVariable(withOption(wholeNumberSetting("jobs", "cookers that run at once",
                                                   "2, and of small sources one a core", 1, 1024),
                                "-j,--jobs", "N"),
                     "HEARTH_JOBS"),
        withVariable(withOption({"memory", Kind::size, "what the cookers may take together, as 12G",
                                 "three quarters of the machine's"},
                                "--memory", "SIZE"),
                     "HEARTH_MEMORY"),
        withVariable(
            withOption(
                {"cache", Kind::texts,
                 "dir:FOLDER[,ro][,size=20G] or http(s)://HOST/PATH[,ro]; may be repeated, nearest first",
                 "the user's own"},
                "--cache", "SPEC"),
            "HEARTH_CACHE"),
        withVariable(
            choiceSetting(
                "log",
                "which messages are printed: errors only, or also all messages of cookers; -q and -v "
                "of the command line",
                "normal", {"quiet", "normal", "verbose"}),
            "HEARTH_LOG"),
        withVariable(
            withOption(
                choiceSetting("progress",
                              "what is shown meanwhile; auto: a bar on a terminal, else a line for each "
                              "source and one every ten seconds",
                              "auto", {"auto", "bar", "plain", "none"}),
                "--progress", "NAME"),
            "HEARTH_PROGRESS"),
        withSwitches(
            withOption(choiceSetting("color",
                                     "of messages; auto: on a terminal, as NO_COLOR, CLICOLOR_FORCE and "
                                     "CI say",
                                     "auto", {"auto", "always", "never"}),
                       "--color", "NAME"),
            {{"NO_COLOR", "never"}, {"CLICOLOR_FORCE", "always"}}),
    };
    for (Setting& setting : settings)
        setting.scope = Scope::command;
    return settings;
}

} // namespace

std::span<const Setting> commandSettings()
{
    static const std::vector<Setting> settings = makeCommandSettings();
    return settings;
}

} // namespace hearth::profiles

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cook/list_settings.h"
#include "pipelines/command/cook/setting_options.h"
#include "pipelines/command/shell/messages.h"
#include "pipelines/command/shell/verb_tools.h"
#include "pipelines/command/shell/verbs.h"
#include "pipelines/command/sources/unmatched_rules.h"

namespace hearth::command
{

void addConfig(cli::CommandLine& app, VerbAction& run)
{
    cli::CommandLine& verb = app.addSubcommand("config", "Say which settings hold, and where they come from");
    struct Options
    {
        std::string source;
        SettingOptions settings;
        bool shows_origin = false;
        std::string format = "text";
    };
    auto options = std::make_shared<Options>();
    verb.addOption("SOURCE", options->source,
                   "what holds for this source: rules may match it; by default what holds for all");
    verb.addFlag("--show-origin", options->shows_origin, "say where each was set");
    addFormat(verb, options->format);
    options->settings.addCommandSettings(verb, {"profile", "jobs", "memory", "cache", "progress"});
    options->settings.addProfileSettings(verb);
    verb.setFooter("Examples:\n"
                   "  hearth config --show-origin\n"
                   "  hearth config props/barrel.glb --profile mobile-low --show-origin");
    verb.setAction(
        [options, &run]
        {
            run = withConfiguration(options->settings,
                                    [options](const profiles::Configuration& configuration)
                                    {
                                        if (options->source.empty())
                                            for (const Error& warning : findUnmatchedRules(configuration, {}))
                                                printMessage(formatMessage(warning));
                                        return printResult(options->format == "json"
                                                               ? settingsJson(configuration, options->source)
                                                               : settingsText(configuration, options->source,
                                                                              options->shows_origin));
                                    });
        });
}

} // namespace hearth::command

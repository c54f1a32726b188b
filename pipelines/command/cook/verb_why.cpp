// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cook/common_options.h"
#include "pipelines/command/cook/setting_options.h"
#include "pipelines/command/cook/why.h"
#include "pipelines/command/shell/verb_tools.h"
#include "pipelines/command/shell/verbs.h"

namespace hearth::command
{

void addWhy(cli::CommandLine& app, VerbAction& run)
{
    cli::CommandLine& verb = app.addSubcommand("why", "Say why cookers ran, and why they would run again");
    struct Options
    {
        std::string file;
        SettingOptions settings;
    };
    auto options = std::make_shared<Options>();
    verb.addOption("FILE", options->file, "pack that was cooked here, or a source of one").required();
    options->settings.addCommandSettings(verb, {"cache"});
    verb.setFooter("Example: hearth why village.hearth");
    verb.setAction(
        [options, &run]
        {
            run = withConfiguration(options->settings,
                                    [options](const profiles::Configuration& configuration)
                                    {
                                        const auto caches = readCacheSpecs(configuration);
                                        return caches.ok() ? printResult(why(options->file, *caches))
                                                           : printError(caches.error());
                                    });
        });
}

} // namespace hearth::command

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/common_options.h"
#include "pipelines/command/setting_options.h"
#include "pipelines/command/verb_tools.h"
#include "pipelines/command/verbs.h"
#include "pipelines/command/why.h"

#include <CLI/CLI.hpp>

namespace hearth::command
{

void addWhy(CLI::App& app, Work& run)
{
    CLI::App* verb = app.add_subcommand("why", "Say why cookers ran, and why they would run again");
    struct Options
    {
        std::string file;
        SettingOptions settings;
    };
    auto options = std::make_shared<Options>();
    verb->add_option("FILE", options->file, "pack that was cooked here, or a source of one")->required();
    options->settings.addOfCommand(*verb, {"cache"});
    verb->footer("Example: hearth why village.hearth");
    verb->callback(
        [options, &run]
        {
            run = withConfiguration(options->settings,
                                    [options](const profiles::Configuration& configuration)
                                    {
                                        const auto caches = levelsOf(configuration);
                                        return caches.ok() ? printResult(why(options->file, *caches))
                                                           : fail(caches.error());
                                    });
        });
}

} // namespace hearth::command

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/common_options.h"
#include "pipelines/command/doctor.h"
#include "pipelines/command/setting_options.h"
#include "pipelines/command/verb_tools.h"
#include "pipelines/command/verbs.h"

#include <CLI/CLI.hpp>

namespace hearth::command
{

void addDoctor(CLI::App& app, Work& run)
{
    CLI::App* verb = app.add_subcommand("doctor", "Say whether this machine has what Hearth needs");
    struct Options
    {
        SettingOptions settings;
        std::string format = "text";
    };
    auto options = std::make_shared<Options>();
    addFormat(*verb, options->format);
    options->settings.addOfCommand(*verb, {"cache"});
    verb->footer("Example: hearth doctor\n"
                 "The exit code is 1 where something is wrong; each has its remedy.");
    verb->callback(
        [options, &run]
        {
            run = withConfiguration(options->settings,
                                    [options](const profiles::Configuration& configuration)
                                    {
                                        const std::vector<Check> checks = examine(levelsOf(configuration));
                                        const int printed =
                                            printResult(options->format == "json" ? checksJson(checks)
                                                                                  : checksText(checks));
                                        return isWell(checks) ? printed : 1;
                                    });
        });
}

} // namespace hearth::command

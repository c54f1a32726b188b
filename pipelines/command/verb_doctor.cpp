// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cook/common_options.h"
#include "pipelines/command/cook/setting_options.h"
#include "pipelines/command/doctor.h"
#include "pipelines/command/shell/verb_tools.h"
#include "pipelines/command/shell/verbs.h"

namespace hearth::command
{

void addDoctor(cli::CommandLine& app, VerbAction& run)
{
    cli::CommandLine& verb = app.addSubcommand("doctor", "Say whether this machine has what Hearth needs");
    struct Options
    {
        SettingOptions settings;
        std::string format = "text";
    };
    auto options = std::make_shared<Options>();
    addFormat(verb, options->format);
    options->settings.addCommandSettings(verb, {"cache"});
    verb.setFooter("Example: hearth doctor\n"
                   "The exit code is 1 where something is wrong; each has its remedy.");
    verb.setAction(
        [options, &run]
        {
            run = withConfiguration(
                options->settings,
                [options](const profiles::Configuration& configuration)
                {
                    const std::vector<DoctorCheck> checks = runDoctorChecks(readCacheSpecs(configuration));
                    const int printed =
                        printResult(options->format == "json" ? checksJson(checks) : checksText(checks));
                    return allPassed(checks) ? printed : 1;
                });
        });
}

} // namespace hearth::command

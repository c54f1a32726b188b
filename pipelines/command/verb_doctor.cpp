// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/common_options.h"
#include "pipelines/command/doctor.h"
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
        std::vector<std::string> caches;
        std::string format = "text";
    };
    auto options = std::make_shared<Options>();
    addFormat(*verb, options->format);
    addCaches(*verb, options->caches);
    verb->footer("Example: hearth doctor\n"
                 "The exit code is 1 where something is wrong; each has its remedy.");
    verb->callback(
        [options, &run]
        {
            run = [options]
            {
                const auto caches = configuredCaches(options->caches);
                if (!caches.ok())
                    return fail(caches.error());
                const std::vector<Check> checks = examine(*caches);
                const int printed =
                    printResult(options->format == "json" ? checksJson(checks) : checksText(checks));
                return isWell(checks) ? printed : 1;
            };
        });
}

} // namespace hearth::command

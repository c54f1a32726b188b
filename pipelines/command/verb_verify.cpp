// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/verb_tools.h"
#include "pipelines/command/verbs.h"
#include "pipelines/command/verify.h"

#include <CLI/CLI.hpp>

namespace hearth::command
{

void addVerify(CLI::App& app, Work& run)
{
    CLI::App* verb = app.add_subcommand("verify", "Check every byte of a pack, and what it means");
    struct Options
    {
        std::string file;
        std::string format = "text";
    };
    auto options = std::make_shared<Options>();
    verb->add_option("FILE", options->file, "pack or part")->required();
    addFormat(*verb, options->format);
    verb->footer("Example: hearth verify village.hearth");
    verb->callback(
        [options, &run]
        {
            run = [options]
            {
                const Result<std::string> result = verifyFile(options->file);
                if (options->format == "text")
                    return printResult(result);
                const int printed = printResult(verifyJson(options->file, result));
                return result.ok() ? printed : fail(result.error());
            };
        });
}

} // namespace hearth::command

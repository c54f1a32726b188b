// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/inspect/verify.h"
#include "pipelines/command/shell/verb_tools.h"
#include "pipelines/command/shell/verbs.h"

namespace hearth::command
{

void addVerify(cli::CommandLine& app, VerbAction& run)
{
    cli::CommandLine& verb = app.addSubcommand("verify", "Check every byte of a pack, and what it means");
    struct Options
    {
        std::string file;
        std::string format = "text";
    };
    auto options = std::make_shared<Options>();
    verb.addOption("FILE", options->file, "pack or part").required();
    addFormat(verb, options->format);
    verb.setFooter("Example: hearth verify village.hearth");
    verb.setAction(
        [options, &run]
        {
            run = [options]
            {
                const Result<std::string> result = verifyFile(options->file);
                if (options->format == "text")
                    return printResult(result);
                const int printed = printResult(verifyJson(options->file, result));
                return result.ok() ? printed : printError(result.error());
            };
        });
}

} // namespace hearth::command

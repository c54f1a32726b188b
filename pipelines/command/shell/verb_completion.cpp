// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/shell/completion.h"
#include "pipelines/command/shell/verb_tools.h"
#include "pipelines/command/shell/verbs.h"

namespace hearth::command
{

void addCompletion(cli::CommandLine& app, VerbAction& run)
{
    cli::CommandLine& verb =
        app.addSubcommand("completion", "Print a script that completes command lines in a shell");
    auto shell = std::make_shared<std::string>();
    verb.addOption("SHELL", *shell, "whose script").required().choices({"bash", "zsh", "fish"});
    verb.setFooter("Example: hearth completion bash > ~/.local/share/bash-completion/completions/hearth");
    verb.setAction(
        [shell, &app, &run]
        {
            run = [shell, &app]
            {
                const cli::CommandInfo hearth = app.info();
                return printResult(*shell == "bash"  ? bashCompletion(hearth)
                                   : *shell == "zsh" ? zshCompletion(hearth)
                                                     : fishCompletion(hearth));
            };
        });
}

} // namespace hearth::command

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/completion.h"
#include "pipelines/command/verb_tools.h"
#include "pipelines/command/verbs.h"

#include <CLI/CLI.hpp>

namespace hearth::command
{

void addCompletion(CLI::App& app, Work& run)
{
    CLI::App* verb =
        app.add_subcommand("completion", "Print a script that completes command lines in a shell");
    auto shell = std::make_shared<std::string>();
    verb->add_option("SHELL", *shell, "whose script")
        ->required()
        ->check(CLI::IsMember({"bash", "zsh", "fish"}));
    verb->footer("Example: hearth completion bash > ~/.local/share/bash-completion/completions/hearth");
    verb->callback(
        [shell, &app, &run]
        {
            run = [shell, &app]
            {
                const CommandTable table = tableOf(app);
                return printResult(*shell == "bash"  ? bashCompletion(table)
                                   : *shell == "zsh" ? zshCompletion(table)
                                                     : fishCompletion(table));
            };
        });
}

} // namespace hearth::command

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/verb_tools.h"
#include "pipelines/command/verbs.h"

#include <CLI/CLI.hpp>

namespace hearth::command
{

void addVersion(CLI::App& app, Work& run)
{
    CLI::App* verb = app.add_subcommand("version", "Print the version");
    verb->callback([&run] { run = [] { return printResult(std::string("hearth " HEARTH_VERSION "\n")); }; });
}

} // namespace hearth::command

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/shell/verb_tools.h"
#include "pipelines/command/shell/verbs.h"

namespace hearth::command
{

void addVersion(cli::CommandLine& app, VerbAction& run)
{
    cli::CommandLine& verb = app.addSubcommand("version", "Print the version");
    verb.setAction([&run] { run = [] { return printResult(std::string("hearth " HEARTH_VERSION "\n")); }; });
}

} // namespace hearth::command

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/shell/explain.h"
#include "pipelines/command/shell/verb_tools.h"
#include "pipelines/command/shell/verbs.h"

namespace hearth::command
{

void addExplain(cli::CommandLine& app, VerbAction& run)
{
    cli::CommandLine& verb = app.addSubcommand("explain", "Say what the number of a message means");
    auto code = std::make_shared<std::string>();
    verb.addOption("CODE", *code, "as messages show it: E1203; none: list all");
    verb.setFooter("Example: hearth explain E1203");
    verb.setAction([code, &run] { run = [code] { return printResult(explain(*code)); }; });
}

} // namespace hearth::command

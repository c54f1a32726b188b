// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/explain.h"
#include "pipelines/command/verb_tools.h"
#include "pipelines/command/verbs.h"

#include <CLI/CLI.hpp>

namespace hearth::command
{

void addExplain(CLI::App& app, Work& run)
{
    CLI::App* verb = app.add_subcommand("explain", "Say what the number of a message means");
    auto code = std::make_shared<std::string>();
    verb->add_option("CODE", *code, "as messages show it: E1203; none: list all");
    verb->footer("Example: hearth explain E1203");
    verb->callback([code, &run] { run = [code] { return printResult(explain(*code)); }; });
}

} // namespace hearth::command

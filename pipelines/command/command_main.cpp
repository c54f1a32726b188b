// hearth: the command that users type. Reads the command line; each verb is a file of its own.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/program.h"
#include "pipelines/command/explain.h"
#include "pipelines/command/typing_errors.h"
#include "pipelines/command/verb_tools.h"
#include "pipelines/command/verbs.h"

#include <CLI/CLI.hpp>

namespace
{

using namespace hearth;
using namespace hearth::command;

std::string helpOf(const CLI::App& app)
{
    const auto chosen = app.get_subcommands();
    return chosen.empty() ? app.help() : chosen.front()->help("hearth") + "\n" + exitCodeTable();
}

int program(int argc, char** argv)
{
    CLI::App app("Cook assets into packs that a phone can stream and draw.", "hearth");
    Work run;
    app.require_subcommand(1);
    app.footer("Examples:\n"
               "  hearth cook house.glb -o house.hearth\n"
               "  hearth inspect house.hearth\n"
               "  hearth cook --help\n\n" +
               exitCodeTable());
    addCook(app, run);
    addInspect(app, run);
    addVerify(app, run);
    addExtract(app, run);
    addWhy(app, run);
    addCache(app, run);
    addReport(app, run);
    addExplain(app, run);
    addVersion(app, run);

    const std::string unknown = unknownWord(app, std::vector<std::string>(argv + 1, argv + argc));
    if (!unknown.empty())
        return usageError(unknown);
    try
    {
        app.parse(argc, argv);
    }
    catch (const CLI::CallForHelp&)
    {
        return printResult(helpOf(app));
    }
    catch (const CLI::ParseError& error)
    {
        return usageError(error.what());
    }
    return run();
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::runProgram("hearth", [&] { return program(argc, argv); });
}

// hearth: the command that users type. Reads the command line; each verb is a file of its own.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/program.h"
#include "pipelines/command/common_options.h"
#include "pipelines/command/explain.h"
#include "pipelines/command/typing_errors.h"
#include "pipelines/command/verb_tools.h"
#include "pipelines/command/verbs.h"

#include <CLI/CLI.hpp>
#include <algorithm>

namespace
{

using namespace hearth;
using namespace hearth::command;

std::string helpOf(const CLI::App& app)
{
    const CLI::App* chosen = &app;
    std::string before;
    while (!chosen->get_subcommands().empty())
    {
        before += (before.empty() ? "" : " ") + chosen->get_name();
        chosen = chosen->get_subcommands().front();
    }
    return chosen == &app ? app.help() : chosen->help(before) + "\n" + exitCodeTable();
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
    addDiff(app, run);
    addVerify(app, run);
    addExtract(app, run);
    addWhy(app, run);
    addCache(app, run);
    addPlan(app, run);
    addRun(app, run);
    addMerge(app, run);
    addFarm(app, run);
    addConfig(app, run);
    addDoctor(app, run);
    addSchema(app, run);
    addReport(app, run);
    addExplain(app, run);
    addMan(app, run);
    addCompletion(app, run);
    addVersion(app, run);
    addCommonOptions(app);
    for (CLI::App* verb : app.get_subcommands(nullptr))
        verb->fallthrough();

    Result<std::vector<std::string>> words =
        withArgumentFiles(std::vector<std::string>(argv + 1, argv + argc));
    if (!words.ok())
        return fail(words.error());
    const std::string unknown = unknownWord(app, *words);
    if (!unknown.empty())
        return usageError(unknown);
    try
    {
        // the last word is taken first
        std::reverse(words->begin(), words->end());
        app.parse(std::move(words).value());
    }
    catch (const CLI::CallForHelp&)
    {
        return printResult(helpOf(app));
    }
    catch (const CLI::ParseError& error)
    {
        return usageError(error.what());
    }
    const Status applied = applyCommonOptions();
    return applied.ok() ? run() : fail(applied.error());
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::runProgram("hearth", [&] { return program(argc, argv); });
}

// hearth, the command-line tool: parses the command line and runs the chosen verb. Each verb has a file of
// its own.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/program.h"
#include "pipelines/command/cook/common_options.h"
#include "pipelines/command/shell/explain.h"
#include "pipelines/command/shell/typing_errors.h"
#include "pipelines/command/shell/verb_tools.h"
#include "pipelines/command/shell/verbs.h"

namespace
{

using namespace hearth;
using namespace hearth::command;

/// Return the help of the command, followed by the exit codes if a verb was named (else its footer has them).
std::string helpText(const cli::CommandLine& app)
{
    return app.hasSubcommand() ? app.help() + "\n" + exitCodeTable() : app.help();
}

int program(int argc, char** argv)
{
    cli::CommandLine app("Cook assets into packs that a phone can stream and draw.", "hearth");
    VerbAction run;
    app.requireSubcommand();
    app.setFooter("Examples:\n"
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
    app.shareOptions();

    Result<std::vector<std::string>> words =
        expandArgumentFiles(std::vector<std::string>(argv + 1, argv + argc));
    if (!words.ok())
        return printError(words.error());
    const std::string unknown = findUnknownWord(app.info(), *words);
    if (!unknown.empty())
        return printUsageError(unknown);
    const cli::ParseResult parsed = app.parseWords(std::move(words).value());
    if (parsed.wants_help)
        return printResult(helpText(app));
    if (!parsed.fault.empty())
        return printUsageError(parsed.fault);
    const Status applied = applyCommonOptions();
    return applied.ok() ? run() : printError(applied.error());
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::runProgram("hearth", [&] { return program(argc, argv); });
}

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/regular_file.h"
#include "pipelines/command/cook/cook_tools.h"
#include "pipelines/command/cook/render_progress.h"
#include "pipelines/command/shell/verb_tools.h"
#include "pipelines/command/shell/verbs.h"
#include "pipelines/report/write_report.h"

namespace hearth::command
{

namespace
{

struct Options
{
    std::string file;
    std::string pack;
    std::string page;
    std::string junit;
    std::string table;
};

/// Return a message if the file lacks the extension that its option needs; else empty.
std::string extensionFault(const std::string& path, const std::string& ending)
{
    return path.empty() || path.ends_with(ending) ? "" : path + " does not end in " + ending;
}

int report(const Options& options)
{
    for (const std::string& fault :
         {extensionFault(options.page, ".html"), extensionFault(options.junit, ".xml"),
          extensionFault(options.table, ".csv")})
        if (!fault.empty())
            return printUsageError(fault);
    if (options.page.empty() && options.junit.empty() && options.table.empty())
        return printUsageError("report: nothing is asked for: name --html, --junit or --csv");
    const Result<std::string> json = readFile(options.file);
    if (!json)
        return printError(json.error());
    for (const std::string& path : {options.page, options.junit, options.table})
    {
        if (path.empty())
            continue;
        RenderProgress progress(progressStyle("auto"), printFaint);
        const Status status =
            report::writeReport(*json, path, options.pack, options.file,
                                [&](size_t drawn, size_t count) { progress.show(drawn, count); });
        progress.end();
        if (!status.ok())
            return printError(status.error());
    }
    return 0;
}

} // namespace

void addReport(cli::CommandLine& app, VerbAction& run)
{
    cli::CommandLine& verb =
        app.addSubcommand("report", "Turn the report of a cook into a page, or what machines read");
    auto options = std::make_shared<Options>();
    verb.addOption("FILE", options->file, "what hearth cook --report wrote as JSON").required();
    verb.addOption("--html", options->page, "write a page that needs nothing else: FILE.html");
    verb.addOption("--pack", options->pack, "what was cooked: the page has images of it");
    verb.addOption("--junit", options->junit, "write a test case for each asset: FILE.xml");
    verb.addOption("--csv", options->table, "write a row for each asset: FILE.csv");
    verb.setFooter("Example: hearth report cook.json --html cook.html --pack house.hearth");
    verb.setAction([options, &run] { run = [options] { return report(*options); }; });
}

} // namespace hearth::command

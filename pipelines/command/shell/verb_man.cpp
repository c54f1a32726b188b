// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/atomic_file.h"
#include "pipelines/command/shell/manual.h"
#include "pipelines/command/shell/verb_tools.h"
#include "pipelines/command/shell/verbs.h"

namespace hearth::command
{

namespace
{

int writePages(const std::vector<ManualPage>& pages, const std::string& folder)
{
    for (const ManualPage& page : pages)
        if (const Status written = writeText(folder + "/" + page.name, page.text); !written.ok())
            return printError(written.error());
    return 0;
}

int printPage(const std::vector<ManualPage>& pages, const std::string& name)
{
    for (const ManualPage& page : pages)
        if (page.name.substr(0, page.name.rfind('.')) == name ||
            page.name.starts_with("hearth-" + name + "."))
            return printResult(page.text);
    return printUsageError("there is no manual page of '" + name + "'");
}

} // namespace

void addMan(cli::CommandLine& app, VerbAction& run)
{
    cli::CommandLine& verb = app.addSubcommand("man", "Print a manual page, for man to show");
    struct Options
    {
        std::string page = "hearth";
        std::string folder;
    };
    auto options = std::make_shared<Options>();
    const cli::Option page =
        verb.addOption("PAGE", options->page, "a verb, hearth, or hearth.toml; by default hearth");
    verb.addOption("--all", options->folder, "write all pages into this folder")
        .typeName("DIR")
        .excludes(page);
    verb.setFooter("Examples:\n"
                   "  hearth man cook | man -l -\n"
                   "  hearth man --all ~/.local/share/man/man1");
    verb.setAction(
        [options, &app, &run]
        {
            run = [options, &app]
            {
                const std::vector<ManualPage> pages = manualPages(app.info());
                return options->folder.empty() ? printPage(pages, options->page)
                                               : writePages(pages, options->folder);
            };
        });
}

} // namespace hearth::command

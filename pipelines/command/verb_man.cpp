// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/tools/whole_file.h"
#include "pipelines/command/manual.h"
#include "pipelines/command/verb_tools.h"
#include "pipelines/command/verbs.h"

#include <CLI/CLI.hpp>

namespace hearth::command
{

namespace
{

int writePages(const std::vector<ManualPage>& pages, const std::string& folder)
{
    for (const ManualPage& page : pages)
        if (const Status written = tools::writeText(folder + "/" + page.name, page.text); !written.ok())
            return fail(written.error());
    return 0;
}

int printPage(const std::vector<ManualPage>& pages, const std::string& name)
{
    for (const ManualPage& page : pages)
        if (page.name.substr(0, page.name.rfind('.')) == name ||
            page.name.starts_with("hearth-" + name + "."))
            return printResult(page.text);
    return usageError("there is no manual page of '" + name + "'");
}

} // namespace

void addMan(CLI::App& app, Work& run)
{
    CLI::App* verb = app.add_subcommand("man", "Print a manual page, for man to show");
    struct Options
    {
        std::string page = "hearth";
        std::string folder;
    };
    auto options = std::make_shared<Options>();
    CLI::Option* page =
        verb->add_option("PAGE", options->page, "a verb, hearth, or hearth.toml; by default hearth");
    verb->add_option("--all", options->folder, "write all pages into this folder")
        ->type_name("DIR")
        ->excludes(page);
    verb->footer("Examples:\n"
                 "  hearth man cook | man -l -\n"
                 "  hearth man --all ~/.local/share/man/man1");
    verb->callback(
        [options, &app, &run]
        {
            run = [options, &app]
            {
                const std::vector<ManualPage> pages = manualPages(tableOf(app));
                return options->folder.empty() ? printPage(pages, options->page)
                                               : writePages(pages, options->folder);
            };
        });
}

} // namespace hearth::command

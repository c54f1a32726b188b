// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/open_pack.h"
#include "pipelines/command/pack_diff.h"
#include "pipelines/command/verb_tools.h"
#include "pipelines/command/verbs.h"

#include <CLI/CLI.hpp>

namespace hearth::command
{

namespace
{

constexpr int kDifferent = 1;

int diff(const std::string& file_a, const std::string& file_b, const std::string& format)
{
    const auto a = openPack(file_a);
    if (!a.ok())
        return fail(a.error());
    const auto b = openPack(file_b);
    if (!b.ok())
        return fail(b.error());
    const Result<PackDiff> difference = diffPacks(*a, *b);
    if (!difference.ok())
        return fail(difference.error());
    const int printed =
        printResult(format == "json" ? diffJson(*difference, file_a, file_b) : diffText(*difference));
    return printed == 0 && !difference->isSame() ? kDifferent : printed;
}

} // namespace

void addDiff(CLI::App& app, Work& run)
{
    CLI::App* verb = app.add_subcommand("diff", "Say what differs between two packs, by what it means");
    struct Options
    {
        std::string a;
        std::string b;
        std::string format = "text";
    };
    auto options = std::make_shared<Options>();
    verb->add_option("A", options->a, "pack")->required();
    verb->add_option("B", options->b, "pack")->required();
    addFormat(*verb, options->format);
    verb->footer("Example: hearth diff before.hearth after.hearth\n"
                 "Exit code 0: they are the same; 1: they differ.");
    verb->callback([options, &run]
                   { run = [options] { return diff(options->a, options->b, options->format); }; });
}

} // namespace hearth::command

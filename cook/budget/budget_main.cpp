// hearth-budget: lists the formats of all textures of a pack whose bytes a budget limits.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/budget/texture_budget.h"
#include "cook/command_line/command_line.h"
#include "cook/tools/batch.h"
#include "formats/base/atomic_file.h"
#include "formats/base/program.h"
#include "formats/base/regular_file.h"

#include <cstdio>

namespace
{

using namespace hearth;

struct Arguments
{
    std::vector<std::string> inputs;
    uint64_t bytes = 0;
    std::string output;
    std::string statistics;
};

void warnOfMiss(const Arguments& arguments, const budget::TextureShare& share)
{
    const Error warning{Issue::texture_budget, arguments.output, "",
                        std::to_string(share.texture_count) + " textures take " +
                            std::to_string(share.bytes) + " bytes in their smallest formats, the budget is " +
                            std::to_string(share.budget)};
    std::fprintf(stderr, "%s\n", formatMessage(warning).c_str());
}

Status cook(const Arguments& arguments)
{
    std::vector<budget::SourceTextures> sources;
    for (const std::string& input : arguments.inputs)
    {
        HEARTH_ASSIGN_OR_RETURN(const std::string text, readFile(input));
        HEARTH_ASSIGN_OR_RETURN(sources.emplace_back(), budget::parseEstimates(text, input));
    }
    const budget::TextureShare share = budget::shareTextures(sources, arguments.bytes);
    if (!share.is_held)
        warnOfMiss(arguments, share);
    HEARTH_TRY(writeText(arguments.output, budget::listText(share)));
    return arguments.statistics.empty() ? success()
                                        : writeText(arguments.statistics, budget::shareJson(share));
}

int program(int argc, char** argv)
{
    cli::CommandLine app("Lists the formats of all textures of a pack whose bytes a budget limits.");
    Arguments arguments;
    app.addOption("ESTIMATES", arguments.inputs, "what hearth-estimates has written, of each source")
        .required();
    app.addOption("--bytes", arguments.bytes, "bytes that all textures may take on the GPU")
        .required()
        .range(uint64_t{1}, uint64_t{1} << 60, "BYTES");
    app.addOption("-o,--output", arguments.output,
                  "text file to write: a line for each source, IMAGE=FORMAT for each of its images; - is "
                  "standard output")
        .required();
    app.addOption("--stats", arguments.statistics, "write what the budget did as JSON; - is standard output");
    app.setFooter(
        "Example: hearth-budget house.estimates.json tree.estimates.json --bytes 50331648 -o "
        "village.budget.txt\n"
        "Exit codes: 0 done, 2 usage, 65 malformed input, 66 input missing, 70 internal, 73 cannot write, "
        "74 I/O");
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    const Status done = cook(arguments);
    return done.ok() ? 0 : reportFailure(done.error());
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::tools::runCooker("hearth-budget", argc, argv, program);
}

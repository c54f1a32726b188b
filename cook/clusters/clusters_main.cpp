// hearth-clusters: reads an import part and writes the clusters part.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/cluster_part.h"
#include "formats/program.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>
#include <string>

#include <tbb/global_control.h>

namespace
{

using namespace hearth;

struct Arguments
{
    std::string input;
    std::string output;
    size_t jobs = 0;
};

void printWarnings(const Arguments& arguments, const clusters::BuildCounts& counts)
{
    if (counts.stuck_groups == 0)
        return;
    const Error warning{Issue::degraded, arguments.input, "",
                        std::to_string(counts.stuck_groups) +
                            " groups of clusters cannot be simplified further and are drawn at any distance"};
    std::fprintf(stderr, "%s\n", formatMessage(warning).c_str());
}

int run(const Arguments& arguments)
{
    std::unique_ptr<tbb::global_control> limit;
    if (arguments.jobs > 0)
        limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                      arguments.jobs);
    clusters::BuildCounts counts;
    const Status written = clusters::writeClustersPart(arguments.input, arguments.output, {}, counts);
    if (!written)
    {
        std::fprintf(stderr, "%s\n", formatMessage(written.error()).c_str());
        return exitCode(written.error());
    }
    printWarnings(arguments, counts);
    return 0;
}

int program(int argc, char** argv)
{
    CLI::App app(
        "Builds the cluster hierarchy of every mesh of an import part and writes the clusters part.");
    Arguments arguments;
    app.add_option("part", arguments.input, "import part")->required();
    app.add_option("-o,--output", arguments.output, "clusters part to write")->required();
    app.add_option("-j,--jobs", arguments.jobs, "threads to use; the result does not depend on it");
    app.footer(
        "Example: hearth-clusters scene.import.part -o scene.clusters.part\n"
        "Exit codes: 0 done, 2 usage, 65 malformed input, 66 input missing, 70 internal, 73 cannot write, "
        "74 I/O");
    try
    {
        app.parse(argc, argv);
    }
    catch (const CLI::ParseError& error)
    {
        return app.exit(error) == 0 ? 0 : 2;
    }
    return run(arguments);
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::runProgram("hearth-clusters", [&] { return program(argc, argv); });
}

// hearth-skinning: reads an import part and its clusters part, and writes the skinning part.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "cook/command_line/thread_limit.h"
#include "cook/skinning/skinning_part.h"
#include "cook/tools/batch.h"
#include "cook/tools/open_part.h"
#include "formats/base/atomic_file.h"
#include "formats/base/program.h"

#include <cstdio>

namespace
{

using namespace hearth;

struct Arguments
{
    std::string import_part;
    std::string clusters_part;
    std::string output;
    std::string statistics;
    size_t jobs = 0;
};

Status writeStatistics(const Arguments& arguments, const std::vector<skinning::MeshStatistics>& meshes)
{
    const std::string source =
        arguments.import_part.substr(arguments.import_part.rfind('/') + 1); // npos + 1 is 0
    return writeText(arguments.statistics, skinning::statisticsJson(source, meshes));
}

Status cook(const Arguments& arguments)
{
    HEARTH_ASSIGN_OR_RETURN(const formats::PackView import_part, tools::openPart(arguments.import_part));
    HEARTH_ASSIGN_OR_RETURN(const formats::PackView clusters_part, tools::openPart(arguments.clusters_part));
    HEARTH_ASSIGN_OR_RETURN(const std::vector<skinning::MeshStatistics> meshes,
                            skinning::writeSkinningPart(import_part, clusters_part, arguments.output));
    return arguments.statistics.empty() ? success() : writeStatistics(arguments, meshes);
}

int run(const Arguments& arguments)
{
    const cli::ThreadLimit limit(arguments.jobs);
    const Status cooked = cook(arguments);
    return cooked.ok() ? 0 : reportFailure(cooked.error());
}

int program(int argc, char** argv)
{
    cli::CommandLine app(
        "Bounds meshes with skins and morph targets over all animations and writes the skinning part.");
    Arguments arguments;
    app.addOption("import", arguments.import_part, "import part").required();
    app.addOption("clusters", arguments.clusters_part, "clusters part of the same source").required();
    app.addOption("-o,--output", arguments.output, "skinning part to write").required();
    app.addOption("-j,--jobs", arguments.jobs, "threads to use; the result does not depend on it");
    app.addOption("--stats", arguments.statistics,
                  "write statistics of each mesh as JSON; - is standard output");
    app.setFooter(
        "Example: hearth-skinning fox.import.part fox.clusters.part -o fox.skinning.part --stats -\n"
        "Exit codes: 0 done, 2 usage, 65 malformed input, 66 input missing, 70 internal, 73 cannot write, "
        "74 I/O");
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    return run(arguments);
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::tools::runCooker("hearth-skinning", argc, argv, program);
}

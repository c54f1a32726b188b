// hearth-neighbours: lists for each source of a pack the sources that can occlude it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "cook/neighbours/neighbours.h"
#include "cook/tools/batch.h"
#include "formats/base/atomic_file.h"
#include "formats/base/program.h"
#include "formats/base/regular_file.h"

namespace
{

using namespace hearth;

Status cook(const std::vector<std::string>& inputs, const std::string& output)
{
    std::vector<Box3> boxes;
    for (const std::string& input : inputs)
    {
        HEARTH_ASSIGN_OR_RETURN(const std::string statistics, readFile(input));
        HEARTH_ASSIGN_OR_RETURN(const Box3 box, neighbours::parseBox(statistics, input));
        boxes.push_back(box);
    }
    return writeText(output, neighbours::neighboursText(neighbours::findNeighbours(boxes)));
}

int program(int argc, char** argv)
{
    cli::CommandLine app("Lists for each source of a pack the sources that can occlude it.");
    std::vector<std::string> inputs;
    std::string output;
    app.addOption("STATISTICS", inputs, "what hearth-import --stats has written, of each source").required();
    app.addOption("-o,--output", output,
                  "text file to write: a line for each source, the numbers of its neighbours, from 0; - is "
                  "standard output")
        .required();
    app.setFooter(
        "Example: hearth-neighbours house.import.json tree.import.json -o village.neighbours.txt\n"
        "Exit codes: 0 done, 2 usage, 65 malformed input, 66 input missing, 70 internal, 73 cannot write, "
        "74 I/O");
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    const Status done = cook(inputs, output);
    return done.ok() ? 0 : reportFailure(done.error());
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::tools::runCooker("hearth-neighbours", argc, argv, program);
}

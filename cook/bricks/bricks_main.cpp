// hearth-bricks: marches rays through the bricks of a pack or part.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/march_rows.h"
#include "formats/program.h"

#include <CLI/CLI.hpp>

#include <cstdio>

namespace
{

using namespace hearth;
using namespace hearth::bricks;

struct Arguments
{
    std::string input;
    std::string output;
    std::string rays;
};

int run(const Arguments& arguments)
{
    const Status done = marchFile(arguments.input, arguments.rays, arguments.output);
    if (done.ok())
        return 0;
    std::fprintf(stderr, "%s\n", formatMessage(done.error()).c_str());
    return exitCode(done.error());
}

void addOptions(CLI::App& app, Arguments& arguments)
{
    app.add_option("FILE", arguments.input, "pack or bricks part")->required();
    app.add_option(
           "--march", arguments.rays,
           "CSV file of origin_x,origin_y,origin_z,direction_x,direction_y,direction_z in metres: write "
           "hit,x,y,z,face,t for each ray: 1, the first solid voxel, the face by which it is entered (none "
           "where "
           "the ray starts inside) and the distance in metres; 0,,,,, where it meets none")
        ->required();
    app.add_option("-o,--output", arguments.output, "CSV file to write; - is standard output")->required();
    app.footer(
        "Example: hearth-bricks village.hearth --march rays.csv -o hits.csv\n"
        "Exit codes: 0 done, 2 usage, 65 malformed input, 66 input missing, 70 internal, 73 cannot write, "
        "74 I/O");
}

int program(int argc, char** argv)
{
    CLI::App app("Marches rays through bricks.");
    Arguments arguments;
    addOptions(app, arguments);
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
    return hearth::runProgram("hearth-bricks", [&] { return program(argc, argv); });
}

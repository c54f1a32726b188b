// hearth-estimates: estimates the error of each image of a source in every format that it may have.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/thread_limit.h"
#include "cook/estimates/estimate.h"
#include "cook/texels/texel_options.h"
#include "cook/tools/batch.h"
#include "formats/base/atomic_file.h"
#include "formats/base/program.h"

namespace
{

using namespace hearth;

Status cook(const texels::TexelArguments& arguments, const std::string& output)
{
    HEARTH_ASSIGN_OR_RETURN(const texels::TexelOptions options, texels::parseTexelOptions(arguments));
    HEARTH_ASSIGN_OR_RETURN(const auto images, estimates::estimateTexels(arguments.import_part,
                                                                         arguments.textures_part, options));
    return writeText(output, estimates::estimatesJson(texels::inputName(arguments), images));
}

int program(int argc, char** argv)
{
    cli::CommandLine app("Estimates the error of each image of a source in every format that it may have.");
    texels::TexelArguments arguments;
    std::string output;
    texels::addTexelOptions(app, arguments);
    app.addOption("-o,--output", output,
                  "JSON file to write: bytes and cost of all formats of each image; - is standard output")
        .required();
    app.setFooter(
        "Example: hearth-estimates scene.import.part scene.textures.part -o scene.estimates.json\n"
        "Exit codes: 0 done, 2 usage, 65 malformed input, 66 input missing, 70 internal, 73 cannot write, "
        "74 I/O, 78 wrong settings");
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    const cli::ThreadLimit limit(arguments.jobs);
    const Status done = cook(arguments, output);
    return done.ok() ? 0 : reportFailure(done.error());
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::tools::runCooker("hearth-estimates", argc, argv, program);
}

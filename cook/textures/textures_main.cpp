// hearth-textures: makes the mips of an import part's images.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "cook/command_line/thread_limit.h"
#include "cook/textures/texture_part.h"
#include "cook/tools/batch.h"
#include "formats/base/atomic_file.h"
#include "formats/base/program.h"

#include <cstdio>

namespace
{

using namespace hearth;

constexpr uint32_t kChannelBits[] = {8, 16};

struct Arguments
{
    std::string input;
    std::string output;
    size_t jobs = 0;
    textures::TextureOptions options;
    bool keeps_roughness = false;
    std::string statistics;
};

Status cook(const Arguments& arguments)
{
    if (arguments.statistics.empty())
        return textures::cookTextures(arguments.input, arguments.output, arguments.options);
    std::vector<textures::ImageStatistics> images;
    HEARTH_TRY(textures::cookTextures(arguments.input, arguments.output, arguments.options, &images));
    const std::string source = arguments.input.substr(arguments.input.rfind('/') + 1); // npos + 1 is 0
    return writeText(arguments.statistics, textures::statisticsJson(source, images));
}

int run(const Arguments& arguments)
{
    const cli::ThreadLimit limit(arguments.jobs);
    const Status written = cook(arguments);
    return written.ok() ? 0 : reportFailure(written.error());
}

int program(int argc, char** argv)
{
    cli::CommandLine app("Gives the images of an import part their mips and writes the textures part.");
    Arguments arguments;
    app.addOption("part", arguments.input, "import part").required();
    app.addOption("-o,--output", arguments.output, "textures part to write").required();
    app.addOption("-j,--jobs", arguments.jobs, "threads to use; the result does not depend on it");
    app.addOption("--max-size", arguments.options.max_size,
                  "texels: the longer side of what is kept; finer mips are left out")
        .range(1u, textures::kMaxTextureSize, "UINT");
    app.addOption("--max-bits", arguments.options.max_bits,
                  "bits of a channel of data and normals that have 16 in the source")
        .choices(kChannelBits, "N");
    app.addFlag("--no-specular-aa", arguments.keeps_roughness,
                "do not widen roughness in mips by the normals that the mips of a normal map lose");
    app.addOption("--stats", arguments.statistics,
                  "write statistics of each image as JSON, with its measured error; - is standard output");
    app.setFooter(
        "Example: hearth-textures scene.import.part -o scene.textures.part\n"
        "Exit codes: 0 done, 2 usage, 65 malformed input, 66 input missing, 70 internal, 73 cannot write, "
        "74 I/O");
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    arguments.options.specular_aa = !arguments.keeps_roughness;
    return run(arguments);
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::tools::runCooker("hearth-textures", argc, argv, program);
}

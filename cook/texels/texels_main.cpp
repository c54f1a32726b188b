// hearth-texels: compresses the mips of a textures part for a target.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "cook/command_line/thread_limit.h"
#include "cook/texels/texel_part.h"
#include "cook/tools/batch.h"
#include "cook/tools/png.h"
#include "formats/base/atomic_file.h"
#include "formats/base/program.h"
#include "formats/pack/image_error.h"

#include <cstdio>

namespace
{

using namespace hearth;

struct Arguments
{
    std::string import_part;
    std::string textures_part;
    std::string output;
    size_t jobs = 0;
    std::vector<std::string> families;
    std::string quality = "normal";
    bool strict = false;
    std::vector<std::string> rules; ///< lines of TOML
    std::string statistics;
    std::string image;
};

Result<texels::TexelOptions> parseOptions(const Arguments& arguments)
{
    texels::TexelOptions options{.strict = arguments.strict, .draws_pictures = !arguments.image.empty()};
    if (arguments.families.empty())
        options.families = {.astc = true, .etc2 = true};
    for (const std::string& name : arguments.families)
        if (!texels::addFamily(name, options.families))
            return Error{Issue::usage, arguments.import_part, "--family",
                         "\"" + name + "\" is none of astc, etc2, bc"};
    options.quality = *texels::parseEffort(arguments.quality);
    std::string rules;
    for (const std::string& rule : arguments.rules)
        rules += rule + "\n";
    HEARTH_ASSIGN_OR_RETURN(options.rules, texels::parseTextureRules(rules, "--set"));
    return options;
}

void warnOfMisses(const Arguments& arguments, std::span<const texels::ImageResult> results)
{
    for (size_t i = 0; i < results.size(); ++i)
    {
        const texels::ImageResult& image = results[i];
        const auto role = static_cast<formats::ImageRole>(image.record.role);
        if (image.holds_target || image.reason != texels::FormatReason::target)
            continue;
        const std::string detail = formats::imageErrorText(role, double{image.record.error}) + " as " +
                                   std::string(formats::texelFormatName(image.record.format)) +
                                   ", the target is " + formats::imageErrorText(role, image.target.error);
        const Error warning{Issue::texture_target, arguments.import_part,
                            "image " + std::to_string(i) + " \"" + image.name + "\"", detail};
        std::fprintf(stderr, "%s\n", formatMessage(warning).c_str());
    }
}

/// Write the pictures of the images into one PNG; a black pixel where there are none.
Status writeSheet(const std::string& path, const std::vector<texels::PicturePair>& pictures)
{
    const texels::Picture sheet =
        pictures.empty() ? texels::Picture{1, 1, {{0, 0, 0}}} : texels::drawSheet(pictures);
    HEARTH_ASSIGN_OR_RETURN(AtomicFile file, AtomicFile::create(path));
    file.write(tools::encodePng(sheet.width, sheet.height, 3,
                                {sheet.pixels.front().data(), sheet.pixels.size() * 3}));
    return file.finish();
}

Status cook(const Arguments& arguments)
{
    HEARTH_ASSIGN_OR_RETURN(const texels::TexelOptions options, parseOptions(arguments));
    texels::TexelResults results;
    HEARTH_TRY(texels::cookTexels(arguments.import_part, arguments.textures_part, arguments.output, options,
                                  results));
    warnOfMisses(arguments, results.images);
    if (!arguments.image.empty())
        HEARTH_TRY(writeSheet(arguments.image, results.pictures));
    if (arguments.statistics.empty())
        return success();
    const std::string source =
        arguments.import_part.substr(arguments.import_part.rfind('/') + 1); // npos + 1 is 0
    return writeText(arguments.statistics, texels::statisticsJson(source, results));
}

int run(const Arguments& arguments)
{
    const cli::ThreadLimit limit(arguments.jobs);
    const Status written = cook(arguments);
    return written.ok() ? 0 : reportFailure(written.error());
}

int program(int argc, char** argv)
{
    cli::CommandLine app("Compresses the mips of a textures part for a target and writes the texels part.");
    Arguments arguments;
    app.addOption("import", arguments.import_part, "import part: its materials tell what images are for")
        .required();
    app.addOption("textures", arguments.textures_part, "textures part").required();
    app.addOption("-o,--output", arguments.output, "texels part to write").required();
    app.addOption("-j,--jobs", arguments.jobs, "threads to use; the result does not depend on it");
    app.addOption(
        "--family", arguments.families,
        "formats that the target reads: astc, astc-hdr, etc2 or bc; may be repeated. Default: astc and "
        "etc2");
    app.addOption("--quality", arguments.quality,
                  "target of error, and effort: draft 34 dB, normal 36.5, high 42 for colours")
        .choices({texels::effortNames().begin(), texels::effortNames().end()}, "QUALITY");
    app.addFlag("--strict", arguments.strict, "do not compress an image that misses its target");
    app.addOption("--set", arguments.rules,
                  "KEY=VALUE: rules by role or name, as textures.role=[{role=\"normal\",target=2}] or "
                  "textures.image=[{name=\"ui_*\",format=\"plain\"}]")
        .oneValueEach();
    app.addOption("--stats", arguments.statistics,
                  "write statistics of each image as JSON, with its measured error; - is standard output");
    app.addOption("--image", arguments.image,
                  "write a PNG with thumbnails of the largest images, each beside its error");
    app.setFooter(
        "Example: hearth-texels scene.import.part scene.textures.part -o scene.texels.part --family astc\n"
        "Exit codes: 0 done, 2 usage, 65 malformed input, 66 input missing, 70 internal, 73 cannot write, "
        "74 I/O, 78 wrong settings");
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    return run(arguments);
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::tools::runCooker("hearth-texels", argc, argv, program);
}

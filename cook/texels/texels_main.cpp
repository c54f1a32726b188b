// hearth-texels: compresses the mips of a textures part for a target.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "cook/command_line/thread_limit.h"
#include "cook/texels/texel_options.h"
#include "cook/texels/texel_part.h"
#include "cook/tools/batch.h"
#include "cook/tools/png.h"
#include "formats/base/atomic_file.h"
#include "formats/base/program.h"
#include "formats/pack/image_error.h"

#include <charconv>
#include <cstdio>
#include <map>

namespace
{

using namespace hearth;

struct Arguments
{
    texels::TexelArguments texels;
    std::string output;
    std::string statistics;
    std::string image;
    std::vector<std::string> formats; ///< "INDEX=FORMAT"
};

/// Parse the words of --format. errors: usage
Result<std::map<uint32_t, std::string>> parseFormats(const Arguments& arguments)
{
    std::map<uint32_t, std::string> formats;
    for (const std::string& word : arguments.formats)
    {
        uint32_t index = 0;
        const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), index);
        if (fault != std::errc() || end == word.data() + word.size() || *end != '=')
            return Error{Issue::usage, arguments.texels.import_part, "--format",
                         "\"" + word + "\" is not INDEX=FORMAT"};
        formats[index] = end + 1;
    }
    return formats;
}

Result<texels::TexelOptions> parseOptions(const Arguments& arguments)
{
    HEARTH_ASSIGN_OR_RETURN(texels::TexelOptions options, texels::parseTexelOptions(arguments.texels));
    options.draws_pictures = !arguments.image.empty();
    HEARTH_ASSIGN_OR_RETURN(options.formats, parseFormats(arguments));
    return options;
}

/// Say by how much an image misses its target: of all texels, or else of the smooth ones.
std::string missText(const formats::ImageRecord& image)
{
    const auto role = static_cast<formats::ImageRole>(image.role);
    const bool is_smooth = image.error <= image.target;
    const double error = double{is_smooth ? image.error_smooth : image.error};
    const double target = double{is_smooth ? image.target_smooth : image.target};
    return formats::imageErrorText(role, error) + (is_smooth ? " in smooth areas as " : " as ") +
           std::string(formats::texelFormatName(image.format)) + ", the target is " +
           formats::imageErrorText(role, target);
}

void warnOfMisses(const Arguments& arguments, std::span<const texels::ImageResult> results)
{
    for (size_t i = 0; i < results.size(); ++i)
    {
        const texels::ImageResult& image = results[i];
        if (image.holds_target)
            continue;
        const Error warning{Issue::texture_target, arguments.texels.import_part,
                            "image " + std::to_string(i) + " \"" + image.name + "\"", missText(image.record)};
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
    HEARTH_TRY(texels::cookTexels(arguments.texels.import_part, arguments.texels.textures_part,
                                  arguments.output, options, results));
    warnOfMisses(arguments, results.images);
    if (!arguments.image.empty())
        HEARTH_TRY(writeSheet(arguments.image, results.pictures));
    if (arguments.statistics.empty())
        return success();
    return writeText(arguments.statistics,
                     texels::statisticsJson(texels::inputName(arguments.texels), results));
}

int run(const Arguments& arguments)
{
    const cli::ThreadLimit limit(arguments.texels.jobs);
    const Status written = cook(arguments);
    return written.ok() ? 0 : reportFailure(written.error());
}

int program(int argc, char** argv)
{
    cli::CommandLine app("Compresses the mips of a textures part for a target and writes the texels part.");
    Arguments arguments;
    texels::addTexelOptions(app, arguments.texels);
    app.addOption("-o,--output", arguments.output, "texels part to write").required();
    app.addOption("--format", arguments.formats,
                  "INDEX=FORMAT: format of an image that no rule names one for, whatever its error; may be "
                  "repeated")
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

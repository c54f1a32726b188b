// hearth-import: reads a source asset and writes the import part.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/animation_compression/clip_settings.h"
#include "cook/command_line/command_line.h"
#include "cook/probes/probe.h"
#include "cook/tools/batch.h"
#include "cook/tools/child_processes.h"
#include "cook/tools/dependency_list.h"
#include "cook/tools/lod_files.h"
#include "formats/base/atomic_file.h"
#include "formats/base/program.h"
#include "formats/base/temp_directory.h"
#include "formats/base/text.h"
#include "pipelines/import/authored_lods.h"
#include "pipelines/import/images/images_program.h"
#include "pipelines/import/part/compress_part_clips.h"
#include "pipelines/import/part/source_space.h"
#include "pipelines/import/proxy_files.h"
#include "pipelines/import/read_source.h"

#include <cstdio>
#include <filesystem>

namespace
{

using namespace hearth;

struct Arguments
{
    std::string source;
    std::string output;
    std::vector<std::string> lods;
    std::string profile;
    std::vector<std::string> settings;
    std::string depfile;
    std::string statistics;
    double crease_angle_deg = 60;
    double scale = 1;
    double receiver_density = 0;
    std::string up = "y";
    std::string layer;
    std::string icc = "ignore";
    std::string sky = "on";
    std::string proxies = "on";
    std::vector<std::string> proxy_files;
    uint32_t max_sky_size = probes::kMaxSkySide;
};

constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180;

void printWarnings(const import::PartBuilder& part)
{
    for (const Error& warning : part.warnings())
        std::fprintf(stderr, "%s\n", formatMessage(warning).c_str());
    if (part.omittedWarningCount() > 0)
        std::fprintf(stderr, "and %llu more warnings\n",
                     static_cast<unsigned long long>(part.omittedWarningCount()));
}

/// Create a folder for parts of further files.
Result<TempDirectory> createTemporaryFolder(const Arguments& arguments)
{
    return TempDirectory::create(temporaryFolderOr(parentFolder(arguments.output)), arguments.output);
}

Result<std::vector<import::FileProxies>>
readFileProxies(const Arguments& arguments, const import::ImportOptions& options, import::PartBuilder& part)
{
    HEARTH_ASSIGN_OR_RETURN(const TempDirectory folder, createTemporaryFolder(arguments));
    return import::readProxyFiles(arguments.proxy_files, arguments.source, folder.path(), options, part);
}

Status readAll(const Arguments& arguments, std::span<const tools::LodFile> lods, tools::DependencyList& reads,
               import::PartBuilder& part)
{
    import::ImportOptions options;
    options.crease_angle_rad = static_cast<float>(arguments.crease_angle_deg * kRadiansPerDegree);
    if (arguments.receiver_density > 0)
        options.receiver_texel_size = 1 / (arguments.receiver_density * arguments.scale);
    if (!arguments.depfile.empty())
        options.reads = &reads;
    import::ImagesProgram images(tools::programFolder() + "/hearth-images");
    options.takes_sky = arguments.sky == "on";
    if (arguments.proxies == "off")
        options.proxies = import::AuthoredProxies::left_out;
    options.artist = {&images, arguments.layer, arguments.icc == "convert"};
    std::vector<import::FileProxies> file_proxies;
    // a source that is missing is an error of its reader
    if (!arguments.proxy_files.empty() && std::filesystem::exists(arguments.source))
    {
        HEARTH_ASSIGN_OR_RETURN(file_proxies, readFileProxies(arguments, options, part));
        options.file_proxies = &file_proxies;
    }
    HEARTH_TRY(import::readSource(arguments.source, options, part));
    if (lods.empty())
        return success();
    options.file_proxies = nullptr;
    HEARTH_ASSIGN_OR_RETURN(const TempDirectory folder, createTemporaryFolder(arguments));
    return import::addAuthoredLods(lods, folder.path(), options, part);
}

Result<animation_compression::StatedError> statedError(const Arguments& arguments)
{
    if (!arguments.profile.empty())
        return animation_compression::readStatedError(arguments.profile);
    return animation_compression::parseStatedError(joinLines(arguments.settings), "--set");
}

Status finish(const Arguments& arguments, const animation_compression::StatedError& stated_error,
              import::PartBuilder& part)
{
    HEARTH_TRY(import::convertToMetres(
        {arguments.scale, arguments.up == "z" ? import::UpAxis::z : import::UpAxis::y}, part));
    import::compressClips(part, stated_error);
    HEARTH_TRY(import::writeSky(part, arguments.max_sky_size));
    HEARTH_TRY(part.finish());
    return arguments.statistics.empty() ? success()
                                        : writeText(arguments.statistics, part.statistics() + "\n");
}

Status run(const Arguments& arguments)
{
    tools::DependencyList reads;
    if (!arguments.profile.empty() && !arguments.depfile.empty())
        reads.addFile(arguments.profile);
    HEARTH_ASSIGN_OR_RETURN(const animation_compression::StatedError stated_error, statedError(arguments));
    HEARTH_ASSIGN_OR_RETURN(const std::vector<tools::LodFile> lods, tools::parseLodFiles(arguments.lods));
    HEARTH_ASSIGN_OR_RETURN(import::PartBuilder part,
                            import::PartBuilder::create(arguments.output, arguments.source));
    const Status read = readAll(arguments, lods, reads, part);
    printWarnings(part);
    const Status finished = read.ok() ? finish(arguments, stated_error, part) : read;
    // written after a failure too: a repair changes one of these files
    const Status listed = arguments.depfile.empty() ? success() : writeText(arguments.depfile, reads.text());
    return finished.ok() ? listed : finished;
}

int program(int argc, char** argv)
{
    cli::CommandLine app(
        "Reads a glTF scene, a scan or an image and writes the import part that the cookers read.");
    Arguments arguments;
    app.addOption("source", arguments.source, "glTF, GLB, OBJ, PLY, STL, OFF, Draco or image file")
        .required();
    app.addOption("-o,--output", arguments.output, "import part to write").required();
    app.addOption("--lod", arguments.lods,
                  "N=FILE: level of detail N of the source's only mesh, made by hand")
        .oneValueEach();
    app.addOption("--crease-angle", arguments.crease_angle_deg,
                  "degrees: sharper edges of a mesh without normals stay hard; 180: none does")
        .showDefault()
        .range(0.0, 180.0);
    app.addOption("--scale", arguments.scale, "metres of a unit of the source, as 0.01 of centimetres")
        .showDefault()
        .range(import::kMinScale, import::kMaxScale);
    app.addOption("--up", arguments.up, "the axis of the source that points up")
        .choices({"y", "z"})
        .showDefault();
    app.addOption("--receivers", arguments.receiver_density,
                  "texels of baked light a metre, for which meshes get UVs that have none")
        .range(1.0 / 1024, 1024.0);
    app.addOption("--layer", arguments.layer,
                  "of EXR images: name of the part, or of the layer in a part, to read; else the first part "
                  "with colours");
    app.addOption(
           "--icc", arguments.icc,
           "colours of TIFF, PSD and JPEG 2000 with an ICC profile: convert them to sRGB, or take them "
           "for sRGB; glTF asks for the latter")
        .choices({"convert", "ignore"})
        .showDefault();
    app.addOption("--sky", arguments.sky, "take the image-based light of the scene for the sky of the pack")
        .choices({"on", "off"})
        .showDefault();
    app.addOption(
           "--proxy", arguments.proxy_files,
           "MESH=FILE: proxy of the mesh or node of that name, from the source's folder; FILE alone is "
           "of the only mesh")
        .oneValueEach();
    app.addOption(
           "--proxies", arguments.proxies,
           "keep the proxies of meshes that an artist made: nodes called X_PROXY or UCX_X, or with the "
           "extra hearth_proxy; off: they are not drawn either")
        .choices({"on", "off"})
        .showDefault();
    app.addOption("--sky-size", arguments.max_sky_size,
                  "largest edge of that sky as the camera sees it, which is no finer than its images")
        .range(1u, 4096u, "N")
        .showDefault();
    const cli::Option profile =
        app.addOption("--profile", arguments.profile, "TOML file: the error that clips may have");
    app.addOption("--set", arguments.settings, "KEY=VALUE: a line of a profile, as animation.error=0.001")
        .oneValueEach()
        .excludes(profile);
    app.addOption("--depfile", arguments.depfile,
                  "write which files were read, and which were not found, as sha256sum would");
    app.addOption(
        "--stats", arguments.statistics,
        "write what was read, what was left out and what was counted, as the part's META has it, and "
        "the box of what can occlude; - is standard output");
    app.setFooter("Examples:\n"
                  "  hearth-import scene.glb -o scene.import.part\n"
                  "  hearth-import rock.glb --lod 1=rock_mid.glb --lod 2=rock_low.glb -o rock.import.part\n"
                  "Exit codes: 0 done, 2 usage, 65 malformed input, 66 input missing, 70 internal, 73 cannot "
                  "write, 74 I/O, 78 wrong settings");
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    const Status status = run(arguments);
    return status.ok() ? 0 : reportFailure(import::truncateTexts(status.error()));
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::tools::runCooker("hearth-import", argc, argv, program);
}

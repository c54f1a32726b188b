// hearth-visibility: reads an import part and its clusters part, and writes the clusters part with visibility
// at its vertices.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "cook/command_line/thread_limit.h"
#include "cook/tools/batch.h"
#include "cook/tools/open_part.h"
#include "cook/tools/png.h"
#include "cook/visibility/program/visibility_part.h"
#include "cook/visibility/scene/occlusion_image.h"
#include "formats/base/atomic_file.h"
#include "formats/base/program.h"

#include <chrono>
#include <csignal>
#include <cstdio>
#include <map>

#include <unistd.h>

namespace
{

using namespace hearth;
using visibility::BakeProgress;
using visibility::BakeSettings;

constexpr int kInterrupted = 130;

// Size of the occlusion image in pixels: small enough to embed in a report.
constexpr uint32_t kWidth = 640, kHeight = 480;

volatile std::sig_atomic_t interrupted = 0;

const std::map<std::string, visibility::SamplingSettings> kQualities{
    {"draft", {1, 32, 0x1p22, 1}},
    {"default", {8, 64, 0x1.ep22, 2}},
    {"high", {16, 256}},
};

struct Arguments
{
    std::string import_part;
    std::string clusters_part;
    std::string output;
    std::string statistics;
    bool statistics_without_noise = false;
    std::string image;
    std::string quality = "default";
    std::vector<std::string> neighbours; ///< import and clusters part in turn
    std::string proxies;                 ///< part; empty: those of the import part
    visibility::ProxyUse proxy_use = visibility::ProxyUse::none;
    visibility::OccluderScope occluders = visibility::OccluderScope::pack;
    double copies = BakeSettings{}.copies;
    double samples_per_vertex = 0; ///< here and below, 0: value of the quality preset
    uint32_t rays_per_sample = 0;
    float distance = 0;
    float power = 0;
    std::vector<std::string> poses;
    bool refine_cones = false;
    size_t jobs = 0;

    BakeSettings settings() const
    {
        BakeSettings settings;
        const visibility::SamplingSettings& preset = kQualities.at(quality);
        settings.sampling = preset;
        if (samples_per_vertex > 0 || rays_per_sample > 0) // numbers that are asked for have no budget
            settings.sampling = {samples_per_vertex > 0 ? samples_per_vertex : preset.samples_per_vertex,
                                 rays_per_sample > 0 ? rays_per_sample : preset.rays_per_sample};
        if (distance > 0)
            settings.rays.distance = distance;
        settings.rays.power = power;
        settings.occluders = occluders;
        settings.copies = copies;
        for (const std::string& text : poses)
            settings.poses.push_back(visibility::parseClipTimes(text).value_or(visibility::ClipTimes{}));
        settings.proxies = proxy_use;
        settings.fit.refine_cones = refine_cones;
        settings.fit.estimate_error = !statistics.empty() && !statistics_without_noise;
        return settings;
    }
};

/// Progress on one line of a terminal, overwritten each time; nothing in a log.
class ProgressLine
{
public:
    ~ProgressLine()
    {
        if (shown_)
            std::fputs("\r\x1b[K", stderr);
    }

    void show(const BakeProgress& progress)
    {
        const auto now = std::chrono::steady_clock::now();
        if (!is_terminal_ || now - last_ < std::chrono::milliseconds(100))
            return;
        last_ = now;
        shown_ = true;
        const double seconds = std::chrono::duration<double>(now - start_).count();
        std::fprintf(stderr, "\rvisibility %3.0f %%, %.1f Mrays/s", 100 * progress.share,
                     static_cast<double>(progress.rays) / seconds * 1e-6);
        if (progress.share > 0.02)
            std::fprintf(stderr, ", %.0f s left", seconds * (1 - progress.share) / progress.share);
        std::fputs("\x1b[K", stderr);
    }

private:
    const bool is_terminal_ = ::isatty(STDERR_FILENO) == 1;
    const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    std::chrono::steady_clock::time_point last_;
    bool shown_ = false;
};

Status writeStatistics(const Arguments& arguments, const std::vector<visibility::MeshStatistics>& meshes)
{
    const std::string source =
        arguments.import_part.substr(arguments.import_part.rfind('/') + 1); // npos + 1 is 0
    return writeText(
        arguments.statistics,
        visibility::statisticsJson(source, arguments.settings(), arguments.neighbours.size() / 2, meshes));
}

/// Write the occlusion image of the written part.
Status writeOcclusionImage(const Arguments& arguments, const formats::PackView& import_part)
{
    HEARTH_ASSIGN_OR_RETURN(const formats::PackView baked, tools::openPart(arguments.output));
    HEARTH_ASSIGN_OR_RETURN(const visibility::GreyImage image,
                            visibility::renderOcclusion(import_part, baked, kWidth, kHeight));
    HEARTH_ASSIGN_OR_RETURN(AtomicFile file, AtomicFile::create(arguments.image));
    file.write(tools::encodePng(image.width, image.height, 1, image.texels));
    return file.finish();
}

/// Cook the part. Returns the exit code.
Result<int> cook(const Arguments& arguments)
{
    HEARTH_ASSIGN_OR_RETURN(const formats::PackView import_part, tools::openPart(arguments.import_part));
    HEARTH_ASSIGN_OR_RETURN(const formats::PackView clusters_part, tools::openPart(arguments.clusters_part));
    ProgressLine line;
    const auto observe = [&](const BakeProgress& progress)
    {
        line.show(progress);
        return interrupted == 0;
    };
    std::vector<visibility::PartPaths> neighbours;
    for (size_t i = 0; i + 1 < arguments.neighbours.size(); i += 2)
        neighbours.push_back({arguments.neighbours[i], arguments.neighbours[i + 1]});
    HEARTH_ASSIGN_OR_RETURN(
        const formats::PackView proxies,
        tools::openPart(arguments.proxies.empty() ? arguments.import_part : arguments.proxies));
    HEARTH_ASSIGN_OR_RETURN(const auto meshes,
                            visibility::writeVisibilityPart(import_part, clusters_part, proxies, neighbours,
                                                            arguments.output, arguments.settings(), observe));
    if (!meshes)
        return kInterrupted;
    if (!arguments.statistics.empty())
        HEARTH_TRY(writeStatistics(arguments, *meshes));
    if (!arguments.image.empty())
        HEARTH_TRY(writeOcclusionImage(arguments, import_part));
    return 0;
}

int run(const Arguments& arguments)
{
    const cli::ThreadLimit limit(arguments.jobs);
    std::signal(SIGINT, [](int) { interrupted = 1; });
    std::signal(SIGTERM, [](int) { interrupted = 1; });
    const Result<int> cooked = cook(arguments);
    if (cooked.ok())
        return *cooked;
    return reportFailure(cooked.error());
}

int program(int argc, char** argv)
{
    cli::CommandLine app(
        "Bakes what each vertex sees of its surroundings, for all levels of detail, into the vertices "
        "of a clusters part that has room for it (hearth-clusters --visibility).");
    Arguments arguments;
    app.addOption("import", arguments.import_part, "import part").required();
    app.addOption("clusters", arguments.clusters_part, "clusters part of the same source").required();
    app.addOption("-o,--output", arguments.output, "clusters part to write, with visibility").required();
    app.addOption("--quality", arguments.quality,
                  "samples a vertex x rays a sample: draft 1 x 32, default 8 x 64, high 16 x 256; for large "
                  "sources draft and default take fewer")
        .choices({"draft", "default", "high"}, "NAME");
    app.addOption("--samples-per-vertex", arguments.samples_per_vertex, "instead of the quality's")
        .range(0.01, 65536.0, "FLOAT");
    app.addOption("--rays-per-sample", arguments.rays_per_sample,
                  "instead of the quality's; a power of two is best")
        .range(1, 65536, "UINT");
    std::map<std::string, visibility::OccluderScope> scopes;
    for (const auto scope : {visibility::OccluderScope::pack, visibility::OccluderScope::source,
                             visibility::OccluderScope::mesh})
        scopes.emplace(visibility::occluderScopeName(scope), scope);
    app.addChoice("--occluders", arguments.occluders, scopes,
                  "what is in the way: pack (all instances and the neighbours, the default), source (all "
                  "instances) or mesh (each mesh alone)");
    app.addOption("--neighbours", arguments.neighbours,
                  "import and clusters part of each source that occludes this one")
        .typeName("PART");
    app.addOption("--copies", arguments.copies,
                  "bytes that copies of meshes may take, for instances that see too different a part of the "
                  "sky, over "
                  "those of the source's geometry; 0: no copies")
        .range(0.0, 64.0, "FLOAT")
        .showDefault();
    std::map<std::string, visibility::ProxyUse> uses;
    for (const auto use : {visibility::ProxyUse::none, visibility::ProxyUse::fit, visibility::ProxyUse::all})
        uses.emplace(visibility::proxyUseName(use), use);
    app.addChoice(
        "--use-proxies", arguments.proxy_use, uses,
        "use of proxies that are near their meshes: none (the default), fit (visibility is fitted on "
        "them, and the mesh takes it from there) or all (rays start on them and meet them, too)");
    app.addOption("--proxies", arguments.proxies,
                  "proxy part of the same source; without it the proxies that artists made, of the import "
                  "part")
        .typeName("PART");
    const cli::Option distance =
        app.addOption("--distance", arguments.distance,
                      "metres: what is farther away hides nothing; no limit by default")
            .positive("FLOAT");
    app.addOption("--power", arguments.power,
                  "visibility of what is t metres away is (t / distance)^power; 0, the default: nothing")
        .range(0.0, 16.0, "FLOAT")
        .needs(distance);
    app.addOption("--poses", arguments.poses,
                  "CLIP[@SECONDS,...]: deformed meshes are baked in these poses instead of the bind pose, "
                  "four evenly "
                  "over the clip where no times are given; several clips: once each")
        .oneValueEach()
        .check(
            [](const std::string& text)
            {
                return visibility::parseClipTimes(text)
                           ? ""
                           : "--poses: \"" + text + "\" has no list of seconds after its @";
            })
        .typeName("TEXT");
    app.addFlag("--refine-cones", arguments.refine_cones,
                "fit cones to nine harmonics instead of four moments; --stats says what that gained");
    app.addOption("-j,--jobs", arguments.jobs, "threads to use; the result does not depend on it");
    const cli::Option statistics = app.addOption(
        "--stats", arguments.statistics,
        "write statistics of each mesh as JSON, with its estimated noise; - is standard output");
    app.addFlag("--no-noise-estimate", arguments.statistics_without_noise,
                "leave the noise out of --stats, which takes two fits more")
        .needs(statistics);
    app.addOption("--image", arguments.image,
                  "draw the scene's ambient occlusion into a PNG file of 640 x 480");
    app.setFooter(
        "Example: hearth-visibility room.import.part room.clusters.part -o room.visibility.part --stats -\n"
        "Exit codes: 0 done, 2 usage, 65 malformed input, 66 input missing, 70 internal, 73 cannot write, "
        "74 I/O, 130 interrupted");
    app.setCheck(
        [&arguments] {
            return arguments.neighbours.size() % 2 == 0
                       ? ""
                       : "--neighbours: two parts are needed for each source";
        });
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    return run(arguments);
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::tools::runCooker("hearth-visibility", argc, argv, program);
}

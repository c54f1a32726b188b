// hearth_measure_picture: draws scenes with Hearth, by default and with everything off and on, beside
// Blender's Cycles and the project's own path tracer, and holds the differences against the aims of
// "picture".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "formats/base/atomic_file.h"
#include "formats/base/program.h"
#include "runtime/viewer/camera_fit.h"
#include "tests/bench/aims.h"
#include "tests/picture/hearth_pictures.h"
#include "tests/picture/market_night.h"
#include "tests/picture/page.h"
#include "tests/picture/programs.h"
#include "tests/picture/surface_figures.h"
#include "tests/reference/flip.h"
#include "tests/reference/tracer/path_tracer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>

namespace
{

using namespace hearth;
using namespace hearth::picture;
namespace fs = std::filesystem;

constexpr const char* kCycles = "cycles";
constexpr const char* kTracer = "tracer";
constexpr uint32_t kOcclusionRays = 64; ///< for each pixel
constexpr uint32_t kOpenSamples = 8;    ///< of the tracer where nothing occludes: against aliasing alone

// scenes of single figures
constexpr std::string_view kWallScene = "outdoor", kWallFigure = "error of light on sky-lit walls: outdoor";
constexpr std::string_view kOcclusionScene = "demo", kOcclusionFigure = "rms of ambient occlusion: demo";

struct Arguments
{
    std::string assets, work = "build/bench/picture";
    std::vector<std::string> scenes;
    std::vector<std::string> references{kTracer};
    uint32_t samples = 16;
    CyclesSettings cycles{.scripts = "tests/picture/cycles"};

    bool uses(const char* reference) const
    {
        return std::find(references.begin(), references.end(), reference) != references.end();
    }
    bool includes(std::string_view scene) const
    {
        return scenes.empty() || std::find(scenes.begin(), scenes.end(), scene) != scenes.end();
    }
    bool includes(const Scene& scene) const
    {
        return includes(scene.name) && (scene.source == Source::sample || !assets.empty());
    }
};

Result<formats::PackView> openPack(const std::string& path)
{
    HEARTH_ASSIGN_OR_RETURN(formats::ContainerReader reader, formats::ContainerReader::open(path));
    return formats::PackView::read(std::move(reader));
}

Result<ReferenceImages> trace(const reference::ShadedScene& scene, const SceneSetup& setup)
{
    reference::PathTracing tracing{.camera = setup.camera,
                                   .width = kWidth * kOversampling,
                                   .height = kHeight * kOversampling,
                                   .samples = setup.full_samples / 2};
    ReferenceImages images;
    for (uint64_t half = 0; half < 2; ++half)
    {
        tracing.seed = half + 1;
        images.full[half] = {tracing.width, tracing.height, reference::tracePaths(scene, tracing)};
    }
    tracing.occlusion = reference::Occlusion::none;
    tracing.samples = kOpenSamples;
    images.open = {tracing.width, tracing.height, reference::tracePaths(scene, tracing)};
    return images;
}

Status writeImages(const Comparison& c, const std::string& scene)
{
    const std::string prefix = scene + "-" + c.reference;
    HEARTH_TRY(reference::writePng(prefix + "-open.png", c.open));
    HEARTH_TRY(reference::writePng(prefix + "-full.png", c.full));
    HEARTH_TRY(reference::writePng(prefix + "-open-heat.png", c.open_open.heat));
    HEARTH_TRY(reference::writePng(prefix + "-default-heat.png", c.plain_full.heat));
    return reference::writePng(prefix + "-full-heat.png", c.full_full.heat);
}

Agreement agree(const Comparison& a, const Comparison& b)
{
    return {reference::flip(a.open, b.open).mean(), reference::flip(a.full, b.full).mean()};
}

Result<SceneResult> measureScene(const Scene& scene, const Arguments& arguments)
{
    SceneResult result{.name = std::string(scene.name)};
    const HearthPictures pictures(scene, arguments.assets, arguments.work);
    HEARTH_TRY(pictures.cook());
    HEARTH_ASSIGN_OR_RETURN(const formats::PackView pack, openPack(pictures.packPath(Setting::plain)));
    HEARTH_ASSIGN_OR_RETURN(const reference::PackGeometry geometry, reference::PackGeometry::decode(pack));
    HEARTH_ASSIGN_OR_RETURN(const reference::TextureSet textures, reference::TextureSet::load(pack));
    const reference::ShadedScene shaded(geometry, textures, nullptr);
    const float aspect = float{kWidth} / float{kHeight};
    const SceneSetup setup{pictures.source(),
                           scene.view == View::first ? viewer::sceneCamera(pack, 0)
                                                     : viewer::fitCamera(pack, aspect),
                           shaded.lighting(), !pack.lights().empty(), arguments.samples * scene.samples};
    for (const Setting setting : kSettings)
    {
        HEARTH_ASSIGN_OR_RETURN(result.drawn[static_cast<size_t>(setting)],
                                pictures.draw(setting, setup.camera));
    }
    const SeenSurfaces surfaces(shaded, pack, setup.camera, kWidth, kHeight);
    const std::string prefix = arguments.work + "/" + result.name;
    for (const std::string& name : arguments.references)
    {
        HEARTH_ASSIGN_OR_RETURN(const ReferenceImages images,
                                name == kCycles ? renderWithCycles(setup, arguments.cycles, prefix)
                                                : trace(shaded, setup));
        Comparison comparison = compare(name, images, result.drawn);
        comparison.walls =
            surfaces.compareWalls(result.drawn[static_cast<size_t>(Setting::full)], comparison.full);
        HEARTH_TRY(writeImages(comparison, prefix));
        result.comparisons.push_back(std::move(comparison));
    }
    if (result.comparisons.size() == 2)
        result.agreement = agree(result.comparisons[0], result.comparisons[1]);
    HEARTH_ASSIGN_OR_RETURN(result.drawn_occlusion, pictures.drawOcclusion(setup.camera));
    result.occlusion = surfaces.measureOcclusion(result.drawn_occlusion, kOcclusionRays);
    HEARTH_TRY(reference::writePng(prefix + "-traced-occlusion.png", result.occlusion.traced));
    return result;
}

void judge(const SceneResult& result, bench::Judgement& judgement)
{
    for (const Comparison& c : result.comparisons)
    {
        judgement.record("FLIP, nothing occludes: " + result.name, c.open_open.flip);
        judgement.record("FLIP, all on: " + result.name, c.full_full.flip);
        judgement.record("FLIP, default above all on: " + result.name, c.plain_full.flip - c.full_full.flip);
        if (result.name == kWallScene)
            judgement.record(kWallFigure, c.walls ? std::abs(*c.walls - 1) : std::nan(""));
    }
    if (result.name == kOcclusionScene)
        judgement.record(kOcclusionFigure, result.occlusion.rms);
}

void leaveOut(const Scene& scene, bench::Judgement& judgement)
{
    const std::string name(scene.name);
    for (const char* figure : {"FLIP, nothing occludes: ", "FLIP, all on: ", "FLIP, default above all on: "})
        judgement.leaveOut(figure + name);
    if (scene.name == kWallScene)
        judgement.leaveOut(kWallFigure);
    if (scene.name == kOcclusionScene)
        judgement.leaveOut(kOcclusionFigure);
}

std::string nightFigure(const std::string& name)
{
    return "FLIP, " + name + ": " + std::string(kNightScene);
}

/// Compare the night market beside rays, whatever references there are for other scenes.
Result<std::vector<NightComparison>> measureNight(const Arguments& arguments, bench::Judgement& judgement)
{
    if (!arguments.includes(kNightScene))
    {
        for (const char* name : {"lights without shadows", "lights with shadows"})
            judgement.leaveOut(nightFigure(name));
        return std::vector<NightComparison>{};
    }
    HEARTH_ASSIGN_OR_RETURN(std::vector<NightComparison> nights, compareMarketNight(arguments.work));
    for (const NightComparison& night : nights)
        judgement.record(nightFigure(night.name), night.difference.flip);
    std::printf("%s", describe(nights).c_str());
    return nights;
}

/// returns  exit code: 1 if an aim is missed
Result<int> measure(const Arguments& arguments)
{
    fs::create_directories(arguments.work);
    if (arguments.uses(kCycles))
    {
        const std::string report = arguments.work + "/closed-forms.txt";
        const Status checked = checkCycles(arguments.cycles, report);
        std::printf("Cycles in Hearth's units:\n%s", readBytes(report).c_str());
        HEARTH_TRY(checked);
    }
    bench::Judgement judgement("picture");
    std::vector<SceneResult> results;
    std::printf("%s", std::string(tableHead()).c_str());
    for (const Scene& scene : kScenes)
    {
        if (!arguments.includes(scene))
        {
            leaveOut(scene, judgement);
            continue;
        }
        const auto start = std::chrono::steady_clock::now();
        HEARTH_ASSIGN_OR_RETURN(SceneResult result, measureScene(scene, arguments));
        judge(result, judgement);
        std::printf("%s%-9s measured in %.0f s\n", describe(result).c_str(), "",
                    std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
        std::fflush(stdout);
        results.push_back(std::move(result));
    }
    HEARTH_ASSIGN_OR_RETURN(const std::vector<NightComparison> nights, measureNight(arguments, judgement));
    HEARTH_ASSIGN_OR_RETURN(const std::string page, makePage(results, nights, arguments.work));
    HEARTH_TRY(writeText(arguments.work + "/picture.html", page));
    std::printf("pictures and heat maps: %s/picture.html\n", arguments.work.c_str());
    return judgement.finish();
}

int run(int argc, char** argv)
{
    cli::CommandLine app("Compares Hearth's pictures with those of path tracers.");
    Arguments arguments;
    app.addOption("--assets", arguments.assets, "folder of real assets; without it samples alone");
    app.addOption("--work", arguments.work, "folder of all files that are made");
    app.addOption("--scene", arguments.scenes, "a scene; may be repeated (default: all)");
    app.addOption("--beside", arguments.references, "cycles, tracer, or both (default: tracer)")
        .delimiter(',')
        .choices(std::vector<std::string>{kCycles, kTracer});
    app.addOption("--scripts", arguments.cycles.scripts, "folder of the scripts for Blender");
    app.addOption("--samples", arguments.samples, "paths for each quarter of a pixel, in most scenes")
        .range(2u, 4096u);
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    const Result<int> measured = measure(arguments);
    return measured.ok() ? *measured : reportFailure(measured.error());
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::runProgram("hearth_measure_picture", [&] { return run(argc, argv); });
}

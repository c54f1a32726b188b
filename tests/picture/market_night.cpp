// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/picture/market_night.h"

#include "cook/tools/child_processes.h"
#include "runtime/pack/pack.h"
#include "runtime/viewer/camera_fit.h"
#include "runtime/viewer/shadow_options.h"
#include "tests/picture/night.h"
#include "tests/picture/programs.h"
#include "tests/reference/flip.h"

#include <cstdio>

namespace hearth::picture
{

namespace
{

/// Time of the flicker: any but the first shows that it runs.
constexpr double kSeconds = 3;

Result<pack::Pack> cookMarket(const std::string& work)
{
    const std::string programs = tools::programFolder() + "/", source = work + "/night.glb",
                      output = work + "/night.hearth";
    HEARTH_TRY(runProgram({programs + "hearth-samples", "market", "-o", source}));
    HEARTH_TRY(runProgram({programs + "hearth", "cook", "-q", source, "-o", output, "--visibility", "off",
                           "--bricks", "off", "--cache", "dir:" + work + "/cache"}));
    return pack::Pack::open(output);
}

} // namespace

Result<std::vector<NightComparison>> compareMarketNight(const std::string& work)
{
    HEARTH_ASSIGN_OR_RETURN(const pack::Pack market, cookMarket(work));
    const formats::PackView& view = market.view();
    const NightView night{
        .camera = viewer::sceneCamera(view, 0), .width = kWidth, .height = kHeight, .seconds = kSeconds};
    HEARTH_ASSIGN_OR_RETURN(const std::unique_ptr<viewer::VulkanHost> host, viewer::VulkanHost::create({}));
    HEARTH_ASSIGN_OR_RETURN(const std::unique_ptr<gpu::Renderer> renderer,
                            gpu::Renderer::create(host->description()));
    std::vector<NightComparison> nights;
    for (const bool has_shadows : {false, true})
    {
        const gpu::ShadowOptions shadows =
            has_shadows ? viewer::fitShadows({}, view, {&night.camera, 1}) : gpu::ShadowOptions{};
        HEARTH_ASSIGN_OR_RETURN(DrawnNight drawn, drawNight(*host, *renderer, view, night, shadows));
        HEARTH_ASSIGN_OR_RETURN(reference::Image traced, traceNight(view, night, drawn.casting));
        const reference::FlipMap map = reference::flip(traced, drawn.image);
        const std::string name = has_shadows ? "lights with shadows" : "lights without shadows";
        const std::string file = work + "/night-" + (has_shadows ? "shadows" : "open");
        HEARTH_TRY(reference::writePng(file + "-drawn.png", drawn.image));
        HEARTH_TRY(reference::writePng(file + "-traced.png", traced));
        nights.push_back({.name = name,
                          .drawn = std::move(drawn.image),
                          .traced = std::move(traced),
                          .difference = {map.mean(), reference::makeFlipImage(map)},
                          .lights = view.lights().size(),
                          .casting = drawn.casting.size()});
        HEARTH_TRY(reference::writePng(file + "-heat.png", nights.back().difference.heat));
    }
    return nights;
}

std::string describe(const std::vector<NightComparison>& nights)
{
    std::string lines;
    for (const NightComparison& night : nights)
    {
        char line[200];
        std::snprintf(line, sizeof(line), "%-9s %s: %.4f; %zu of %zu cast shadows\n",
                      std::string(kNightScene).c_str(), night.name.c_str(), night.difference.flip,
                      night.casting, night.lights);
        lines += line;
    }
    return lines;
}

} // namespace hearth::picture

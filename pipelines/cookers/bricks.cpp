// hearth-bricks: the sparse grid of bricks of all sources' scenes, for global illumination.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/cookers/words.h"
#include "pipelines/settings/make_setting.h"

#include <limits>

namespace hearth::cookers
{

namespace
{

using namespace settings;

constexpr std::string_view kInside = "bricks.inside";
constexpr std::string_view kOfProxies = "proxies";

std::vector<Setting> makeBrickSettings()
{
    return {
        switchSetting("bricks.mode",
                      "make the grid of bricks that global illumination is marched through; auto: for scenes "
                      "that see little of the sky",
                      "--bricks"),
        withSaving("larger voxels are fewer",
                   withOption(excludingLow(numberSetting("bricks.voxel_size", "metres, of the bricks' voxels",
                                                         "as their memory allows", 0,
                                                         std::numeric_limits<double>::infinity())),
                              "--voxel-size", "METRES")),
        withOption({"bricks.memory", Kind::size, "bytes that the bricks may take on the GPU", "20M"},
                   "--brick-memory", "SIZE"),
        withOption(choiceSetting(std::string(kInside),
                                 "what light leaks into through gaps of walls: proxies, not into closed "
                                 "proxies of meshes; source, through all gaps larger than voxels",
                                 kOfProxies, {kOfProxies, "source"}),
                   "--brick-inside", "NAME"),
    };
}

Result<Arguments> makeBrickArguments(const Values& values)
{
    Arguments arguments;
    // rays of emissive surfaces through the scene, summed in the order of the processor's vectors
    arguments.depends_on_processor = true;
    if (settings::choiceOr(values, "bricks.mode", "auto") == "auto")
        arguments.words.emplace_back("--if-needed");
    addOption(values, "bricks.voxel_size", "--voxel-size", arguments);
    addOption(values, "bricks.memory", "--memory", arguments);
    return arguments;
}

bool closesLeaks(const Values& values)
{
    return choiceOr(values, kInside, kOfProxies) == kOfProxies;
}

} // namespace

Cooker describeBricks()
{
    return {.name = "bricks",
            .scope = settings::Scope::pack,
            .switched_by = "bricks.mode",
            .reads = {"import", "clusters", "textures"},
            .reads_of_some = {"proxy"},
            .needsSome = closesLeaks,
            .reads_of_pack = {"probe"},
            .link_option = "--bricks",
            .has_statistics = true,
            .settings = makeBrickSettings(),
            .makeArguments = makeBrickArguments,
            // the generated room, a GLB of 2 MB, at 0.1 m with three bounces
            .cost = {16 * kMiB, 6, 0.4}};
}

} // namespace hearth::cookers

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

// the limit of the cooker; a test compares it with the values that it accepts
constexpr double kMaxBounces = 64;

std::vector<Setting> makeBrickSettings()
{
    return {
        flagSetting("bricks.enabled", "make the grid of bricks that global illumination is marched through",
                    "--bricks"),
        withSaving("larger voxels are fewer",
                   withOption(excludingLow(numberSetting("bricks.voxel_size", "metres, of the bricks' voxels",
                                                         "as their memory allows", 0,
                                                         std::numeric_limits<double>::infinity())),
                              "--voxel-size", "METRES")),
        withOption({"bricks.memory", Kind::size, "bytes that the bricks may take on the GPU", "20M"},
                   "--brick-memory", "SIZE"),
        withSaving("fewer bounces, or none",
                   withOption(wholeNumberSetting("bricks.bake",
                                                 "bake the light that bricks start with, of so many bounces",
                                                 "none is baked", 0, kMaxBounces),
                              "--brick-bake", "BOUNCES")),
    };
}

Result<Arguments> makeBrickArguments(const Values& values)
{
    Arguments arguments;
    // rays through the scene, summed in the order of the processor's vectors
    arguments.depends_on_processor = findValue(values, "bricks.bake") != nullptr;
    addOption(values, "bricks.voxel_size", "--voxel-size", arguments);
    addOption(values, "bricks.memory", "--memory", arguments);
    addOption(values, "bricks.bake", "--bake", arguments);
    return arguments;
}

} // namespace

Cooker describeBricks()
{
    return {.name = "bricks",
            .scope = settings::Scope::pack,
            .enabled_by = "bricks.enabled",
            .reads = {"import", "clusters", "textures"},
            .link_option = "--bricks",
            .has_statistics = true,
            .settings = makeBrickSettings(),
            .makeArguments = makeBrickArguments,
            // the generated room, a GLB of 2 MB, at 0.1 m with three bounces
            .cost = {16 * kMiB, 6, 0.4}};
}

} // namespace hearth::cookers

// hearth-visibility: visibility cones of vertices, for ambient and specular occlusion.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/cookers/words.h"
#include "pipelines/settings/make_setting.h"

#include <limits>

namespace hearth::cookers
{

namespace
{

using namespace settings;

constexpr std::string_view kOccluders = "visibility.occluders";
constexpr std::string_view kPackOccludes = "pack";
constexpr std::string_view kProxies = "visibility.proxies";
constexpr std::string_view kNoProxies = "none";

std::vector<Setting> makeVisibilitySettings()
{
    return {
        switchSetting("visibility.mode",
                      "bake what each vertex sees of its surroundings: ambient and specular occlusion",
                      "--visibility"),
        withSaving("draft takes fewer rays",
                   withOption(choiceSetting("visibility.quality", "rays that baking takes", "default",
                                            {"draft", "default", "high"}),
                              "--visibility-quality", "NAME")),
        withSaving(
            "source leaves the other sources out, mesh the other meshes, too",
            withOption(choiceSetting(std::string(kOccluders),
                                     "what is in the way: pack, all sources that are near; source, its own "
                                     "scene; mesh, each mesh alone",
                                     kPackOccludes, {kPackOccludes, "source", "mesh"}),
                       "--visibility-occluders", "NAME")),
        withSaving("all takes the rays of simple meshes",
                   withOption(choiceSetting(std::string(kProxies),
                                            "use of proxies that are near their meshes (proxy.from): fit, "
                                            "visibility is fitted on them, and meshes take it from there; "
                                            "all, rays start on them and meet them, too",
                                            kNoProxies, {kNoProxies, "fit", "all"}),
                              "--visibility-proxies", "NAME")),
        withSaving(
            "0 copies no mesh",
            withOption(numberSetting("visibility.copies",
                                     "bytes that copies of meshes may take, for instances that see too "
                                     "different a part of the sky, over those of the source's geometry",
                                     "0.25", 0, 64),
                       "--visibility-copies", "SHARE")),
        withSaving("a limit makes rays shorter",
                   withOption(excludingLow(numberSetting(
                                  "visibility.distance", "metres: what is farther away hides nothing",
                                  "no limit", 0, std::numeric_limits<double>::infinity())),
                              "--visibility-distance", "METRES")),
        withOption(
            numberSetting("visibility.power",
                          "visibility of what is t metres away is (t / distance)^power; needs a distance",
                          "0", 0, 16),
            "--visibility-power", "NUMBER"),
        withOption({"visibility.poses", Kind::texts,
                    "CLIP[@SECONDS,...]: bake deformed meshes in these poses, not in the bind pose; once "
                    "for each clip",
                    "[]"},
                   "--visibility-poses", "POSES"),
        withSaving(
            "false leaves the fit to harmonics out",
            flagSetting("visibility.refine",
                        "cones by nine harmonics instead of four moments; the report says what that gained",
                        "--visibility-refine")),
    };
}

Result<Arguments> makeVisibilityArguments(const Values& values)
{
    const Value* power = findValue(values, "visibility.power");
    if (power != nullptr && findValue(values, "visibility.distance") == nullptr)
        return Error{Issue::profile_value, power->origin, "visibility.power",
                     "needs visibility.distance, which is not set"};
    Arguments arguments;
    arguments.depends_on_processor = true;
    addOption(values, "visibility.quality", "--quality", arguments);
    addOption(values, kOccluders, "--occluders", arguments);
    addOption(values, kProxies, "--use-proxies", arguments);
    addOption(values, "visibility.copies", "--copies", arguments);
    addOption(values, "visibility.distance", "--distance", arguments);
    addOption(values, "visibility.power", "--power", arguments);
    addOption(values, "visibility.poses", "--poses", arguments);
    addFlag(values, "visibility.refine", "--refine-cones", arguments);
    // the estimate of noise would take a third as long as the work itself
    arguments.words.emplace_back("--no-noise-estimate");
    return arguments;
}

bool usesProxies(const Values& values)
{
    return choiceOr(values, kProxies, kNoProxies) != kNoProxies;
}

bool isOccludedByPack(const Values& values)
{
    return choiceOr(values, kOccluders, kPackOccludes) == kPackOccludes;
}

} // namespace

Cooker describeVisibility()
{
    return {.name = "visibility",
            .switched_by = "visibility.mode",
            .reads = {"import", "clusters"},
            .reads_of_some = {"proxy"},
            .needsSome = usesProxies,
            .listed_by = "neighbours",
            .needsList = isOccludedByPack,
            .replaces = "clusters",
            .has_statistics = true,
            .image_option = "--image",
            .settings = makeVisibilitySettings(),
            .makeArguments = makeVisibilityArguments,
            .cost = {16 * kMiB, 24, 0.35}}; // at quality draft
}

} // namespace hearth::cookers

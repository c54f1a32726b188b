// hearth-import: from source files to a part.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/cookers/registry.h"
#include "pipelines/cookers/words.h"
#include "pipelines/settings/make_setting.h"

namespace hearth::cookers
{

namespace
{

using namespace settings;

// the limits of the cooker; a test compares them with the values that it accepts
constexpr double kMaxAnimationError = 1000;
constexpr double kMinScale = 1e-9, kMaxScale = 1e9;

constexpr std::string_view kImportLayer = "import.layer";

std::vector<Setting> makeImportSettings()
{
    return {
        withOption(numberSetting("import.crease_angle",
                                 "degrees: sharper edges of a mesh without normals stay hard; 180: none does",
                                 "60", 0, 180),
                   "--crease-angle", "DEGREES"),
        withOption(numberSetting("import.scale", "metres of a unit of the source, as 0.01 of centimetres",
                                 "1", kMinScale, kMaxScale),
                   "--scale", "METRES"),
        withOption(choiceSetting("import.up", "the axis of the source that points up", "y", {"y", "z"}),
                   "--up", "AXIS"),
        {std::string(kImportLayer), Kind::text,
         "of EXR images: the part, or the layer in a part, that is read", "the first part with colours"},
        choiceSetting("import.icc",
                      "convert: colours of TIFF, PSD and JPEG 2000 become sRGB by their ICC profile",
                      "ignore", {"convert", "ignore"}),
        {std::string(kImportLods), Kind::texts,
         "files from the source's folder that are its levels of detail 1, 2, ..., made by hand; []: none, "
         "and no name makes the source a level",
         "the files X_LOD1, X_LOD2, ... beside an X_LOD0"},
        choiceSetting("import.sky",
                      "on: the image-based light of a scene is the sky of the pack, unless environment.file "
                      "names one",
                      "on", {"on", "off"}),
        withOption({std::string(kImportProxies), Kind::texts,
                    "MESH=FILE: proxies from files of the source's folder for the meshes or nodes of these "
                    "names; FILE alone is of the only mesh",
                    "those that the source has"},
                   "--proxy", "MESH=FILE"),
        withSaving(
            "0 takes the keys of clips as they are",
            numberSetting("animation.error",
                          "metres that a vertex may be off when a clip plays; 0: keys as in the source",
                          "2e-6 of the size of each model", 0, kMaxAnimationError)),
    };
}

Result<Arguments> makeImportArguments(const Values& values)
{
    const bool leaves_out_proxies = getProxyFrom(values) == "source";
    if (const Value* const files = findValue(values, kImportProxies); files != nullptr && leaves_out_proxies)
        return Error{Issue::profile_value, files->origin, std::string(kImportProxies),
                     "has no effect: proxy.from = \"source\" leaves proxies out"};
    Arguments arguments;
    addOption(values, "import.crease_angle", "--crease-angle", arguments);
    addOption(values, "import.scale", "--scale", arguments);
    addOption(values, "import.up", "--up", arguments);
    addOption(values, kImportLayer, "--layer", arguments);
    addOption(values, "import.icc", "--icc", arguments);
    addOption(values, "import.sky", "--sky", arguments);
    addOption(values, kImportProxies, "--proxy", arguments);
    if (leaves_out_proxies)
        arguments.words.insert(arguments.words.end(), {"--proxies", "off"});
    addAssignments(values, "animation", arguments);
    return arguments;
}

/// Meshes get UVs for the light that the pack bakes into texels, and the sky gets the pack's size.
std::vector<std::string> makeImportWordsOfPack(const Values& values)
{
    std::vector<std::string> words;
    if (isEnabled(*findCooker("receivers"), values, {}))
    {
        constexpr std::string_view kDensity = "receivers.texels_per_metre";
        const Value* const density = findValue(values, kDensity);
        words = {"--receivers", density != nullptr
                                    ? density->text
                                    : std::string(findSetting(profileSettings(), kDensity)->default_text)};
    }
    const Value* const sky_size = findValue(values, "environment.sky_size");
    if (sky_size != nullptr && !isEnabled(*findCooker("probe"), values, {}))
        words.insert(words.end(), {"--sky-size", sky_size->text});
    return words;
}

} // namespace

Cooker describeImport()
{
    return {.name = "import",
            .reads_files = true,
            .has_statistics = true,
            .settings = makeImportSettings(),
            .makeArguments = makeImportArguments,
            .makeWordsOfPack = makeImportWordsOfPack,
            .cost = {16 * kMiB, 6, 0.03}};
}

} // namespace hearth::cookers

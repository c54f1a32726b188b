// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/profiles/setting.h"

#include "cook/clusters/core/reduction.h"
#include "cook/textures/texture_part.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>

namespace hearth::profiles
{

namespace
{

constexpr double kMaxWholeNumber = std::numeric_limits<int32_t>::max();
constexpr double kNoLimit = std::numeric_limits<double>::infinity();
// the limits of the cookers; tests compare them with the values that the cookers accept
constexpr double kMaxWeight = double{clusters::kMaxErrorWeight};
constexpr double kMaxAnimationError = 1000;
constexpr double kMaxTexels = textures::kMaxTextureSize;
constexpr double kMaxBounces = 64;
constexpr double kMinScale = 1e-9, kMaxScale = 1e9;

Setting flagSetting(std::string key, std::string_view what, Scope scope, std::string_view option)
{
    Setting setting{std::move(key), Kind::flag, what, "false", scope};
    setting.option = option;
    return setting;
}

Setting numberSetting(std::string key, std::string_view what, std::string_view default_text, double low,
                      double high)
{
    Setting setting{std::move(key), Kind::number, what, default_text};
    setting.low = low;
    setting.high = high;
    return setting;
}

Setting wholeNumberSetting(std::string key, std::string_view what, std::string_view default_text, double low,
                           double high)
{
    Setting setting = numberSetting(std::move(key), what, default_text, low, high);
    setting.kind = Kind::whole;
    return setting;
}

Setting choiceSetting(std::string key, std::string_view what, std::string_view default_text,
                      std::vector<std::string_view> choices, Kind kind = Kind::choice)
{
    Setting setting{std::move(key), kind, what, default_text};
    setting.choices = std::move(choices);
    return setting;
}

Setting tablesSetting(std::string key, std::string_view what, std::string_view default_text,
                      std::vector<Setting> members)
{
    Setting setting{std::move(key), Kind::tables, what, default_text};
    setting.members = std::move(members);
    return setting;
}

Setting asRequired(Setting setting)
{
    setting.is_required = true;
    return setting;
}

Setting withOption(Setting setting, std::string_view option, std::string_view value_name)
{
    setting.option = option;
    setting.value_name = value_name;
    return setting;
}

Setting withVariable(Setting setting, std::string_view variable)
{
    setting.variable = variable;
    setting.scope = Scope::command;
    return setting;
}

Setting withSwitches(Setting setting, std::vector<EnvironmentSwitch> switches)
{
    setting.switches = std::move(switches);
    setting.scope = Scope::command;
    return setting;
}

Setting withSaving(std::string_view cooker, std::string_view advice, Setting setting)
{
    setting.saving = {cooker, advice};
    return setting;
}

Setting withPackScope(Setting setting)
{
    setting.scope = Scope::pack;
    return setting;
}

Setting excludingLow(Setting setting)
{
    setting.is_above_low = true;
    return setting;
}

Setting levelsSetting(const std::string& key)
{
    return tablesSetting(
        key, "entry k says what level of detail k becomes of the level below; the last one repeats",
        "[{keep=0.5,error_weight=1}]",
        {numberSetting("keep", "triangles that a group keeps, as part of what it has", "0.5",
                       double{clusters::kMinKeep}, double{clusters::kMaxKeep}),
         numberSetting("error_weight",
                       "factor on the stored error: what replaces a group is drawn where so much more error "
                       "is allowed",
                       "1", 1, kMaxWeight)});
}

/// Return the settings for all meshes, or for the meshes of a rule.
std::vector<Setting> meshSettings(const std::string& prefix)
{
    return {
        choiceSetting(prefix + "influences",
                      "joints that move a vertex of a skinned mesh at most: those with the largest weights",
                      "8", {"4", "8"}, Kind::whole),
        choiceSetting(prefix + "normal_bits", "bits of each of the two parts of a normal's code",
                      "16 where the surface is smooth, else 8", {"8", "16"}, Kind::whole),
        numberSetting(prefix + "normal_error_weight", "what turned normals count in the error", "1", 0,
                      kMaxWeight),
        numberSetting(prefix + "uv_error_weight", "what shifted UVs count in the error", "0.25", 0,
                      kMaxWeight),
    };
}

std::vector<Setting> meshMembers()
{
    std::vector<Setting> members{
        asRequired({"name", Kind::text, "meshes whose name this pattern matches; * and ? are wildcards", ""}),
        levelsSetting("levels"),
        tablesSetting(
            "targets", "how many triangles a level shall have; levels rise, triangles fall", "",
            {asRequired(wholeNumberSetting("level", "the level of detail", "", 1, kMaxWholeNumber)),
             asRequired(wholeNumberSetting("triangles", "that are drawn at it", "", 1, kMaxWholeNumber))}),
    };
    for (Setting& setting : meshSettings(""))
        members.push_back(std::move(setting));
    return members;
}

std::vector<Setting> makeProfileSettings()
{
    std::vector<Setting> settings{
        withOption(numberSetting("import.crease_angle",
                                 "degrees: sharper edges of a mesh without normals stay hard; 180: none does",
                                 "60", 0, 180),
                   "--crease-angle", "DEGREES"),
        withOption(numberSetting("import.scale", "metres of a unit of the source, as 0.01 of centimetres",
                                 "1", kMinScale, kMaxScale),
                   "--scale", "METRES"),
        withOption(choiceSetting("import.up", "the axis of the source that points up", "y", {"y", "z"}),
                   "--up", "AXIS"),
        {std::string(kImportLods), Kind::texts,
         "files from the source's folder that are its levels of detail 1, 2, ..., made by hand; []: none, "
         "and "
         "no name makes the source a level",
         "the files X_LOD1, X_LOD2, ... beside an X_LOD0"},
        withSaving(
            "import", "0 takes the keys of clips as they are",
            numberSetting("animation.error",
                          "metres that a vertex may be off when a clip plays; 0: keys as in the source",
                          "2e-6 of the size of each model", 0, kMaxAnimationError)),
        withSaving("clusters", "a smaller keep makes fewer levels", levelsSetting("clusters.levels")),
    };
    for (Setting& setting : meshSettings("clusters."))
        settings.push_back(std::move(setting));
    const std::vector<Setting> more{
        tablesSetting("clusters.mesh", "rules for meshes: the first whose name matches holds", "",
                      meshMembers()),
        tablesSetting("clusters.material",
                      "rules for materials in any mesh: the first whose name matches holds", "",
                      {asRequired({"name", Kind::text, "materials whose name this pattern matches", ""}),
                       asRequired(levelsSetting("levels"))}),
        withSaving(
            "textures", "smaller textures are less to compress",
            withOption(wholeNumberSetting(
                           "textures.max_size",
                           "texels: the longer side of the textures that are kept; finer mips are left out",
                           "as in the source", 1, kMaxTexels),
                       "--max-texture-size", "TEXELS")),
        flagSetting("visibility.enabled",
                    "bake what each vertex sees of its surroundings: ambient and specular occlusion",
                    Scope::source, "--visibility"),
        withSaving("visibility", "draft takes fewer rays",
                   withOption(choiceSetting("visibility.quality", "rays that baking takes", "default",
                                            {"draft", "default", "high"}),
                              "--visibility-quality", "NAME")),
        withSaving(
            "visibility", "asset traces each mesh alone, not in its scene",
            withOption(choiceSetting("visibility.occluders",
                                     "what is in the way: all of the source's scene, or each asset alone",
                                     "scene", {"scene", "asset"}),
                       "--visibility-occluders", "NAME")),
        withSaving("visibility", "a limit makes rays shorter",
                   withOption(excludingLow(numberSetting("visibility.distance",
                                                         "metres: what is farther away hides nothing",
                                                         "no limit", 0, kNoLimit)),
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
            "visibility", "false leaves the fit to harmonics out",
            flagSetting("visibility.refine",
                        "cones by nine harmonics instead of four moments; the report says what that gained",
                        Scope::source, "--visibility-refine")),
        flagSetting("bricks.enabled", "make the grid of bricks that global illumination is marched through",
                    Scope::pack, "--bricks"),
        withSaving("bricks", "larger voxels are fewer",
                   withPackScope(withOption(
                       excludingLow(numberSetting("bricks.voxel_size", "metres, of the bricks' voxels",
                                                  "as their memory allows", 0, kNoLimit)),
                       "--voxel-size", "METRES"))),
        withPackScope(
            withOption({"bricks.memory", Kind::size, "bytes that the bricks may take on the GPU", "20M"},
                       "--brick-memory", "SIZE")),
        withSaving(
            "bricks", "fewer bounces, or none",
            withPackScope(withOption(
                wholeNumberSetting("bricks.bake", "bake the light that bricks start with, of so many bounces",
                                   "none is baked", 0, kMaxBounces),
                "--brick-bake", "BOUNCES"))),
    };
    settings.insert(settings.end(), more.begin(), more.end());
    return settings;
}

std::vector<Setting> makeCommandSettings()
{
    return {
        withVariable(withOption({"profile", Kind::text,
                                 "how far sources are cooked down: mobile-high, mobile-low, desktop, one "
                                 "of hearth.toml, or a TOML file",
                                 "none: each cooker's defaults"},
                                "-p,--profile", "NAME"),
                     "HEARTH_PROFILE"),
        withVariable(withOption(wholeNumberSetting("jobs", "cookers that run at once",
                                                   "2, and of small sources one a core", 1, 1024),
                                "-j,--jobs", "N"),
                     "HEARTH_JOBS"),
        withVariable(withOption({"memory", Kind::size, "what the cookers may take together, as 12G",
                                 "three quarters of the machine's"},
                                "--memory", "SIZE"),
                     "HEARTH_MEMORY"),
        withVariable(
            withOption(
                {"cache", Kind::texts,
                 "dir:FOLDER[,ro][,size=20G] or http(s)://HOST/PATH[,ro]; may be repeated, nearest first",
                 "the user's own"},
                "--cache", "SPEC"),
            "HEARTH_CACHE"),
        withVariable(
            choiceSetting("log",
                          "how much is told: errors alone, or all that cookers say as well; -q and -v "
                          "of the command line",
                          "normal", {"quiet", "normal", "verbose"}),
            "HEARTH_LOG"),
        withVariable(
            withOption(
                choiceSetting("progress",
                              "what is shown meanwhile; auto: a bar on a terminal, else a line for each "
                              "source and one every ten seconds",
                              "auto", {"auto", "bar", "plain", "none"}),
                "--progress", "NAME"),
            "HEARTH_PROGRESS"),
        withSwitches(
            withOption(choiceSetting("color",
                                     "of messages; auto: on a terminal, as NO_COLOR, CLICOLOR_FORCE and "
                                     "CI say",
                                     "auto", {"auto", "always", "never"}),
                       "--color", "NAME"),
            {{"NO_COLOR", "never"}, {"CLICOLOR_FORCE", "always"}}),
    };
}

} // namespace

std::span<const Setting> profileSettings()
{
    static const std::vector<Setting> settings = makeProfileSettings();
    return settings;
}

std::span<const Setting> commandSettings()
{
    static const std::vector<Setting> settings = makeCommandSettings();
    return settings;
}

const Setting* findSetting(std::span<const Setting> settings, std::string_view key)
{
    const auto found = std::find_if(settings.begin(), settings.end(),
                                    [&](const Setting& setting) { return setting.key == key; });
    return found == settings.end() ? nullptr : &*found;
}

std::string_view settingGroup(std::string_view key)
{
    return key.substr(0, key.find('.'));
}

std::string rangeText(const Setting& setting)
{
    const char* const number = setting.kind == Kind::whole ? "a whole number" : "a number";
    switch (setting.kind)
    {
    case Kind::flag:
        return "true or false";
    case Kind::whole:
    case Kind::number:
        if (!setting.choices.empty())
            return fmt::format("{}", fmt::join(setting.choices, " or "));
        if (setting.is_above_low)
            return fmt::format("{} above {:g}", number, setting.low);
        if (setting.high == kMaxWholeNumber)
            return fmt::format("{} from {:g} on", number, setting.low);
        return fmt::format("{} from {:g} to {:g}", number, setting.low, setting.high);
    case Kind::choice:
        return fmt::format("one of {}", fmt::join(setting.choices, ", "));
    case Kind::text:
        return "a text that is not empty";
    case Kind::texts:
        return "an array of texts";
    case Kind::size:
        return "a size, as 512M or 20G";
    case Kind::tables:
        return "an array of at least one table";
    }
    return "";
}

} // namespace hearth::profiles

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

constexpr double kMostWhole = std::numeric_limits<int32_t>::max();
constexpr double kNoLimit = std::numeric_limits<double>::infinity();
// the limits of the cookers; tests compare them with the values that the cookers accept
constexpr double kMostWeight = double{clusters::kLargestErrorWeight};
constexpr double kMostAnimationError = 1000;
constexpr double kMostTexels = textures::kLargestSize;
constexpr double kMostBounces = 64;
constexpr double kLeastScale = 1e-9, kLargestScale = 1e9;

Setting flagOf(std::string key, std::string_view what, Scope scope, std::string_view option)
{
    Setting setting{std::move(key), Kind::flag, what, "false", scope};
    setting.option = option;
    return setting;
}

Setting numberOf(std::string key, std::string_view what, std::string_view otherwise, double low, double high)
{
    Setting setting{std::move(key), Kind::number, what, otherwise};
    setting.low = low;
    setting.high = high;
    return setting;
}

Setting wholeOf(std::string key, std::string_view what, std::string_view otherwise, double low, double high)
{
    Setting setting = numberOf(std::move(key), what, otherwise, low, high);
    setting.kind = Kind::whole;
    return setting;
}

Setting choiceOf(std::string key, std::string_view what, std::string_view otherwise,
                 std::vector<std::string_view> choices, Kind kind = Kind::choice)
{
    Setting setting{std::move(key), kind, what, otherwise};
    setting.choices = std::move(choices);
    return setting;
}

Setting tablesOf(std::string key, std::string_view what, std::string_view otherwise,
                 std::vector<Setting> members)
{
    Setting setting{std::move(key), Kind::tables, what, otherwise};
    setting.members = std::move(members);
    return setting;
}

Setting needed(Setting setting)
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

Setting withSwitches(Setting setting, std::vector<Switch> switches)
{
    setting.switches = std::move(switches);
    setting.scope = Scope::command;
    return setting;
}

Setting cheaper(std::string_view cooker, std::string_view advice, Setting setting)
{
    setting.saving = {cooker, advice};
    return setting;
}

Setting ofPack(Setting setting)
{
    setting.scope = Scope::pack;
    return setting;
}

Setting aboveLow(Setting setting)
{
    setting.is_above_low = true;
    return setting;
}

Setting levelsOf(const std::string& key)
{
    return tablesOf(
        key, "entry k says what level of detail k becomes of the level below; the last one repeats",
        "[{keep=0.5,error_weight=1}]",
        {numberOf("keep", "triangles that a group keeps, as part of what it has", "0.5",
                  double{clusters::kSmallestKeep}, double{clusters::kLargestKeep}),
         numberOf("error_weight",
                  "factor on the stored error: what replaces a group is drawn where so much more error "
                  "is allowed",
                  "1", 1, kMostWeight)});
}

/// Return the settings for all meshes, or for the meshes of a rule.
std::vector<Setting> meshSettings(const std::string& prefix)
{
    return {
        choiceOf(prefix + "influences",
                 "joints that move a vertex of a skinned mesh at most: those with the largest weights", "8",
                 {"4", "8"}, Kind::whole),
        choiceOf(prefix + "normal_bits", "bits of each of the two parts of a normal's code",
                 "16 where the surface is smooth, else 8", {"8", "16"}, Kind::whole),
        numberOf(prefix + "normal_error_weight", "what turned normals count in the error", "1", 0,
                 kMostWeight),
        numberOf(prefix + "uv_error_weight", "what shifted UVs count in the error", "0.25", 0, kMostWeight),
    };
}

std::vector<Setting> meshMembers()
{
    std::vector<Setting> members{
        needed({"name", Kind::text, "meshes whose name this pattern matches; * and ? are wildcards", ""}),
        levelsOf("levels"),
        tablesOf("targets", "how many triangles a level shall have; levels rise, triangles fall", "",
                 {needed(wholeOf("level", "the level of detail", "", 1, kMostWhole)),
                  needed(wholeOf("triangles", "that are drawn at it", "", 1, kMostWhole))}),
    };
    for (Setting& setting : meshSettings(""))
        members.push_back(std::move(setting));
    return members;
}

std::vector<Setting> makeProfileSettings()
{
    std::vector<Setting> settings{
        withOption(numberOf("import.crease_angle",
                            "degrees: sharper edges of a mesh without normals stay hard; 180: none does",
                            "60", 0, 180),
                   "--crease-angle", "DEGREES"),
        withOption(numberOf("import.scale", "metres of a unit of the source, as 0.01 of centimetres", "1",
                            kLeastScale, kLargestScale),
                   "--scale", "METRES"),
        withOption(choiceOf("import.up", "the axis of the source that points up", "y", {"y", "z"}), "--up",
                   "AXIS"),
        {std::string(kImportLods), Kind::texts,
         "files from the source's folder that are its levels of detail 1, 2, ..., made by hand; []: none, "
         "and "
         "no name makes the source a level",
         "the files X_LOD1, X_LOD2, ... beside an X_LOD0"},
        cheaper("import", "0 takes the keys of clips as they are",
                numberOf("animation.error",
                         "metres that a vertex may be off when a clip plays; 0: keys as in the source",
                         "2e-6 of the size of each model", 0, kMostAnimationError)),
        cheaper("clusters", "a smaller keep makes fewer levels", levelsOf("clusters.levels")),
    };
    for (Setting& setting : meshSettings("clusters."))
        settings.push_back(std::move(setting));
    const std::vector<Setting> more{
        tablesOf("clusters.mesh", "rules for meshes: the first whose name matches holds", "", meshMembers()),
        tablesOf("clusters.material", "rules for materials in any mesh: the first whose name matches holds",
                 "",
                 {needed({"name", Kind::text, "materials whose name this pattern matches", ""}),
                  needed(levelsOf("levels"))}),
        cheaper("textures", "smaller textures are less to compress",
                withOption(
                    wholeOf("textures.max_size",
                            "texels: the longer side of the textures that are kept; finer mips are left out",
                            "as in the source", 1, kMostTexels),
                    "--max-texture-size", "TEXELS")),
        flagOf("visibility.enabled",
               "bake what each vertex sees of its surroundings: ambient and specular occlusion",
               Scope::source, "--visibility"),
        cheaper("visibility", "draft takes fewer rays",
                withOption(choiceOf("visibility.quality", "rays that baking takes", "default",
                                    {"draft", "default", "high"}),
                           "--visibility-quality", "NAME")),
        cheaper("visibility", "asset traces each mesh alone, not in its scene",
                withOption(choiceOf("visibility.occluders",
                                    "what is in the way: all of the source's scene, or each asset alone",
                                    "scene", {"scene", "asset"}),
                           "--visibility-occluders", "NAME")),
        cheaper(
            "visibility", "a limit makes rays shorter",
            withOption(aboveLow(numberOf("visibility.distance", "metres: what is farther away hides nothing",
                                         "no limit", 0, kNoLimit)),
                       "--visibility-distance", "METRES")),
        withOption(numberOf("visibility.power",
                            "visibility of what is t metres away is (t / distance)^power; needs a distance",
                            "0", 0, 16),
                   "--visibility-power", "NUMBER"),
        withOption({"visibility.poses", Kind::texts,
                    "CLIP[@SECONDS,...]: bake deformed meshes in these poses, not in the bind pose; once "
                    "for each clip",
                    "[]"},
                   "--visibility-poses", "POSES"),
        cheaper("visibility", "false leaves the fit to harmonics out",
                flagOf("visibility.refine",
                       "cones by nine harmonics instead of four moments; the report says what that gained",
                       Scope::source, "--visibility-refine")),
        flagOf("bricks.enabled", "make the grid of bricks that global illumination is marched through",
               Scope::pack, "--bricks"),
        cheaper("bricks", "larger voxels are fewer",
                ofPack(withOption(aboveLow(numberOf("bricks.voxel_size", "metres, of the bricks' voxels",
                                                    "as their memory allows", 0, kNoLimit)),
                                  "--voxel-size", "METRES"))),
        ofPack(withOption({"bricks.memory", Kind::size, "bytes that the bricks may take on the GPU", "20M"},
                          "--brick-memory", "SIZE")),
        cheaper("bricks", "fewer bounces, or none",
                ofPack(withOption(wholeOf("bricks.bake",
                                          "bake the light that bricks start with, of so many bounces",
                                          "none is baked", 0, kMostBounces),
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
        withVariable(withOption(wholeOf("jobs", "cookers that run at once",
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
        withVariable(choiceOf("log",
                              "how much is told: errors alone, or all that cookers say as well; -q and -v "
                              "of the command line",
                              "normal", {"quiet", "normal", "verbose"}),
                     "HEARTH_LOG"),
        withVariable(
            withOption(choiceOf("progress",
                                "what is shown meanwhile; auto: a bar on a terminal, else a line for each "
                                "source and one every ten seconds",
                                "auto", {"auto", "bar", "plain", "none"}),
                       "--progress", "NAME"),
            "HEARTH_PROGRESS"),
        withSwitches(withOption(choiceOf("color",
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

std::string_view groupOf(std::string_view key)
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
        if (setting.high == kMostWhole)
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

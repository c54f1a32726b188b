// hearth-texels: compression of textures for the target.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/rules/texture_rules.h"
#include "pipelines/cookers/texel_arguments.h"
#include "pipelines/cookers/words.h"
#include "pipelines/settings/make_setting.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hearth::cookers
{

namespace
{

using namespace settings;

Status checkFamilies(const std::string& key, const std::string& text)
{
    texels::Families families;
    for (const std::string& family : valueTexts({text, ""}))
        if (!texels::addFamily(family, families))
            return Error{Issue::profile_value, "", key,
                         fmt::format("\"{}\" is none of {}", family, fmt::join(texels::familyNames(), ", "))};
    return success();
}

Setting familiesSetting(std::string key, std::string_view default_text)
{
    Setting setting{
        .key = std::move(key),
        .kind = Kind::texts,
        .what = "compressed formats that the target reads: astc, astc-hdr (light, by an extension), etc2 "
                "(with EAC), bc; an empty list keeps plain texels",
        .default_text = default_text};
    setting.check = checkFamilies;
    return setting;
}

Setting qualitySetting(std::string key, std::string_view default_text)
{
    return choiceSetting(std::move(key),
                         "error that textures may have, and effort: colours at least 34, 39 or 43 dB, "
                         "normals at most 3, 1.5 or .75 degrees",
                         default_text, {"draft", "normal", "high"});
}

/// Check rules with the cooker's own parser: members may contradict each other.
Status checkRules(const std::string& key, const std::string& text)
{
    const auto rules = texels::parseTextureRules(key + "=" + text, "");
    if (rules.ok())
        return success();
    Error error = rules.error();
    error.detail = fmt::format("{}: {}", error.where, error.detail);
    return error;
}

/// Make a setting with rules for textures.
/// members  those that say which textures a rule is for
Setting rulesSetting(std::string key, std::string_view what, std::vector<Setting> members)
{
    const std::vector<Setting> choice{
        numberSetting(
            "target",
            "error of these textures: decibels, at least, of colours and data; degrees, at most, of "
            "normals; stops of light",
            "as quality says", 0, 100),
        qualitySetting("quality", "textures.quality"),
        familiesSetting("families", "textures.families"),
        {"format", Kind::text,
         "format of these textures, whatever its error: as hearth inspect prints it, without its last part "
         "if need be (astc-6x6, bc7), or plain",
         ""}};
    members.insert(members.end(), choice.begin(), choice.end());
    Setting setting = tablesSetting(std::move(key), what, "", std::move(members));
    setting.check = checkRules;
    return setting;
}

std::vector<Setting> makeTexelSettings()
{
    return {
        familiesSetting("textures.families", "[\"astc\", \"etc2\"]"),
        withSaving("draft encodes faster",
                   withOption(qualitySetting("textures.quality", "normal"), "--texture-quality", "QUALITY")),
        flagSetting("textures.strict", "a texture that misses its error in all formats is not compressed",
                    ""),
        rulesSetting("textures.role", "rules for textures of a role: the first of that role holds",
                     {asRequired(choiceSetting("role", "role of the textures", "",
                                               {"color", "cutout", "emissive", "data", "normal", "light"}))}),
        rulesSetting(
            "textures.image",
            "rules for textures by name or by the path of their source, over those by role: the first that "
            "matches holds",
            {{"name", Kind::text,
              "textures whose name, or whose file's name, this pattern matches; * and ? are wildcards",
              "all"},
             {"path", Kind::text,
              "textures of sources whose path from the folder of hearth.toml this pattern matches, as "
              "assets/ui/**",
              "all"}})};
}

} // namespace

Cooker describeTexels()
{
    return {.name = "texels",
            .switched_by = "textures.families",
            .reads = {"import", "textures"},
            .listed_by = "budget",
            .replaces = "textures",
            .has_statistics = true,
            .image_option = "--image",
            .settings = makeTexelSettings(),
            .makeArguments = makeTexelArguments,
            .cost = {32 * kMiB, 4.5, 1}};
}

} // namespace hearth::cookers

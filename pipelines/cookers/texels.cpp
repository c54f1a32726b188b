// hearth-texels: compression of textures for the target.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/cookers/words.h"
#include "pipelines/settings/make_setting.h"

#include <algorithm>

namespace hearth::cookers
{

namespace
{

using namespace settings;

constexpr std::string_view kFamilies[] = {"astc", "etc2", "bc"};

Status checkFamilies(const std::string& key, const std::string& text)
{
    for (const std::string& family : valueTexts({text, ""}))
        if (std::ranges::find(kFamilies, family) == std::end(kFamilies))
            return Error{Issue::profile_value, "", key, "\"" + family + "\" is none of astc, etc2, bc"};
    return success();
}

Setting familiesSetting()
{
    Setting setting{.key = "textures.families",
                    .kind = Kind::texts,
                    .what =
                        "compressed formats that the target reads: astc, etc2 (with EAC), bc; an empty list "
                        "keeps plain texels",
                    .default_text = "[\"astc\", \"etc2\"]"};
    setting.check = checkFamilies;
    return setting;
}

std::vector<Setting> makeTexelSettings()
{
    return {
        familiesSetting(),
        withSaving("draft encodes faster",
                   withOption(choiceSetting("textures.quality",
                                            "error that textures may have, and effort: colours at least 34, "
                                            "36.5 or 42 dB, normals at most 4.5, 3 or 2 degrees",
                                            "normal", {"draft", "normal", "high"}),
                              "--texture-quality", "QUALITY")),
        flagSetting("textures.strict", "a texture that misses its error in all formats is not compressed",
                    "")};
}

Result<Arguments> makeTexelArguments(const Values& values)
{
    Arguments arguments;
    addOption(values, "textures.families", "--family", arguments);
    addOption(values, "textures.quality", "--quality", arguments);
    addFlag(values, "textures.strict", "--strict", arguments);
    return arguments;
}

} // namespace

Cooker describeTexels()
{
    return {.name = "texels",
            .switched_by = "textures.families",
            .reads = {"import", "textures"},
            .replaces = "textures",
            .has_statistics = true,
            .settings = makeTexelSettings(),
            .makeArguments = makeTexelArguments,
            .cost = {32 * kMiB, 4.5, 1}};
}

} // namespace hearth::cookers

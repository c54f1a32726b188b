// hearth-textures: mips of the images of a source.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/textures/texture_part.h"
#include "pipelines/cookers/words.h"
#include "pipelines/settings/make_setting.h"

namespace hearth::cookers
{

namespace
{

using namespace settings;

Setting specularAaSetting()
{
    Setting setting =
        flagSetting("textures.specular_aa",
                    "roughness rises in mips by the normals that the mips of a normal map lose: distant "
                    "bumps look rough and do not sparkle",
                    "");
    setting.default_text = "true";
    return setting;
}

std::vector<Setting> makeTextureSettings()
{
    return {
        withSaving(
            "smaller textures are less to compress",
            withOption(wholeNumberSetting(
                           "textures.max_size",
                           "texels: the longer side of the textures that are kept; finer mips are left out",
                           "as in the source", 1, textures::kMaxTextureSize),
                       "--max-texture-size", "TEXELS")),
        choiceSetting("textures.max_bits", "bits of a channel of data and normals that have 16 in the source",
                      "16", {"8", "16"}, Kind::whole),
        specularAaSetting()};
}

Result<Arguments> makeTextureArguments(const Values& values)
{
    Arguments arguments;
    addOption(values, "textures.max_size", "--max-size", arguments);
    addOption(values, "textures.max_bits", "--max-bits", arguments);
    if (const Value* const value = findValue(values, "textures.specular_aa");
        value != nullptr && value->text == "false")
        arguments.words.emplace_back("--no-specular-aa");
    return arguments;
}

} // namespace

Cooker describeTextures()
{
    return {.name = "textures",
            .reads = {"import"},
            .has_statistics = true,
            .settings = makeTextureSettings(),
            .makeArguments = makeTextureArguments,
            .cost = {16 * kMiB, 4.5, 0.04}};
}

} // namespace hearth::cookers

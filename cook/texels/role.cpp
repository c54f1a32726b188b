// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/role.h"

#include <algorithm>

namespace hearth::texels
{

using namespace formats;

namespace
{

struct RoleChannels
{
    std::string_view use; ///< as ImageUse::role
    Channels channels;
};

/// Channels that shaders read, beside alpha of a base colour. Source: glTF 2.0 and its extensions; those of
/// specular and sheen have a factor or a roughness in alpha.
constexpr RoleChannels kReads[] = {{"baseColor", kRgb},          {"metallicRoughness", kGreen | kBlue},
                                   {"normal", kRed | kGreen},    {"occlusion", kRed},
                                   {"emissive", kRgb},           {"specular", kRgb | kAlpha},
                                   {"clearcoat", kRed | kGreen}, {"clearcoatNormal", kRed | kGreen},
                                   {"sheen", kRgb | kAlpha}};

Channels readChannels(std::string_view use)
{
    const auto* const found = std::find_if(std::begin(kReads), std::end(kReads),
                                           [&](const RoleChannels& r) { return r.use == use; });
    return found == std::end(kReads) ? kRgb | kAlpha : found->channels;
}

} // namespace

ImageReads findReads(const ImageRecord& image, std::span<const ImageUse> uses,
                     std::span<const MaterialRecord> materials)
{
    ImageReads reads;
    bool is_cutout = false, is_emissive = !uses.empty();
    for (const ImageUse& use : uses)
    {
        reads.channels |= readChannels(use.role);
        const auto mode = static_cast<AlphaMode>(materials[use.material].alpha_mode);
        is_cutout = is_cutout || (use.role == "baseColor" && mode != AlphaMode::opaque);
        is_emissive = is_emissive && use.role == "emissive";
    }
    if (uses.empty())
        reads.channels = kRgb | kAlpha;
    if (findTexelFormat(image.format)->coding == TexelCoding::float_value)
        reads.role = ImageRole::light;
    else if ((image.flags & kImageNormalMap) != 0)
        reads.role = ImageRole::normal;
    else if (!isSrgb(image.format))
        reads.role = ImageRole::data;
    else if (is_cutout)
        reads.role = ImageRole::cutout;
    else
        reads.role = is_emissive ? ImageRole::emissive : ImageRole::color;
    if (reads.role == ImageRole::cutout)
        reads.channels |= kAlpha;
    if (reads.role == ImageRole::normal)
        reads.channels = kRed | kGreen;
    return reads;
}

} // namespace hearth::texels

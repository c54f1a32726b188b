// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/frame/color_format.h"

#include <algorithm>

namespace hearth::gpu
{

namespace
{

#define HEARTH_COLOR_FORMAT(name, content, bytes)                                                            \
    {                                                                                                        \
        VK_FORMAT_##name, #name, ColorContent::content, bytes                                                \
    }

constexpr ColorFormat kColorFormats[] = {
    HEARTH_COLOR_FORMAT(R8G8B8A8_SRGB, display, 4),
    HEARTH_COLOR_FORMAT(B8G8R8A8_SRGB, display, 4),
    HEARTH_COLOR_FORMAT(R8G8B8A8_UNORM, codes, 4),
    HEARTH_COLOR_FORMAT(B8G8R8A8_UNORM, codes, 4),
    HEARTH_COLOR_FORMAT(A2B10G10R10_UNORM_PACK32, codes, 4),
    HEARTH_COLOR_FORMAT(A2R10G10B10_UNORM_PACK32, codes, 4),
    HEARTH_COLOR_FORMAT(R16G16B16A16_SFLOAT, radiance, 8),
    HEARTH_COLOR_FORMAT(B10G11R11_UFLOAT_PACK32, radiance, 4),
};

#undef HEARTH_COLOR_FORMAT

} // namespace

std::span<const ColorFormat> colorFormats()
{
    return kColorFormats;
}

const ColorFormat* findColorFormat(VkFormat format)
{
    const auto* found = std::find_if(std::begin(kColorFormats), std::end(kColorFormats),
                                     [&](const ColorFormat& known) { return known.format == format; });
    return found == std::end(kColorFormats) ? nullptr : found;
}

} // namespace hearth::gpu

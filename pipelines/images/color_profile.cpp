// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/images/color_profile.h"

#include <lcms2.h>

namespace hearth::images
{

namespace
{

struct ProfileDeleter
{
    void operator()(void* profile) const { cmsCloseProfile(profile); }
};
using Profile = std::unique_ptr<void, ProfileDeleter>;

cmsColorSpaceSignature colorSpace(unsigned channel_count)
{
    return channel_count == 1 ? cmsSigGrayData : channel_count == 3 ? cmsSigRgbData : cmsSigCmykData;
}

/// Return the description of interleaved channels for lcms2.
cmsUInt32Number layout(unsigned color_space, size_t channel_count, size_t channel_bytes)
{
    return static_cast<cmsUInt32Number>(COLORSPACE_SH(color_space) | CHANNELS_SH(channel_count) |
                                        BYTES_SH(channel_bytes));
}

} // namespace

void ColorProfile::Deleter::operator()(void* transform) const
{
    cmsDeleteTransform(transform);
}

std::optional<ColorProfile> ColorProfile::read(std::span<const std::byte> profile, unsigned channel_count,
                                               size_t channel_bytes)
{
    const Profile source(cmsOpenProfileFromMem(profile.data(), static_cast<cmsUInt32Number>(profile.size())));
    if (!source || cmsGetColorSpace(source.get()) != colorSpace(channel_count))
        return std::nullopt;
    const Profile srgb(cmsCreate_sRGBProfile());
    const unsigned pixels = channel_count == 1 ? PT_GRAY : channel_count == 3 ? PT_RGB : PT_CMYK;
    void* transform =
        cmsCreateTransform(source.get(), layout(pixels, channel_count, channel_bytes), srgb.get(),
                           layout(PT_RGB, 3, channel_bytes), INTENT_RELATIVE_COLORIMETRIC,
                           cmsFLAGS_BLACKPOINTCOMPENSATION | cmsFLAGS_HIGHRESPRECALC | cmsFLAGS_NOCACHE);
    if (transform == nullptr)
        return std::nullopt;
    return ColorProfile(transform);
}

void ColorProfile::convert(const void* colors, void* rgb, size_t count) const
{
    cmsDoTransform(transform_.get(), colors, rgb, static_cast<cmsUInt32Number>(count));
}

} // namespace hearth::images

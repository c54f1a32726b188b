// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/images/channels.h"

#include "formats/base/assert.h"
#include "formats/pack/pack_view.h"
#include "pipelines/import/images/resized_image.h"

#include <algorithm>
#include <cstring>

namespace hearth::import
{

namespace
{

constexpr uint32_t kWidening = 257; ///< 255 becomes 65535

/// Return channel `at` of all channels, in 16 bits.
uint16_t readChannel(const DecodedImage& image, size_t at)
{
    if (image.type == ChannelType::unorm8)
        return static_cast<uint16_t>(std::to_integer<uint32_t>(image.texels[at]) * kWidening);
    uint16_t channel;
    std::memcpy(&channel, image.texels.data() + at * sizeof(channel), sizeof(channel));
    return channel;
}

size_t countChannels(const DecodedImage& image)
{
    return image.texels.size() / image.channelBytes();
}

} // namespace

DecodedImage dropEmptyBits(DecodedImage image)
{
    if (image.type != ChannelType::unorm16)
        return image;
    for (size_t at = 0; at < countChannels(image); ++at)
        if (readChannel(image, at) % kWidening != 0)
            return image;
    return narrow(std::move(image));
}

DecodedImage narrow(DecodedImage image)
{
    HEARTH_ASSERT(!image.isFloat());
    if (image.type == ChannelType::unorm8)
        return image;
    const size_t count = countChannels(image);
    for (size_t at = 0; at < count; ++at)
        image.texels[at] = std::byte{formats::narrowUnorm(readChannel(image, at))};
    image.texels.resize(count);
    image.texels.shrink_to_fit();
    image.type = ChannelType::unorm8;
    return image;
}

DecodedImage mergeChannels(const DecodedImage& first, const DecodedImage& second, uint32_t first_channels)
{
    DecodedImage merged =
        blankImage(std::max(first.width, second.width), std::max(first.height, second.height));
    const ResizedImage first_texels(first, merged.width, merged.height);
    const ResizedImage second_texels(second, merged.width, merged.height);
    std::byte* out = merged.texels.data();
    for (uint32_t y = 0; y < merged.height; ++y)
        for (uint32_t x = 0; x < merged.width; ++x, out += 4)
        {
            const std::array<uint8_t, 4> a = first_texels.texel(x, y), b = second_texels.texel(x, y);
            for (uint32_t channel = 0; channel < 4; ++channel)
                out[channel] = std::byte{(first_channels >> channel & 1) != 0 ? a[channel] : b[channel]};
        }
    return merged;
}

DecodedImage widen(DecodedImage image)
{
    HEARTH_ASSERT(!image.isFloat());
    if (image.type == ChannelType::unorm16)
        return image;
    std::vector<std::byte> wide(2 * image.texels.size());
    for (size_t at = 0; at < image.texels.size(); ++at)
        wide[2 * at] = wide[2 * at + 1] = image.texels[at]; // times 257
    image.texels = std::move(wide);
    image.type = ChannelType::unorm16;
    return image;
}

bool isGrey(const DecodedImage& image)
{
    HEARTH_ASSERT(!image.isFloat());
    for (size_t at = 0; at < countChannels(image); at += 4)
        if (readChannel(image, at) != readChannel(image, at + 1) ||
            readChannel(image, at) != readChannel(image, at + 2))
            return false;
    return true;
}

bool hasAlpha(const DecodedImage& image)
{
    HEARTH_ASSERT(!image.isFloat());
    for (size_t at = 3; at < countChannels(image); at += 4)
        if (readChannel(image, at) != UINT16_MAX)
            return true;
    return false;
}

} // namespace hearth::import

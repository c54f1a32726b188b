// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/images/channels.h"

#include "formats/base/assert.h"
#include "formats/base/half.h"
#include "formats/texels/decoded_texel.h"
#include "pipelines/import/images/resized_image.h"

#include <algorithm>
#include <cmath>
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

/// Set channel `at` to a number of 16 bits, or the bits of a half.
void writeChannel(DecodedImage& image, size_t at, uint16_t channel)
{
    if (image.type == ChannelType::unorm8)
        image.texels[at] = std::byte{formats::narrowUnorm(channel)};
    else
        std::memcpy(image.texels.data() + at * sizeof(channel), &channel, sizeof(channel));
}

/// Return z of the unit vector with x and y, all as normal maps have them.
uint16_t completeNormal(uint16_t x, uint16_t y)
{
    constexpr int64_t kMax = UINT16_MAX;
    const int64_t from_x = 2 * int64_t{x} - kMax, from_y = 2 * int64_t{y} - kMax;
    const int64_t square = std::max<int64_t>(0, kMax * kMax - from_x * from_x - from_y * from_y);
    const double z = std::sqrt(static_cast<double>(square)); // of 0 to kMax
    return static_cast<uint16_t>((static_cast<double>(kMax) + z) / 2 + 0.5);
}

size_t countChannels(const DecodedImage& image)
{
    return image.texels.size() / image.channelBytes();
}

} // namespace

float linearFromSrgb(float encoded)
{
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

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

DecodedImage completeNormals(DecodedImage image)
{
    if (image.isFloat())
        return image;
    for (size_t at = 0; at < countChannels(image); at += 4)
        if (readChannel(image, at + 2) != 0)
            return image;
    for (size_t at = 0; at < countChannels(image); at += 4)
        writeChannel(image, at + 2, completeNormal(readChannel(image, at), readChannel(image, at + 1)));
    return image;
}

void straightenAlpha(DecodedImage& image)
{
    for (size_t at = 0; at < countChannels(image); at += 4)
    {
        const uint16_t alpha = readChannel(image, at + 3);
        if (alpha == 0)
            continue;
        for (size_t c = at; c < at + 3; ++c)
        {
            const uint32_t color = readChannel(image, c);
            const uint16_t straight =
                image.isFloat()
                    ? halfFromFloat(floatFromHalf(static_cast<uint16_t>(color)) / floatFromHalf(alpha))
                    : static_cast<uint16_t>(
                          std::min<uint32_t>((color * UINT16_MAX + alpha / 2u) / alpha, UINT16_MAX));
            writeChannel(image, c, straight);
        }
    }
}

void dropAlpha(DecodedImage& image)
{
    for (size_t at = 3; at < countChannels(image); at += 4)
        writeChannel(image, at, image.isFloat() ? kHalfOne : uint16_t{UINT16_MAX});
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

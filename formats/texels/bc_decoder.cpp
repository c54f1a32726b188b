// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/texels/bc_decoder.h"

#include "formats/texels/bc6h_decoder.h"
#include "formats/texels/bc7_decoder.h"

#include <algorithm>

// BC1 to BC5 are specified as exact fractions, and each device rounds them in its own way.
//   - Colours, and alpha beside them, have 8 bits here: endpoints are widened by repeating their highest
//     bits, as devices do, and interpolated values are rounded to nearest. Devices differ from that by a
//     code or two: lavapipe by up to 1 in colours and 2 in alpha.
//   - BC4 and BC5 have 16 bits, rounded to nearest: Direct3D 11 asks for more than 8. Lavapipe has 8, and
//     is off by up to 1.6 of 255, or 1.8 of 127.

namespace hearth::formats
{

namespace
{

/// Meaning of the colours of a block.
enum class ColorBlock : uint8_t
{
    opaque,      ///< of BC1: four colours, or three and black, by the order of the endpoints
    transparent, ///< the same, but black is transparent
    four_colors, ///< of BC2 and BC3: always four
};

uint64_t readLittleEndian(std::span<const std::byte> bytes)
{
    uint64_t value = 0;
    for (size_t i = 0; i < bytes.size(); ++i)
        value |= std::to_integer<uint64_t>(bytes[i]) << 8 * i;
    return value;
}

/// Widen a colour with 5, 6, 5 bits to 8 bits a channel.
std::array<uint32_t, 3> widen565(uint32_t color)
{
    const uint32_t red = color >> 11, green = color >> 5 & 63u, blue = color & 31u;
    return {red << 3 | red >> 2, green << 2 | green >> 4, blue << 3 | blue >> 2};
}

void decodeColors(std::span<const std::byte, 8> block, ColorBlock kind, std::span<DecodedTexel, 16> texels)
{
    const auto first = static_cast<uint32_t>(readLittleEndian(block.first(2)));
    const auto second = static_cast<uint32_t>(readLittleEndian(block.subspan(2, 2)));
    const uint64_t indices = readLittleEndian(block.subspan(4, 4));
    const std::array<uint32_t, 3> a = widen565(first);
    const std::array<uint32_t, 3> b = widen565(second);
    const bool has_four = kind == ColorBlock::four_colors || first > second;
    std::array<DecodedTexel, 4> palette{};
    for (size_t c = 0; c < 3; ++c)
    {
        const uint32_t third = has_four ? (2 * a[c] + b[c] + 1) / 3 : (a[c] + b[c] + 1) / 2;
        const uint32_t fourth = has_four ? (a[c] + 2 * b[c] + 1) / 3 : 0;
        palette[0][c] = static_cast<uint16_t>(a[c] * 257);
        palette[1][c] = static_cast<uint16_t>(b[c] * 257);
        palette[2][c] = static_cast<uint16_t>(third * 257);
        palette[3][c] = static_cast<uint16_t>(fourth * 257);
    }
    for (DecodedTexel& color : palette)
        color[3] = 0xFFFF;
    if (kind == ColorBlock::transparent && !has_four)
        palette[3][3] = 0;
    for (uint32_t t = 0; t < 16; ++t)
        texels[t] = palette[indices >> 2 * t & 3u];
}

/// Divide, rounded to nearest; halves away from zero.
int32_t divideRounded(int32_t dividend, int32_t divisor)
{
    const int32_t half = dividend < 0 ? -divisor / 2 : divisor / 2;
    return (dividend + half) / divisor;
}

/// Decode a block of one channel, as BC4 has it.
///
/// scale    of the result's 1
/// returns  by texel, -scale or 0 to scale
std::array<int32_t, 16> decodeChannel(std::span<const std::byte, 8> block, bool is_signed, int32_t scale)
{
    // -128 means the same as -127, but in the order of the endpoints it counts as less
    const auto end = [&](size_t i)
    { return is_signed ? std::to_integer<int8_t>(block[i]) : std::to_integer<int32_t>(block[i]); };
    const bool has_eight = end(0) > end(1);
    const int32_t unit = is_signed ? 127 : 255;
    const int32_t a = std::max(end(0), -unit);
    const int32_t b = std::max(end(1), -unit);
    const int32_t steps = has_eight ? 7 : 5;
    std::array<int32_t, 8> palette{};
    palette[0] = divideRounded(a * scale, unit);
    palette[1] = divideRounded(b * scale, unit);
    for (int32_t i = 1; i < steps; ++i)
        palette[static_cast<size_t>(i) + 1] = divideRounded(((steps - i) * a + i * b) * scale, steps * unit);
    if (!has_eight)
    {
        palette[6] = is_signed ? -scale : 0;
        palette[7] = scale;
    }
    const uint64_t indices = readLittleEndian(block.subspan(2, 6));
    std::array<int32_t, 16> values{};
    for (uint32_t t = 0; t < 16; ++t)
        values[t] = palette[indices >> 3 * t & 7u];
    return values;
}

void decodeAlpha(TexelFormat format, std::span<const std::byte, 8> block, std::span<DecodedTexel, 16> texels)
{
    if (format == TexelFormat::bc2_unorm || format == TexelFormat::bc2_srgb)
    {
        const uint64_t alpha = readLittleEndian(block);
        for (uint32_t t = 0; t < 16; ++t)
            texels[t][3] = static_cast<uint16_t>((alpha >> 4 * t & 15u) * 0x1111);
        return;
    }
    const std::array<int32_t, 16> codes = decodeChannel(block, false, 255);
    for (size_t t = 0; t < 16; ++t)
        texels[t][3] = static_cast<uint16_t>(codes[t] * 257);
}

/// Decode BC4 or BC5: a block for each channel.
void decodeChannels(const TexelFormatTraits& traits, std::span<const std::byte> block,
                    std::span<DecodedTexel, 16> texels)
{
    const bool is_signed = traits.coding == TexelCoding::snorm;
    const int32_t scale = is_signed ? 0x7FFF : 0xFFFF;
    std::fill(texels.begin(), texels.end(), DecodedTexel{0, 0, 0, static_cast<uint16_t>(scale)});
    for (size_t c = 0; c < traits.channels; ++c)
    {
        const std::array<int32_t, 16> values =
            decodeChannel(block.subspan(8 * c).first<8>(), is_signed, scale);
        for (size_t t = 0; t < 16; ++t)
            texels[t][c] = static_cast<uint16_t>(values[t]);
    }
}

} // namespace

void decodeBcBlock(const TexelFormatTraits& traits, std::span<const std::byte> block,
                   std::span<DecodedTexel, 16> texels)
{
    switch (traits.format)
    {
    case TexelFormat::bc1_rgb_unorm:
    case TexelFormat::bc1_rgb_srgb:
        return decodeColors(block.first<8>(), ColorBlock::opaque, texels);
    case TexelFormat::bc1_rgba_unorm:
    case TexelFormat::bc1_rgba_srgb:
        return decodeColors(block.first<8>(), ColorBlock::transparent, texels);
    case TexelFormat::bc2_unorm:
    case TexelFormat::bc2_srgb:
    case TexelFormat::bc3_unorm:
    case TexelFormat::bc3_srgb:
        decodeColors(block.subspan<8, 8>(), ColorBlock::four_colors, texels);
        return decodeAlpha(traits.format, block.first<8>(), texels);
    case TexelFormat::bc6h_ufloat:
    case TexelFormat::bc6h_sfloat:
        return decodeBc6hBlock(traits.format == TexelFormat::bc6h_sfloat, block.first<16>(), texels);
    case TexelFormat::bc7_unorm:
    case TexelFormat::bc7_srgb:
        return decodeBc7Block(block.first<16>(), texels);
    default:
        return decodeChannels(traits, block, texels);
    }
}

} // namespace hearth::formats

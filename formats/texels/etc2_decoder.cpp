// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/texels/etc2_decoder.h"

#include "formats/texels/eac_decoder.h"
#include "formats/texels/etc2_tables.h"

#include <algorithm>
#include <array>

namespace hearth::formats
{

namespace
{

/// Red, green, blue in codes of 8 bits; not clamped.
using EtcColor = std::array<int, 3>;

/// Colours that the indices of 2 bits stand for.
using EtcPaints = std::array<EtcColor, 4>;

/// Block of colours: its first byte has bits 56 to 63, as in the tables of the specification.
class EtcBlock
{
public:
    explicit EtcBlock(std::span<const std::byte, 8> bytes)
    {
        for (const std::byte byte : bytes)
            word_ = word_ << 8 | std::to_integer<uint64_t>(byte);
    }

    /// Return `count` bits from bit `low` on.
    int bits(uint32_t low, uint32_t count) const
    {
        return static_cast<int>(word_ >> low & ((uint64_t{1} << count) - 1));
    }

    /// Return the index of a texel. Texels are counted column by column; the two bits lie in two fields.
    uint32_t texelIndex(uint32_t x, uint32_t y) const
    {
        const uint32_t texel = 4 * x + y;
        return static_cast<uint32_t>(word_ >> (16 + texel) & 1) << 1 | (word_ >> texel & 1);
    }

private:
    uint64_t word_ = 0;
};

/// Widen a code of 4 to 7 bits to 8 by repeating its highest bits.
int extendCode(int code, int bits)
{
    return code << (8 - bits) | code >> (2 * bits - 8);
}

EtcColor extendCode(const EtcColor& code, int bits)
{
    return {extendCode(code[0], bits), extendCode(code[1], bits), extendCode(code[2], bits)};
}

EtcColor shiftColor(const EtcColor& color, int distance)
{
    return {color[0] + distance, color[1] + distance, color[2] + distance};
}

void writeEtcColor(const EtcColor& color, DecodedTexel& texel)
{
    for (size_t c = 0; c < 3; ++c)
        texel[c] = static_cast<uint16_t>(std::clamp(color[c], 0, 255) * 257);
    texel[3] = 0xFFFF;
}

/// Index that is transparent in blocks with punched-through texels.
constexpr uint32_t kTransparentIndex = 2;

/// Colours of a half of the block. Where texels may be transparent, the lesser distance is 0.
EtcPaints subBlockPaints(const EtcColor& base, int table, bool is_opaque)
{
    const auto& distances = kEtcDistances[static_cast<size_t>(table)];
    const int lesser = is_opaque ? distances[0] : 0;
    const int greater = distances[1];
    return {shiftColor(base, lesser), shiftColor(base, greater), shiftColor(base, -lesser),
            shiftColor(base, -greater)};
}

/// Decode texels by their indices.
/// halves      paints of the left and right half, or of the top and bottom one if the block is flipped
/// is_flipped  also false for modes whose halves are alike
void decodePaints(const EtcBlock& block, const std::array<EtcPaints, 2>& halves, bool is_flipped,
                  bool is_opaque, std::span<DecodedTexel, 16> texels)
{
    for (uint32_t y = 0; y < 4; ++y)
        for (uint32_t x = 0; x < 4; ++x)
        {
            const uint32_t index = block.texelIndex(x, y);
            if (!is_opaque && index == kTransparentIndex)
                texels[4 * y + x] = {};
            else
                writeEtcColor(halves[(is_flipped ? y : x) / 2][index], texels[4 * y + x]);
        }
}

/// Decode the modes individual and differential from the base colours of their halves.
void decodeSubBlocks(const EtcBlock& block, const std::array<EtcColor, 2>& bases, bool is_opaque,
                     std::span<DecodedTexel, 16> texels)
{
    decodePaints(block,
                 {subBlockPaints(bases[0], block.bits(37, 3), is_opaque),
                  subBlockPaints(bases[1], block.bits(34, 3), is_opaque)},
                 block.bits(32, 1) != 0, is_opaque, texels);
}

/// Mode T: one colour, and three on a line.
EtcPaints paintsT(const EtcBlock& block)
{
    const EtcColor alone =
        extendCode({block.bits(59, 2) << 2 | block.bits(56, 2), block.bits(52, 4), block.bits(48, 4)}, 4);
    const EtcColor middle = extendCode({block.bits(44, 4), block.bits(40, 4), block.bits(36, 4)}, 4);
    const int distance = kEtcPaintDistances[static_cast<size_t>(block.bits(34, 2) << 1 | block.bits(32, 1))];
    return {alone, shiftColor(middle, distance), middle, shiftColor(middle, -distance)};
}

/// Mode H: two colours at equal distance on either side of each of two. The order of those two is a bit.
EtcPaints paintsH(const EtcBlock& block)
{
    const EtcColor first{block.bits(59, 4), block.bits(56, 3) << 1 | block.bits(52, 1),
                         block.bits(51, 1) << 3 | block.bits(47, 3)};
    const EtcColor second{block.bits(43, 4), block.bits(39, 4), block.bits(35, 4)};
    const int order = first >= second ? 1 : 0; // red first, then green, then blue
    const int distance =
        kEtcPaintDistances[static_cast<size_t>(block.bits(34, 1) << 2 | block.bits(32, 1) << 1 | order)];
    const EtcColor a = extendCode(first, 4), b = extendCode(second, 4);
    return {shiftColor(a, distance), shiftColor(a, -distance), shiftColor(b, distance),
            shiftColor(b, -distance)};
}

/// Planar mode: colours at the first texel and, beyond the block's edges, four texels to the right and four
/// below. Red and blue have 6 bits, green 7.
void decodePlanar(const EtcBlock& block, std::span<DecodedTexel, 16> texels)
{
    const auto widen = [](int red, int green, int blue) {
        return EtcColor{extendCode(red, 6), extendCode(green, 7), extendCode(blue, 6)};
    };
    const EtcColor origin = widen(block.bits(57, 6), block.bits(56, 1) << 6 | block.bits(49, 6),
                                  block.bits(48, 1) << 5 | block.bits(43, 2) << 3 | block.bits(39, 3));
    const EtcColor right =
        widen(block.bits(34, 5) << 1 | block.bits(32, 1), block.bits(25, 7), block.bits(19, 6));
    const EtcColor below = widen(block.bits(13, 6), block.bits(6, 7), block.bits(0, 6));
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x)
        {
            EtcColor color;
            for (size_t c = 0; c < 3; ++c)
                color[c] = (x * (right[c] - origin[c]) + y * (below[c] - origin[c]) + 4 * origin[c] + 2) >> 2;
            writeEtcColor(color, texels[static_cast<size_t>(4 * y + x)]);
        }
}

/// Decode colours.
/// is_punched  the format is RGB8A1: it has no individual mode, and the bit that asks for it elsewhere means
///             that no texel is transparent
void decodeColors(std::span<const std::byte, 8> bytes, bool is_punched, std::span<DecodedTexel, 16> texels)
{
    const EtcBlock block(bytes);
    const bool has_bit = block.bits(33, 1) != 0;
    const bool is_opaque = !is_punched || has_bit;
    if (!is_punched && !has_bit)
    {
        const EtcColor first{block.bits(60, 4), block.bits(52, 4), block.bits(44, 4)};
        const EtcColor second{block.bits(56, 4), block.bits(48, 4), block.bits(40, 4)};
        return decodeSubBlocks(block, {extendCode(first, 4), extendCode(second, 4)}, true, texels);
    }
    const EtcColor first{block.bits(59, 5), block.bits(51, 5), block.bits(43, 5)};
    EtcColor second;
    constexpr std::array<uint32_t, 3> kDifferenceBits{56, 48, 40};
    for (size_t c = 0; c < 3; ++c)
    {
        const int difference = block.bits(kDifferenceBits[c], 3);
        second[c] = first[c] + (difference < 4 ? difference : difference - 8);
    }
    // a sum that is no code of 5 bits tells the modes that ETC1 lacks
    const auto isCode = [](int sum) { return sum >= 0 && sum < 32; };
    if (!isCode(second[0]))
    {
        const EtcPaints paints = paintsT(block);
        decodePaints(block, {paints, paints}, false, is_opaque, texels);
    }
    else if (!isCode(second[1]))
    {
        const EtcPaints paints = paintsH(block);
        decodePaints(block, {paints, paints}, false, is_opaque, texels);
    }
    else if (!isCode(second[2]))
        decodePlanar(block, texels);
    else
        decodeSubBlocks(block, {extendCode(first, 5), extendCode(second, 5)}, is_opaque, texels);
}

} // namespace

void decodeEtc2Block(const TexelFormatTraits& traits, std::span<const std::byte> block,
                     std::span<DecodedTexel, 16> texels)
{
    const std::span<const std::byte, 8> first = block.first<8>();
    const auto setChannel = [&](size_t channel, const EacValues& values, auto&& code)
    {
        for (size_t t = 0; t < texels.size(); ++t)
            texels[t][channel] = code(values[t]);
    };
    switch (traits.format)
    {
    case TexelFormat::etc2_rgb8a1_unorm:
    case TexelFormat::etc2_rgb8a1_srgb:
        return decodeColors(first, true, texels);
    case TexelFormat::etc2_rgba8_unorm:
    case TexelFormat::etc2_rgba8_srgb:
        decodeColors(block.subspan<8, 8>(), false, texels);
        return setChannel(3, decodeEacAlpha(first),
                          [](int value) { return static_cast<uint16_t>(value * 257); });
    case TexelFormat::eac_r11_unorm:
    case TexelFormat::eac_rg11_unorm:
        std::fill(texels.begin(), texels.end(), DecodedTexel{0, 0, 0, 0xFFFF});
        setChannel(0, decodeEacUnsigned(first), eacUnorm);
        if (traits.channels == 2)
            setChannel(1, decodeEacUnsigned(block.subspan<8, 8>()), eacUnorm);
        return;
    case TexelFormat::eac_r11_snorm:
    case TexelFormat::eac_rg11_snorm:
        std::fill(texels.begin(), texels.end(), DecodedTexel{0, 0, 0, 0x7FFF});
        setChannel(0, decodeEacSigned(first), eacSnorm);
        if (traits.channels == 2)
            setChannel(1, decodeEacSigned(block.subspan<8, 8>()), eacSnorm);
        return;
    default:
        return decodeColors(first, false, texels);
    }
}

} // namespace hearth::formats

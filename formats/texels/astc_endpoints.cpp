// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/texels/astc_endpoints.h"

#include "formats/texels/astc_integers.h"

#include <algorithm>
#include <utility>

namespace hearth::formats
{

namespace
{

using EndpointColour = std::array<int32_t, 4>;

constexpr int32_t kHdrMax = 0xFFF;
constexpr int32_t kHdrOne = 0x780;

/// Rule for a range with digits: C of the specification, and its B as a sum of the bits above the lowest
/// times `repeat` and the same bits shifted down.
struct Unquantization
{
    uint32_t digit_base, bits, c, repeat, down;
};

constexpr Unquantization kUnquantizations[] = {
    {3, 1, 204, 0, 8},          {5, 1, 113, 0, 8},          {3, 2, 93, 0b100010110, 8},
    {5, 2, 54, 0b100001100, 8}, {3, 3, 44, 0b010000101, 8}, {5, 3, 26, 0b010000010, 1},
    {3, 4, 22, 0b001000001, 8}, {5, 4, 13, 0b001000000, 1}, {3, 5, 11, 0b000100000, 2},
    {5, 5, 6, 0b000100000, 3},  {3, 6, 5, 0b000010000, 4},
};

constexpr uint8_t unquantizeColour(const AstcRange& range, uint32_t stored)
{
    if (range.digit_base == 1) // repeat the bits from the highest on
    {
        uint32_t value = 0;
        for (int shift = 8 - range.bits; shift > -range.bits; shift -= range.bits)
            value |= shift >= 0 ? stored << shift : stored >> -shift;
        return static_cast<uint8_t>(value);
    }
    const uint32_t digit = stored >> range.bits, upper = (stored & ((1u << range.bits) - 1)) >> 1;
    const uint32_t a = (stored & 1) != 0 ? 0x1FF : 0;
    uint32_t sum = 0;
    for (const Unquantization& rule : kUnquantizations)
        if (rule.digit_base == range.digit_base && rule.bits == range.bits)
            sum = digit * rule.c + upper * rule.repeat + (upper >> rule.down);
    return static_cast<uint8_t>((a & 0x80) | (sum ^ a) >> 2);
}

/// [range - kMinAstcColourRange][stored value]
constexpr auto kColours = []
{
    std::array<std::array<uint8_t, 256>, kAstcRangeCount - kMinAstcColourRange> table{};
    for (size_t i = 0; i < table.size(); ++i)
    {
        const AstcRange& range = kAstcRanges[kMinAstcColourRange + i];
        for (uint32_t stored = 0; stored < uint32_t{range.digit_base} << range.bits; ++stored)
            table[i][stored] = unquantizeColour(range, stored);
    }
    return table;
}();

/// Move the highest bit of `offset` to `base`; what is left is a signed number from -32 to 31.
void transferBit(int32_t& offset, int32_t& base)
{
    base = base >> 1 | (offset & 0x80);
    offset = offset >> 1 & 0x3F;
    if ((offset & 0x20) != 0)
        offset -= 0x40;
}

/// Return a colour near grey: its red and green are stored as twice their distance from blue.
EndpointColour contractBlue(const EndpointColour& colour)
{
    return {(colour[0] + colour[2]) >> 1, (colour[1] + colour[2]) >> 1, colour[2], colour[3]};
}

EndpointColour clampColour(EndpointColour colour, int32_t max)
{
    for (int32_t& channel : colour)
        channel = std::clamp(channel, 0, max);
    return colour;
}

AstcEndpoints makeLdr(const EndpointColour& low, const EndpointColour& high)
{
    return {clampColour(low, 255), clampColour(high, 255), false, false};
}

AstcEndpoints makeHdr(const EndpointColour& low, const EndpointColour& high)
{
    return {clampColour(low, kHdrMax), clampColour(high, kHdrMax), true, true};
}

/// Modes 8 and 12. The order of the sums tells whether the colours are near grey.
AstcEndpoints decodeDirect(const EndpointColour& first, const EndpointColour& second)
{
    if (second[0] + second[1] + second[2] >= first[0] + first[1] + first[2])
        return makeLdr(first, second);
    return makeLdr(contractBlue(second), contractBlue(first));
}

/// Modes 9 and 13. The sign of the offset tells whether the colours are near grey.
AstcEndpoints decodeOffset(EndpointColour base, EndpointColour offset, bool has_alpha)
{
    for (size_t c = 0; c < (has_alpha ? 4u : 3u); ++c)
        transferBit(offset[c], base[c]);
    EndpointColour sum;
    for (size_t c = 0; c < 4; ++c)
        sum[c] = base[c] + offset[c];
    if (offset[0] + offset[1] + offset[2] >= 0)
        return makeLdr(base, sum);
    return makeLdr(contractBlue(sum), contractBlue(base));
}

AstcEndpoints decodeLuminanceOffset(int32_t v0, int32_t v1)
{
    const int32_t low = v0 >> 2 | (v1 & 0xC0), high = low + (v1 & 0x3F);
    return makeLdr({low, low, low, 255}, {high, high, high, 255});
}

AstcEndpoints decodeLuminanceAlphaOffset(std::array<int32_t, 4> v)
{
    transferBit(v[1], v[0]);
    transferBit(v[3], v[2]);
    const int32_t high = v[0] + v[1];
    return makeLdr({v[0], v[0], v[0], v[2]}, {high, high, high, v[2] + v[3]});
}

AstcEndpoints decodeScale(const EndpointColour& rgb, int32_t scale, int32_t low_alpha, int32_t high_alpha)
{
    return makeLdr({rgb[0] * scale >> 8, rgb[1] * scale >> 8, rgb[2] * scale >> 8, low_alpha},
                   {rgb[0], rgb[1], rgb[2], high_alpha});
}

AstcEndpoints decodeHdrLuminance(int32_t low, int32_t high)
{
    return makeHdr({low, low, low, kHdrOne}, {high, high, high, kHdrOne});
}

/// Mode 3: a luminance and a small offset; the highest bit of v0 tells their sizes.
AstcEndpoints decodeHdrLuminanceOffset(int32_t v0, int32_t v1)
{
    const bool coarse = (v0 & 0x80) != 0;
    const int32_t mask = coarse ? 0x1F : 0x0F, shift = coarse ? 2 : 1;
    const int32_t low = (v1 & ~mask & 0xFF) << 4 | (v0 & 0x7F) << shift;
    return decodeHdrLuminance(low, low + ((v1 & mask) << shift));
}

/// Bit of a field that an extra bit of an HDR mode belongs to.
struct ExtraBit
{
    uint8_t field, bit;
};

/// Put bits from different places into the fields that a mode names.
template <size_t Fields, size_t Count>
void putExtraBits(const std::array<ExtraBit, Count>& places, const std::array<int32_t, Count>& bits,
                  std::array<int32_t, Fields>& fields)
{
    for (size_t i = 0; i < Count; ++i)
        fields[places[i].field] |= (bits[i] & 1) << places[i].bit;
}

/// Swap the colour that is stored first, the largest, into its place.
void swapMajor(uint32_t major, EndpointColour& colour)
{
    std::swap(colour[0], colour[major]);
}

/// Mode 7: a colour and a number that is subtracted from each of its channels.
AstcEndpoints decodeHdrScale(const std::array<int32_t, 4>& v)
{
    enum : uint8_t
    {
        R,
        G,
        B,
        S
    };
    constexpr std::array<std::array<ExtraBit, 7>, 6> kPlaces = {{
        {{{R, 9}, {R, 8}, {R, 7}, {R, 10}, {R, 6}, {S, 6}, {S, 5}}},
        {{{R, 8}, {G, 5}, {R, 7}, {B, 5}, {R, 6}, {R, 10}, {R, 9}}},
        {{{R, 9}, {R, 8}, {R, 7}, {R, 6}, {S, 7}, {S, 6}, {S, 5}}},
        {{{R, 8}, {G, 5}, {R, 7}, {B, 5}, {R, 6}, {S, 6}, {S, 5}}},
        {{{G, 6}, {G, 5}, {B, 6}, {B, 5}, {R, 6}, {R, 7}, {S, 5}}},
        {{{G, 6}, {G, 5}, {B, 6}, {B, 5}, {R, 6}, {S, 6}, {S, 5}}},
    }};
    constexpr std::array<int32_t, 6> kShifts = {1, 1, 2, 3, 4, 5};

    const auto code = static_cast<uint32_t>((v[0] & 0xC0) >> 6 | (v[1] & 0x80) >> 5 | (v[2] & 0x80) >> 4);
    uint32_t major = code >> 2, mode = code & 3;
    if (code == 15)
    {
        major = 0;
        mode = 5;
    }
    else if (code >= 12)
    {
        major = code & 3;
        mode = 4;
    }
    std::array<int32_t, 4> fields = {v[0] & 0x3F, v[1] & 0x1F, v[2] & 0x1F, v[3] & 0x1F};
    putExtraBits(kPlaces[mode], {v[1] >> 6, v[1] >> 5, v[2] >> 6, v[2] >> 5, v[3] >> 7, v[3] >> 6, v[3] >> 5},
                 fields);
    for (int32_t& field : fields)
        field <<= kShifts[mode];

    EndpointColour high = {fields[R], fields[G], fields[B], kHdrOne};
    if (mode != 5)
    {
        high[1] = high[0] - high[1];
        high[2] = high[0] - high[2];
    }
    swapMajor(major, high);
    const int32_t scale = fields[S];
    return makeHdr({high[0] - scale, high[1] - scale, high[2] - scale, kHdrOne}, high);
}

int32_t extendDifference(int32_t value, int32_t bits)
{
    const int32_t sign = 1 << (bits - 1);
    return ((value & (2 * sign - 1)) ^ sign) - sign;
}

/// Mode 11, and the colours of modes 14 and 15: the largest channel, and differences from it.
AstcEndpoints decodeHdrDirect(std::span<const int32_t, 6> v)
{
    enum : uint8_t
    {
        A,
        B0,
        B1,
        C,
        D0,
        D1
    };
    constexpr std::array<std::array<ExtraBit, 6>, 8> kPlaces = {{
        {{{B0, 6}, {B1, 6}, {D0, 6}, {D1, 6}, {D0, 5}, {D1, 5}}},
        {{{B0, 6}, {B1, 6}, {B0, 7}, {B1, 7}, {D0, 5}, {D1, 5}}},
        {{{A, 9}, {C, 6}, {D0, 6}, {D1, 6}, {D0, 5}, {D1, 5}}},
        {{{B0, 6}, {B1, 6}, {A, 9}, {C, 6}, {D0, 5}, {D1, 5}}},
        {{{B0, 6}, {B1, 6}, {B0, 7}, {B1, 7}, {A, 9}, {A, 10}}},
        {{{A, 9}, {A, 10}, {C, 7}, {C, 6}, {D0, 5}, {D1, 5}}},
        {{{B0, 6}, {B1, 6}, {A, 11}, {C, 6}, {A, 9}, {A, 10}}},
        {{{A, 9}, {A, 10}, {A, 11}, {C, 6}, {D0, 5}, {D1, 5}}},
    }};
    constexpr std::array<int32_t, 8> kDifferenceBits = {7, 6, 7, 6, 5, 6, 5, 6};

    const auto major = static_cast<uint32_t>((v[4] & 0x80) >> 7 | (v[5] & 0x80) >> 6);
    if (major == 3)
        return makeHdr({v[0] << 4, v[2] << 4, (v[4] & 0x7F) << 5, kHdrOne},
                       {v[1] << 4, v[3] << 4, (v[5] & 0x7F) << 5, kHdrOne});
    const auto mode = static_cast<uint32_t>((v[1] & 0x80) >> 7 | (v[2] & 0x80) >> 6 | (v[3] & 0x80) >> 5);
    std::array<int32_t, 6> fields = {
        v[0] | (v[1] & 0x40) << 2, v[2] & 0x3F, v[3] & 0x3F, v[1] & 0x3F, v[4] & 0x1F, v[5] & 0x1F};
    putExtraBits(kPlaces[mode], {v[2] >> 6, v[3] >> 6, v[4] >> 6, v[5] >> 6, v[4] >> 5, v[5] >> 5}, fields);
    fields[D0] = extendDifference(fields[D0], kDifferenceBits[mode]);
    fields[D1] = extendDifference(fields[D1], kDifferenceBits[mode]);
    for (int32_t& field : fields)
        field *= 1 << ((mode >> 1) ^ 3);

    const int32_t a = fields[A], b0 = fields[B0], b1 = fields[B1], c = fields[C];
    EndpointColour high = {a, a - b0, a - b1, kHdrOne};
    EndpointColour low = {a - c, a - b0 - c - fields[D0], a - b1 - c - fields[D1], kHdrOne};
    swapMajor(major, high);
    swapMajor(major, low);
    return makeHdr(low, high);
}

/// Mode 15: an alpha and a difference; the highest bits of the values tell their sizes.
void decodeHdrAlpha(int32_t v6, int32_t v7, AstcEndpoints& endpoints)
{
    const int32_t mode = (v6 >> 7 & 1) | (v7 >> 6 & 2);
    int32_t low = v6 & 0x7F, high = v7 & 0x7F;
    if (mode == 3)
    {
        low <<= 5;
        high <<= 5;
    }
    else
    {
        low = (low | (high << (mode + 1) & 0x780)) << (4 - mode);
        high = low + extendDifference(high, 6 - mode) * (1 << (4 - mode));
    }
    endpoints.low[3] = std::clamp(low, 0, kHdrMax);
    endpoints.high[3] = std::clamp(high, 0, kHdrMax);
}

AstcEndpoints decodeHdr(uint32_t mode, const std::array<int32_t, 8>& v)
{
    switch (mode)
    {
    case 2: // large range
        if (v[1] >= v[0])
            return decodeHdrLuminance(v[0] << 4, v[1] << 4);
        return decodeHdrLuminance((v[1] << 4) + 8, (v[0] << 4) - 8);
    case 3:
        return decodeHdrLuminanceOffset(v[0], v[1]);
    case 7:
        return decodeHdrScale({v[0], v[1], v[2], v[3]});
    default:
        break;
    }
    AstcEndpoints endpoints = decodeHdrDirect(std::span(v).first<6>());
    if (mode == 14)
    {
        endpoints.low[3] = v[6];
        endpoints.high[3] = v[7];
        endpoints.hdr_alpha = false;
    }
    else if (mode == 15)
        decodeHdrAlpha(v[6], v[7], endpoints);
    return endpoints;
}

} // namespace

uint8_t unquantizeAstcColour(size_t range, uint8_t stored)
{
    return kColours[range - kMinAstcColourRange][stored];
}

AstcEndpoints decodeAstcEndpoints(uint32_t mode, std::span<const uint8_t> values)
{
    std::array<int32_t, 8> v{};
    std::copy(values.begin(), values.end(), v.begin());
    if (isAstcModeHdr(mode))
        return decodeHdr(mode, v);
    switch (mode)
    {
    case 0:
        return makeLdr({v[0], v[0], v[0], 255}, {v[1], v[1], v[1], 255});
    case 1:
        return decodeLuminanceOffset(v[0], v[1]);
    case 4:
        return makeLdr({v[0], v[0], v[0], v[2]}, {v[1], v[1], v[1], v[3]});
    case 5:
        return decodeLuminanceAlphaOffset({v[0], v[1], v[2], v[3]});
    case 6:
        return decodeScale({v[0], v[1], v[2], 0}, v[3], 255, 255);
    case 8:
        return decodeDirect({v[0], v[2], v[4], 255}, {v[1], v[3], v[5], 255});
    case 9:
        return decodeOffset({v[0], v[2], v[4], 255}, {v[1], v[3], v[5], 0}, false);
    case 10:
        return decodeScale({v[0], v[1], v[2], 0}, v[3], v[4], v[5]);
    case 12:
        return decodeDirect({v[0], v[2], v[4], v[6]}, {v[1], v[3], v[5], v[7]});
    default:
        return decodeOffset({v[0], v[2], v[4], v[6]}, {v[1], v[3], v[5], v[7]}, true);
    }
}

} // namespace hearth::formats

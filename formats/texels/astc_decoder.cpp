// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/texels/astc_decoder.h"

#include "formats/texels/astc_endpoints.h"
#include "formats/texels/astc_integers.h"
#include "formats/texels/astc_partitions.h"
#include "formats/texels/astc_weights.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace hearth::formats
{

namespace
{

constexpr uint16_t kAstcHalfOne = 0x3C00, kAstcHalfMax = 0x7BFF, kAstcHalfNan = 0xFFFF;

constexpr uint32_t kMaxAstcPartitions = 4;

/// Fields of a block, besides its weights.
struct BlockLayout
{
    AstcGrid grid;
    uint32_t partitions;
    uint32_t pattern;
    std::array<uint32_t, kMaxAstcPartitions> modes; ///< of endpoints
    uint32_t second_plane;                          ///< channel that has the second plane's weights
    size_t endpoint_bit;                            ///< first bit of the endpoints
    size_t endpoint_bits;                           ///< that are free for them
    size_t endpoint_values;
};

/// [pairs of endpoint values][free bits]: the widest range that fits; 0 where none does.
constexpr auto kColourRanges = []
{
    std::array<std::array<uint8_t, 128>, kMaxAstcEndpointValues / 2 + 1> table{};
    for (size_t pairs = 1; pairs < table.size(); ++pairs)
        for (size_t range = kMinAstcColourRange; range < kAstcRangeCount; ++range)
            for (size_t bits = sequenceBits(kAstcRanges[range], 2 * pairs); bits < 128; ++bits)
                table[pairs][bits] = static_cast<uint8_t>(range);
    return table;
}();

void fillErrorColour(TexelCoding coding, std::span<DecodedTexel> texels)
{
    const DecodedTexel magenta = {0xFFFF, 0, 0xFFFF, 0xFFFF};
    const DecodedTexel nan = {kAstcHalfNan, kAstcHalfNan, kAstcHalfNan, kAstcHalfNan};
    std::fill(texels.begin(), texels.end(), coding == TexelCoding::float_value ? nan : magenta);
}

/// Return the half float of a value from 0 to 65535, of which only the last is 1: rounded towards zero.
uint16_t halfFromUnorm(uint32_t value)
{
    if (value == 0xFFFF)
        return kAstcHalfOne;
    if (value < 4) // below 2^-14
        return static_cast<uint16_t>(value << 8);
    const auto exponent = static_cast<uint32_t>(std::bit_width(value)) - 1;
    return static_cast<uint16_t>((exponent - 1) << 10 | ((value << 10 >> exponent) & 0x3FF));
}

/// Return the half float of an HDR value by its logarithm: 5 bits of exponent and 11 of a piecewise linear
/// mantissa.
uint16_t halfFromLogarithm(uint32_t value)
{
    const uint32_t exponent = value >> 11, low = value & 0x7FF;
    const uint32_t mantissa = low < 512 ? 3 * low : low < 1536 ? 4 * low - 512 : 5 * low - 2048;
    return static_cast<uint16_t>(std::min<uint32_t>(exponent << 10 | mantissa >> 3, kAstcHalfMax));
}

/// Return the channel of a format of an LDR value of 16 bits.
uint16_t finishLdr(TexelCoding coding, uint32_t value)
{
    if (coding == TexelCoding::float_value)
        return halfFromUnorm(value);
    return static_cast<uint16_t>(coding == TexelCoding::srgb ? (value >> 8) * 257 : value);
}

/// Decode a block of one colour. Source: section "Void-Extent Blocks".
void decodeVoidExtent(TexelCoding coding, const AstcBits& bits, std::span<DecodedTexel> texels)
{
    const bool hdr = bits.get(9, 1) != 0;
    const uint32_t min_s = bits.get32(12, 13), max_s = bits.get32(25, 13);
    const uint32_t min_t = bits.get32(38, 13), max_t = bits.get32(51, 13);
    const bool no_extent = (min_s & max_s & min_t & max_t) == 0x1FFF;
    if (bits.get(10, 2) != 3 || (!no_extent && (min_s >= max_s || min_t >= max_t)) ||
        (hdr && coding != TexelCoding::float_value))
        return fillErrorColour(coding, texels);
    DecodedTexel texel;
    for (size_t c = 0; c < 4; ++c)
    {
        const uint32_t value = bits.get32(64 + 16 * c, 16);
        texel[c] = hdr ? static_cast<uint16_t>(value) : finishLdr(coding, value);
    }
    std::fill(texels.begin(), texels.end(), texel);
}

/// Read the modes of the endpoints of several partitions. Returns the bits below the weights that they take.
size_t readEndpointModes(const AstcBits& bits, BlockLayout& layout)
{
    const uint32_t selector = bits.get32(23, 2);
    if (selector == 0)
    {
        layout.modes.fill(bits.get32(25, 4));
        return 0;
    }
    const size_t extra = 3 * size_t{layout.partitions} - 4;
    const uint32_t code = bits.get32(25, 4) | bits.get32(128 - layout.grid.bits - extra, extra)
                                                  << 4; // class bits, then modes
    for (uint32_t i = 0; i < layout.partitions; ++i)
    {
        const uint32_t mode_class = selector - 1 + (code >> i & 1);
        layout.modes[i] = mode_class * 4 + (code >> (layout.partitions + 2 * i) & 3);
    }
    return extra;
}

/// Read the fields of a block that is no void extent. Nothing if it is illegal.
std::optional<BlockLayout> readLayout(const AstcBits& bits, const TexelFormatTraits& traits)
{
    const std::optional<AstcGrid> grid =
        readAstcGrid(bits.get32(0, 11), traits.block_width, traits.block_height);
    if (!grid)
        return std::nullopt;
    BlockLayout layout{};
    layout.grid = *grid;
    layout.partitions = 1 + bits.get32(11, 2);
    const bool two_planes = grid->planes == 2;
    if (two_planes && layout.partitions == kMaxAstcPartitions)
        return std::nullopt;

    size_t below_weights = grid->bits;
    if (layout.partitions == 1)
    {
        layout.modes[0] = bits.get32(13, 4);
        layout.endpoint_bit = 17;
    }
    else
    {
        layout.pattern = bits.get32(13, 10);
        layout.endpoint_bit = 29;
        below_weights += readEndpointModes(bits, layout);
    }
    if (two_planes)
    {
        below_weights += 2;
        layout.second_plane = bits.get32(128 - below_weights, 2);
    }

    for (uint32_t i = 0; i < layout.partitions; ++i)
        layout.endpoint_values += astcEndpointValues(layout.modes[i]);
    if (layout.endpoint_values > kMaxAstcEndpointValues || layout.endpoint_bit + below_weights > 128)
        return std::nullopt;
    layout.endpoint_bits = 128 - layout.endpoint_bit - below_weights;
    return layout;
}

/// Endpoints with channels of 16 bits, and whether these are logarithms.
struct WideEndpoints
{
    std::array<uint32_t, 4> low, high;
    std::array<bool, 4> hdr;
};

WideEndpoints widenEndpoints(const AstcEndpoints& endpoints, TexelCoding coding)
{
    WideEndpoints wide;
    for (size_t c = 0; c < 4; ++c)
    {
        wide.hdr[c] = c < 3 ? endpoints.hdr_rgb : endpoints.hdr_alpha;
        const auto low = static_cast<uint32_t>(endpoints.low[c]),
                   high = static_cast<uint32_t>(endpoints.high[c]);
        const bool hdr = wide.hdr[c], srgb = coding == TexelCoding::srgb;
        wide.low[c] = hdr ? low << 4 : low << 8 | (srgb ? 0x80 : low);
        wide.high[c] = hdr ? high << 4 : high << 8 | (srgb ? 0x80 : high);
    }
    return wide;
}

/// Decode the endpoints of all partitions. HDR endpoints in an LDR format are magenta: the other partitions
/// of their block are as usual. Returns false if too few bits are free for them.
bool decodeEndpoints(const AstcBits& bits, const BlockLayout& layout, TexelCoding coding,
                     std::array<WideEndpoints, kMaxAstcPartitions>& endpoints)
{
    const size_t range = kColourRanges[layout.endpoint_values / 2][layout.endpoint_bits];
    if (range == 0)
        return false;
    std::array<uint8_t, kMaxAstcEndpointValues> stored;
    const std::span values = std::span(stored).first(layout.endpoint_values);
    decodeSequence(bits.cut(layout.endpoint_bit, sequenceBits(kAstcRanges[range], layout.endpoint_values)),
                   kAstcRanges[range], values);
    for (uint8_t& value : values)
        value = unquantizeAstcColour(range, value);
    size_t first = 0;
    for (uint32_t i = 0; i < layout.partitions; ++i)
    {
        const uint32_t mode = layout.modes[i];
        AstcEndpoints pair = decodeAstcEndpoints(mode, values.subspan(first, astcEndpointValues(mode)));
        if (isAstcModeHdr(mode) && coding != TexelCoding::float_value)
            pair = {{255, 0, 255, 255}, {255, 0, 255, 255}, false, false};
        endpoints[i] = widenEndpoints(pair, coding);
        first += astcEndpointValues(mode);
    }
    return true;
}

} // namespace

void decodeAstcBlock(const TexelFormatTraits& traits, std::span<const std::byte, 16> block,
                     std::span<DecodedTexel> texels)
{
    AstcBits bits;
    static_assert(std::endian::native == std::endian::little);
    std::memcpy(&bits, block.data(), sizeof(bits));
    if (bits.get(0, 9) == 0b111111100)
        return decodeVoidExtent(traits.coding, bits, texels);
    const std::optional<BlockLayout> layout = readLayout(bits, traits);
    std::array<WideEndpoints, kMaxAstcPartitions> endpoints;
    if (!layout || !decodeEndpoints(bits, *layout, traits.coding, endpoints))
        return fillErrorColour(traits.coding, texels);

    std::array<std::array<uint8_t, kMaxAstcBlockTexels>, 2> weights;
    decodeAstcWeights(bits, layout->grid, traits.block_width, traits.block_height, weights);
    std::array<uint8_t, kMaxAstcBlockTexels> partitions{};
    if (layout->partitions > 1)
        writeAstcPartitions(layout->pattern, layout->partitions, traits.block_width, traits.block_height,
                            partitions);
    std::array<size_t, 4> planes{};
    if (layout->grid.planes == 2)
        planes[layout->second_plane] = 1;

    for (size_t i = 0; i < texels.size(); ++i)
    {
        const WideEndpoints& pair = endpoints[partitions[i]];
        for (size_t c = 0; c < 4; ++c)
        {
            const uint32_t weight = weights[planes[c]][i];
            const uint32_t value = (pair.low[c] * (64 - weight) + pair.high[c] * weight + 32) >> 6;
            texels[i][c] = pair.hdr[c] ? halfFromLogarithm(value) : finishLdr(traits.coding, value);
        }
    }
}

} // namespace hearth::formats

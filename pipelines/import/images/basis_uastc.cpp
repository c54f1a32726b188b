// Decodes UASTC. A block is one of 19 modes of ASTC block in a simpler encoding: a prefix code for the mode,
// hints for other formats (skipped), a pattern number, endpoints, weights.
// Source: Binomial LLC, "UASTC LDR 4x4 Texture Specification"; Khronos Data Format Specification 1.3, "ASTC
// Compressed Texture Image Formats" (integer sequences, unquantisation, partitions, interpolation).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/images/basis_uastc.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>

namespace hearth::import
{

namespace
{

/// Encoding of the bits of an endpoint value: plain bits, and a trit or quint above them.
struct ValueRange
{
    uint8_t bits;
    uint8_t base; ///< 1, 3 (trit) or 5 (quint)
};

struct UastcMode
{
    uint8_t code; ///< least significant bit first
    uint8_t code_bits;
    uint8_t hint_bits;
    uint8_t pattern_bits;
    uint8_t subsets;
    uint8_t planes;     ///< 2: one channel has weights of its own
    uint8_t plane_bits; ///< bits that select this channel; 0: the channel is alpha
    uint8_t components; ///< 2 grey and alpha, 3 RGB, 4 RGBA
    ValueRange endpoints;
    uint8_t weight_bits;
};

constexpr uint32_t kSolidMode = 8;
constexpr std::array kModes = {
    UastcMode{0x01, 4, 15, 0, 1, 1, 0, 3, {6, 3}, 4}, UastcMode{0x35, 6, 15, 0, 1, 1, 0, 3, {8, 1}, 2},
    UastcMode{0x1D, 5, 15, 5, 2, 1, 0, 3, {4, 1}, 3}, UastcMode{0x03, 5, 15, 4, 3, 1, 0, 3, {2, 3}, 2},
    UastcMode{0x13, 5, 15, 5, 2, 1, 0, 3, {3, 5}, 2}, UastcMode{0x0B, 5, 15, 0, 1, 1, 0, 3, {8, 1}, 3},
    UastcMode{0x1B, 5, 15, 0, 1, 2, 2, 3, {5, 5}, 2}, UastcMode{0x07, 5, 15, 5, 2, 1, 0, 3, {3, 5}, 2},
    UastcMode{0x17, 5, 0, 0, 1, 1, 0, 4, {8, 1}, 0},  UastcMode{0x0F, 5, 23, 5, 2, 1, 0, 4, {4, 1}, 2},
    UastcMode{0x02, 3, 17, 0, 1, 1, 0, 4, {4, 3}, 4}, UastcMode{0x00, 2, 17, 0, 1, 2, 2, 4, {4, 3}, 2},
    UastcMode{0x06, 3, 17, 0, 1, 1, 0, 4, {6, 3}, 3}, UastcMode{0x1F, 5, 23, 0, 1, 2, 2, 4, {8, 1}, 1},
    UastcMode{0x0D, 5, 23, 0, 1, 1, 0, 4, {8, 1}, 2}, UastcMode{0x05, 7, 23, 0, 1, 1, 0, 2, {8, 1}, 4},
    UastcMode{0x15, 6, 23, 5, 2, 1, 0, 2, {8, 1}, 2}, UastcMode{0x25, 6, 23, 0, 1, 2, 0, 2, {8, 1}, 2},
    UastcMode{0x09, 4, 15, 0, 1, 1, 0, 3, {5, 1}, 5},
};

// ASTC seeds of the patterns that BC7 also has; UASTC's pattern numbers index these.
constexpr std::array<uint16_t, 30> kSeeds2 = {28,  20,  16,  29,  91,  9,   107, 72,  149, 204,
                                              50,  114, 496, 17,  78,  39,  252, 828, 43,  156,
                                              116, 210, 476, 273, 684, 359, 246, 195, 694, 524};
constexpr std::array<uint16_t, 11> kSeeds3 = {260, 74, 32, 156, 183, 15, 745, 0, 335, 902, 254};
/// Seeds of mode 7: BC7 patterns of three subsets that ASTC patterns of two subsets can represent.
constexpr std::array<uint16_t, 19> kMode7Seeds = {36,  48,  61,  137, 161, 183, 226, 281, 302, 307,
                                                  479, 495, 593, 594, 605, 799, 812, 988, 993};

class BlockBits
{
public:
    explicit BlockBits(const std::byte* block) { std::memcpy(words_.data(), block, sizeof(words_)); }

    uint32_t take(uint32_t count)
    {
        uint32_t value = 0;
        for (uint32_t i = 0; i < count; ++i, ++at_)
            value |= static_cast<uint32_t>(words_[at_ / 64] >> (at_ % 64) & 1u) << i;
        return value;
    }

    /// Return the first 7 bits of the block without consuming them.
    uint32_t peek7() const { return static_cast<uint32_t>(words_[0] & 127u); }

private:
    std::array<uint64_t, 2> words_{};
    uint32_t at_ = 0;
};

/// Read the endpoint values of a block: first the trits or quints, packed in fives or threes, then all plain
/// bits. The last pack is as short as its values allow.
void readValues(BlockBits& bits, ValueRange range, std::span<uint32_t> values)
{
    const size_t per_pack = range.base == 3 ? 5 : 3;
    constexpr std::array<uint32_t, 6> kTritBits = {0, 2, 4, 5, 7, 8};
    constexpr std::array<uint32_t, 4> kQuintBits = {0, 3, 5, 7};
    for (size_t at = 0; range.base > 1 && at < values.size(); at += per_pack)
    {
        const size_t count = std::min(per_pack, values.size() - at);
        uint32_t pack = bits.take(range.base == 3 ? kTritBits[count] : kQuintBits[count]);
        for (size_t i = 0; i < count; ++i, pack /= range.base)
            values[at + i] = (pack % range.base) << range.bits;
    }
    for (uint32_t& value : values)
        value |= bits.take(range.bits);
}

/// Apply ASTC's unquantisation of endpoints to 0..255.
uint32_t unquantizeEndpoint(uint32_t value, ValueRange range)
{
    const uint32_t low = value & ((1u << range.bits) - 1u);
    if (range.base == 1)
        return range.bits == 8 ? low : range.bits == 5 ? low << 3 | low >> 2 : low << 4 | low;
    const uint32_t digit = value >> range.bits;
    const uint32_t a = (low & 1u) != 0 ? 0x1FFu : 0u;
    const auto bit = [&](uint32_t i) { return (low >> i) & 1u; };
    uint32_t b = 0;
    uint32_t c = 0;
    if (range.base == 3 && range.bits == 2) // b000b0bb0
    {
        b = bit(1) * 0x116u;
        c = 93;
    }
    else if (range.base == 3 && range.bits == 4) // dcb000dcb
    {
        b = low >> 1 | low >> 1 << 6;
        c = 22;
    }
    else if (range.base == 3) // 6 bits: fedcb000f
    {
        b = low >> 1 << 4 | bit(5);
        c = 5;
    }
    else if (range.bits == 3) // quint: cb0000cbc
    {
        b = low >> 1 << 7 | low >> 1 << 1 | bit(2);
        c = 26;
    }
    else // quint and 5 bits: edcb0000e
    {
        b = low >> 1 << 5 | bit(4);
        c = 6;
    }
    const uint32_t t = (digit * c + b) ^ a;
    return (a & 0x80u) | t >> 2;
}

/// Unquantise a weight of 1 to 5 bits to 0..64.
uint32_t unquantizeWeight(uint32_t weight, uint32_t bits)
{
    uint32_t wide = 0; // repeated to six bits
    for (int shift = 6 - static_cast<int>(bits); shift > -static_cast<int>(bits);
         shift -= static_cast<int>(bits))
        wide |= shift >= 0 ? weight << shift : weight >> -shift;
    return wide > 32 ? wide + 1 : wide;
}

using Texel = std::array<uint8_t, 4>;
using Block = std::array<Texel, 16>;

/// Endpoints as RGBA, indexed [subset][endpoint].
using Endpoints = std::array<std::array<std::array<uint32_t, 4>, 2>, 3>;

Endpoints readEndpoints(BlockBits& bits, const UastcMode& mode)
{
    std::array<uint32_t, 18> values{};
    const size_t count = size_t{2} * mode.components * mode.subsets;
    readValues(bits, mode.endpoints, std::span(values).first(count));
    Endpoints endpoints{};
    for (size_t subset = 0; subset < mode.subsets; ++subset)
        for (size_t which = 0; which < 2; ++which)
        {
            const auto value = [&](size_t component) {
                return unquantizeEndpoint(values[(subset * mode.components + component) * 2 + which],
                                          mode.endpoints);
            };
            auto& color = endpoints[subset][which];
            if (mode.components == 2)
                color = {value(0), value(0), value(0), value(1)};
            else
                color = {value(0), value(1), value(2), mode.components == 4 ? value(3) : 255u};
        }
    return endpoints;
}

uint8_t interpolate(uint32_t low, uint32_t high, uint32_t weight, bool srgb)
{
    const uint32_t wide_low = low << 8 | (srgb ? 0x80u : low);
    const uint32_t wide_high = high << 8 | (srgb ? 0x80u : high);
    return static_cast<uint8_t>((wide_low * (64 - weight) + wide_high * weight + 32) >> 6 >> 8);
}

Block solidBlock(BlockBits& bits)
{
    Texel texel;
    for (uint8_t& channel : texel)
        channel = static_cast<uint8_t>(bits.take(8));
    Block block;
    block.fill(texel);
    return block;
}

std::optional<Block> decodeBlock(const std::byte* data, bool srgb)
{
    BlockBits bits(data);
    const auto found = std::find_if(kModes.begin(), kModes.end(),
                                    [&](const UastcMode& m)
                                    { return (bits.peek7() & ((1u << m.code_bits) - 1u)) == m.code; });
    if (found == kModes.end())
        return std::nullopt;
    const UastcMode& mode = *found;
    const auto number = static_cast<uint32_t>(found - kModes.begin());
    bits.take(mode.code_bits);
    if (number == kSolidMode)
        return solidBlock(bits);
    bits.take(mode.hint_bits);
    const uint32_t pattern = bits.take(mode.pattern_bits);
    if (mode.subsets > 1 && pattern >= uastcSeeds(number).size())
        return std::nullopt;
    const uint32_t plane_channel = mode.plane_bits > 0 ? bits.take(mode.plane_bits) : 3;
    const Endpoints endpoints = readEndpoints(bits, mode);

    Block block;
    std::array<bool, 3> subset_seen{};
    for (uint32_t i = 0; i < 16; ++i)
    {
        const uint32_t subset =
            mode.subsets == 1 ? 0 : astcPartition(uastcSeeds(number)[pattern], mode.subsets, i % 4, i / 4);
        // the anchor weight (the first of a subset) lacks its highest bit, which is 0
        const uint32_t stored_bits = mode.weight_bits - (subset_seen[subset] ? 0u : 1u);
        subset_seen[subset] = true;
        const uint32_t weight = unquantizeWeight(bits.take(stored_bits), mode.weight_bits);
        const uint32_t plane_weight =
            mode.planes == 2 ? unquantizeWeight(bits.take(stored_bits), mode.weight_bits) : weight;
        for (uint32_t c = 0; c < 4; ++c)
            block[i][c] =
                interpolate(endpoints[subset][0][c], endpoints[subset][1][c],
                            mode.planes == 2 && c == plane_channel ? plane_weight : weight, srgb && c < 3);
    }
    return block;
}

uint32_t hash52(uint32_t p)
{
    p ^= p >> 15;
    p *= 0xEEDE0891u;
    p ^= p >> 5;
    p += p << 16;
    p ^= p >> 7;
    p ^= p >> 3;
    p ^= p << 6;
    p ^= p >> 17;
    return p;
}

} // namespace

uint32_t astcPartition(uint32_t seed, uint32_t count, uint32_t x, uint32_t y)
{
    // blocks of fewer than 31 texels double their coordinates
    x *= 2;
    y *= 2;
    seed += (count - 1) * 1024;
    const uint32_t random = hash52(seed);
    std::array<uint32_t, 8> seeds{};
    for (uint32_t i = 0; i < 8; ++i)
    {
        seeds[i] = (random >> (4 * i)) & 15u;
        seeds[i] *= seeds[i];
    }
    const uint32_t by_count = count == 3 ? 6 : 5;
    const uint32_t shift_a = (seed & 1u) != 0 ? ((seed & 2u) != 0 ? 4 : 5) : by_count;
    const uint32_t shift_b = (seed & 1u) != 0 ? by_count : ((seed & 2u) != 0 ? 4 : 5);
    for (uint32_t i = 0; i < 8; ++i)
        seeds[i] >>= i % 2 == 0 ? shift_a : shift_b;

    const uint32_t a = (seeds[0] * x + seeds[1] * y + (random >> 14)) & 63u;
    const uint32_t b = (seeds[2] * x + seeds[3] * y + (random >> 10)) & 63u;
    const uint32_t c = count < 3 ? 0 : (seeds[4] * x + seeds[5] * y + (random >> 6)) & 63u;
    if (a >= b && a >= c)
        return 0;
    return b >= c ? 1 : 2;
}

std::span<const uint16_t> uastcSeeds(uint32_t mode)
{
    if (mode == 3)
        return kSeeds3;
    if (mode == 7)
        return kMode7Seeds;
    return kSeeds2;
}

bool decodeUastc(std::span<const std::byte> blocks, bool srgb, DecodedImage& image)
{
    const uint32_t columns = (image.width + 3) / 4;
    const uint32_t rows = (image.height + 3) / 4;
    if (blocks.size() != size_t{columns} * rows * kUastcBlockBytes)
        return false;
    for (uint32_t row = 0; row < rows; ++row)
        for (uint32_t column = 0; column < columns; ++column)
        {
            const auto block =
                decodeBlock(&blocks[(size_t{row} * columns + column) * kUastcBlockBytes], srgb);
            if (!block)
                return false;
            for (uint32_t i = 0; i < 16; ++i)
            {
                const uint32_t x = column * 4 + i % 4;
                const uint32_t y = row * 4 + i / 4;
                if (x < image.width && y < image.height)
                    std::memcpy(&image.texels[(size_t{y} * image.width + x) * 4], (*block)[i].data(), 4);
            }
        }
    return true;
}

} // namespace hearth::import

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/etc2/block_bits.h"

#include "cook/texels/etc2/base_sweep.h"

#include <utility>

namespace hearth::texels
{

namespace
{

/// Return a number, or its low bits, at a place of the block.
uint64_t field(int32_t value, uint32_t low, uint32_t bits)
{
    return (static_cast<uint64_t>(value) & ((uint64_t{1} << bits) - 1)) << low;
}

constexpr uint64_t kDifferentialBit = uint64_t{1} << 33;
constexpr uint64_t kFlipBit = uint64_t{1} << 32;

/// Place the index of a texel: texels are counted by columns, high and low bits lie apart.
uint64_t placeIndex(size_t texel, uint8_t index)
{
    const size_t place = texel % 4 * 4 + texel / 4;
    return static_cast<uint64_t>(index >> 1) << (16 + place) | static_cast<uint64_t>(index & 1) << place;
}

std::array<std::byte, 8> bytesFromWord(uint64_t word)
{
    std::array<std::byte, 8> bytes;
    for (size_t b = 0; b < 8; ++b)
        bytes[b] = static_cast<std::byte>(word >> (56 - 8 * b));
    return bytes;
}

/// Fill the bits of a channel that hold nothing else, so that its sum of base and difference is no code of 5
/// bits: above if the low bits are great, else below.
/// low    of the channel's 8 bits
/// base   low 2 bits of the 5 of the base
/// step   low 2 bits of the 3 of the difference
uint64_t overflow(uint32_t low, int32_t base, int32_t step)
{
    // 28 + base + step > 31, or base - 4 + step < 0
    return base + step >= 4 ? field(7, low + 5, 3) : field(1, low + 2, 1);
}

/// Fill the highest bit of a channel so that its sum of base and difference is a code of 5 bits.
/// base  low 4 bits of the base
/// step  difference, 3 bits
uint64_t avoidOverflow(uint32_t low, int32_t base, int32_t step)
{
    return base + (step < 4 ? step : step - 8) < 0 ? field(1, low + 7, 1) : 0;
}

} // namespace

std::array<std::byte, 8> writeHalves(const Block8& block, const HalvesSolution& solution,
                                     const ColorWeights& weights)
{
    uint64_t word = field(solution.tables[0], 37, 3) | field(solution.tables[1], 34, 3) |
                    (solution.is_differential ? kDifferentialBit : 0) | (solution.is_flipped ? kFlipBit : 0);
    for (uint32_t c = 0; c < 3; ++c)
    {
        const int32_t first = solution.codes[0][c], second = solution.codes[1][c];
        const uint32_t low = 56 - 8 * c;
        word |= solution.is_differential ? field(first, low + 3, 5) | field(second - first, low, 3)
                                         : field(first, low + 4, 4) | field(second, low, 4);
    }
    for (size_t h = 0; h < 2; ++h)
    {
        const TexelMask mask = kHalfMasks[solution.is_flipped ? 1 : 0][h];
        const Paints paints = halfPaints(widenCodes(solution.codes[h], solution.bits()), solution.tables[h]);
        const std::array<uint8_t, 8> indices = choosePaints(gatherTexels<8>(block, mask), paints, weights);
        for (size_t t = 0, i = 0; t < 16; ++t)
            if ((mask >> t & 1) != 0)
                word |= placeIndex(t, indices[i++]);
    }
    return bytesFromWord(word);
}

std::array<std::byte, 8> writePaints(const Block8& block, PaintSolution solution,
                                     const ColorWeights& weights)
{
    if (solution.is_h && (solution.codes[0] >= solution.codes[1]) != (solution.distance % 2 != 0))
        std::swap(solution.codes[0], solution.codes[1]);
    const auto& [first, second] = solution.codes;
    const int32_t distance = solution.distance;
    uint64_t word = kDifferentialBit;
    if (solution.is_h)
    {
        word |= field(first[0], 59, 4) | field(first[1] >> 1, 56, 3) | field(first[1], 52, 1) |
                field(first[2] >> 3, 51, 1) | field(first[2], 47, 3) | field(second[0], 43, 4) |
                field(second[1], 39, 4) | field(second[2], 35, 4) | field(distance >> 2, 34, 1) |
                field(distance >> 1, 32, 1);
        word |= avoidOverflow(56, first[0], first[1] >> 1);
        word |= overflow(48, (first[1] & 1) << 1 | first[2] >> 3, first[2] >> 1 & 3);
    }
    else
    {
        word |= field(first[0] >> 2, 59, 2) | field(first[0], 56, 2) | field(first[1], 52, 4) |
                field(first[2], 48, 4) | field(second[0], 44, 4) | field(second[1], 40, 4) |
                field(second[2], 36, 4) | field(distance >> 1, 34, 2) | field(distance, 32, 1);
        word |= overflow(56, first[0] >> 2, first[0] & 3);
    }
    const std::array<uint8_t, 16> indices =
        choosePaints(gatherTexels<16>(block, kAllTexels), solution.paints(), weights);
    for (size_t t = 0; t < 16; ++t)
        word |= placeIndex(t, indices[t]);
    return bytesFromWord(word);
}

std::array<std::byte, 8> writePlanar(const PlanarSolution& solution)
{
    const auto& [red, green, blue] = solution.channels;
    uint64_t word = kDifferentialBit;
    word |= field(red[0], 57, 6) | field(green[0] >> 6, 56, 1) | field(green[0], 49, 6) |
            field(blue[0] >> 5, 48, 1) | field(blue[0] >> 3, 43, 2) | field(blue[0], 39, 3);
    word |= field(red[1] >> 1, 34, 5) | field(red[1], 32, 1) | field(green[1], 25, 7) | field(blue[1], 19, 6);
    word |= field(red[2], 13, 6) | field(green[2], 6, 7) | field(blue[2], 0, 6);
    word |= avoidOverflow(56, red[0] >> 2, (red[0] & 3) << 1 | green[0] >> 6);
    word |= avoidOverflow(48, green[0] >> 2 & 15, (green[0] & 3) << 1 | blue[0] >> 5);
    word |= overflow(40, blue[0] >> 3 & 3, blue[0] >> 1 & 3);
    return bytesFromWord(word);
}

} // namespace hearth::texels

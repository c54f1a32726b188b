// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/texels/astc_integers.h"

#include <algorithm>
#include <array>

namespace hearth::formats
{

namespace
{

constexpr size_t kTritsPerBlock = 5, kQuintsPerBlock = 3;

constexpr uint8_t packedBit(uint32_t word, uint32_t index)
{
    return static_cast<uint8_t>(word >> index & 1);
}

constexpr uint8_t packedBits(uint32_t word, uint32_t high, uint32_t low)
{
    return static_cast<uint8_t>(word >> low & ((2u << (high - low)) - 1));
}

/// [packed byte]: its five trits.
constexpr auto kTrits = []
{
    std::array<std::array<uint8_t, kTritsPerBlock>, 256> table{};
    for (uint32_t packed = 0; packed < 256; ++packed)
    {
        auto& trits = table[packed];
        uint32_t c = packedBits(packed, 4, 0);
        if (packedBits(packed, 4, 2) == 7)
        {
            c = static_cast<uint32_t>(packedBits(packed, 7, 5) << 2 | packedBits(packed, 1, 0));
            trits[4] = trits[3] = 2;
        }
        else if (packedBits(packed, 6, 5) == 3)
        {
            trits[4] = 2;
            trits[3] = packedBit(packed, 7);
        }
        else
        {
            trits[4] = packedBit(packed, 7);
            trits[3] = packedBits(packed, 6, 5);
        }
        if (packedBits(c, 1, 0) == 3)
        {
            trits[2] = 2;
            trits[1] = packedBit(c, 4);
            trits[0] = static_cast<uint8_t>(packedBit(c, 3) << 1 | (packedBit(c, 2) & ~packedBit(c, 3)));
        }
        else if (packedBits(c, 3, 2) == 3)
        {
            trits[2] = trits[1] = 2;
            trits[0] = packedBits(c, 1, 0);
        }
        else
        {
            trits[2] = packedBit(c, 4);
            trits[1] = packedBits(c, 3, 2);
            trits[0] = static_cast<uint8_t>(packedBit(c, 1) << 1 | (packedBit(c, 0) & ~packedBit(c, 1)));
        }
    }
    return table;
}();

/// [7 packed bits]: their three quints.
constexpr auto kQuints = []
{
    std::array<std::array<uint8_t, kQuintsPerBlock>, 128> table{};
    for (uint32_t packed = 0; packed < 128; ++packed)
    {
        auto& quints = table[packed];
        if (packedBits(packed, 2, 1) == 3 && packedBits(packed, 6, 5) == 0)
        {
            const uint32_t low = packedBit(packed, 0);
            quints[2] = static_cast<uint8_t>(low << 2 | (packedBit(packed, 4) & ~low) << 1 |
                                             (packedBit(packed, 3) & ~low));
            quints[1] = quints[0] = 4;
            continue;
        }
        uint32_t c = packedBits(packed, 4, 0);
        quints[2] = packedBits(packed, 6, 5);
        if (packedBits(packed, 2, 1) == 3)
        {
            quints[2] = 4;
            c = static_cast<uint32_t>(packedBits(packed, 4, 3) << 3 | (~packedBits(packed, 6, 5) & 3) << 1 |
                                      packedBit(packed, 0));
        }
        quints[1] = packedBits(c, 2, 0) == 5 ? uint8_t{4} : packedBits(c, 4, 3);
        quints[0] = packedBits(c, 2, 0) == 5 ? packedBits(c, 4, 3) : packedBits(c, 2, 0);
    }
    return table;
}();

/// Number of packed bits that follow each value of a block.
constexpr std::array<uint8_t, kTritsPerBlock> kTritBits = {2, 2, 1, 2, 1};
constexpr std::array<uint8_t, kQuintsPerBlock> kQuintBits = {3, 2, 2};

/// Decode blocks of values, each with its own bits, then a share of the block's packed digits.
template <size_t PerBlock, size_t Packings>
void decodeDigits(const AstcBits& sequence, uint32_t value_bits,
                  const std::array<std::array<uint8_t, PerBlock>, Packings>& digits,
                  const std::array<uint8_t, PerBlock>& digit_bits, std::span<uint8_t> values)
{
    const uint32_t mask = (1u << value_bits) - 1;
    size_t position = 0;
    for (size_t first = 0; first < values.size(); first += PerBlock)
    {
        uint64_t block = sequence.get(position, 38); // the longest: five values of 6 bits and 8 packed bits
        std::array<uint32_t, PerBlock> low;
        uint32_t packed = 0, packed_bits = 0;
        for (size_t i = 0; i < PerBlock; ++i)
        {
            low[i] = static_cast<uint32_t>(block) & mask;
            block >>= value_bits;
            packed |= (static_cast<uint32_t>(block) & ((1u << digit_bits[i]) - 1)) << packed_bits;
            block >>= digit_bits[i];
            packed_bits += digit_bits[i];
        }
        const size_t count = std::min(PerBlock, values.size() - first);
        for (size_t i = 0; i < count; ++i)
            values[first + i] =
                static_cast<uint8_t>(static_cast<uint32_t>(digits[packed][i]) << value_bits | low[i]);
        position += packed_bits + PerBlock * value_bits;
    }
}

} // namespace

AstcBits AstcBits::cut(size_t first, size_t count) const
{
    AstcBits bits = *this;
    if (first >= 64)
        bits = {high >> (first - 64), 0};
    else if (first > 0)
        bits = {low >> first | high << (64 - first), high >> first};
    if (count < 64)
        return {bits.low & ((uint64_t{1} << count) - 1), 0};
    if (count < 128)
        bits.high &= (uint64_t{1} << (count - 64)) - 1;
    return bits;
}

AstcBits AstcBits::reverse() const
{
    const auto reverse_word = [](uint64_t word)
    {
        word = (word >> 1 & 0x5555555555555555) | (word & 0x5555555555555555) << 1;
        word = (word >> 2 & 0x3333333333333333) | (word & 0x3333333333333333) << 2;
        word = (word >> 4 & 0x0F0F0F0F0F0F0F0F) | (word & 0x0F0F0F0F0F0F0F0F) << 4;
        word = (word >> 8 & 0x00FF00FF00FF00FF) | (word & 0x00FF00FF00FF00FF) << 8;
        word = (word >> 16 & 0x0000FFFF0000FFFF) | (word & 0x0000FFFF0000FFFF) << 16;
        return word >> 32 | word << 32;
    };
    return {reverse_word(high), reverse_word(low)};
}

void decodeSequence(const AstcBits& sequence, const AstcRange& range, std::span<uint8_t> values)
{
    if (range.digit_base == 3)
        decodeDigits(sequence, range.bits, kTrits, kTritBits, values);
    else if (range.digit_base == 5)
        decodeDigits(sequence, range.bits, kQuints, kQuintBits, values);
    else
        for (size_t i = 0; i < values.size(); ++i)
            values[i] = static_cast<uint8_t>(sequence.get(i * range.bits, range.bits));
}

} // namespace hearth::formats

// Layout of UASTC blocks, written down from the specification and independent of the decoder's tables.
// Source: Binomial LLC, "UASTC LDR 4x4 Texture Specification".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace hearth::import::test
{

/// Writes a block of 16 bytes, each value with its lowest bit first.
class UastcBits
{
public:
    void put(uint64_t value, uint32_t count)
    {
        for (uint32_t i = 0; i < count; ++i, ++at_)
            block_[at_ / 8] = static_cast<uint8_t>(block_[at_ / 8] | ((value >> i) & 1u) << (at_ % 8));
    }
    void putCode(std::string_view code)
    {
        for (const char bit : code)
            put(bit == '1', 1);
    }
    const std::vector<uint8_t>& block() const { return block_; }
    uint32_t used() const { return at_; }

private:
    std::vector<uint8_t> block_ = std::vector<uint8_t>(16);
    uint32_t at_ = 0;
};

struct UastcLayout
{
    uint32_t mode;
    std::string_view code; ///< first bit first
    uint32_t hints;
    uint32_t pattern_bits;
    uint32_t channel_bits; ///< bits of the channel with separate weights
    uint32_t planes;
    uint32_t components;
    uint32_t subsets;
    uint32_t levels; ///< number of endpoint values
    uint32_t weight_bits;
    uint32_t bits; ///< total bits
};

/// All modes but 8, which is a colour of four bytes.
inline constexpr std::array kUastcLayouts = {
    UastcLayout{0, "1000", 15, 0, 0, 1, 3, 1, 192, 4, 128},
    UastcLayout{1, "101011", 15, 0, 0, 1, 3, 1, 256, 2, 100},
    UastcLayout{2, "10111", 15, 5, 0, 1, 3, 2, 16, 3, 119},
    UastcLayout{3, "11000", 15, 4, 0, 1, 3, 3, 12, 2, 118},
    UastcLayout{4, "11001", 15, 5, 0, 1, 3, 2, 40, 2, 119},
    UastcLayout{5, "11010", 15, 0, 0, 1, 3, 1, 256, 3, 115},
    UastcLayout{6, "11011", 15, 0, 2, 2, 3, 1, 160, 2, 128},
    UastcLayout{7, "11100", 15, 5, 0, 1, 3, 2, 40, 2, 119},
    UastcLayout{9, "11110", 23, 5, 0, 1, 4, 2, 16, 2, 127},
    UastcLayout{10, "010", 17, 0, 0, 1, 4, 1, 48, 4, 128},
    UastcLayout{11, "00", 17, 0, 2, 2, 4, 1, 48, 2, 128},
    UastcLayout{12, "011", 17, 0, 0, 1, 4, 1, 192, 3, 128},
    UastcLayout{13, "11111", 23, 0, 2, 2, 4, 1, 256, 1, 124},
    UastcLayout{14, "10110", 23, 0, 0, 1, 4, 1, 256, 2, 123},
    UastcLayout{15, "1010000", 23, 0, 0, 1, 2, 1, 256, 4, 125},
    UastcLayout{16, "101010", 23, 5, 0, 1, 2, 2, 256, 2, 128},
    UastcLayout{17, "101001", 23, 0, 0, 2, 2, 1, 256, 2, 123},
    UastcLayout{18, "1001", 15, 0, 0, 1, 3, 1, 32, 5, 128},
};

inline constexpr std::string_view kUastcSolidCode = "11101";

/// 3 where endpoint values have a trit, 5 where they have a quint, else 1.
constexpr uint32_t getDigitBase(uint32_t levels)
{
    return levels % 3 == 0 ? 3 : levels % 5 == 0 ? 5 : 1;
}

/// Number of plain bits of an endpoint value, below its trit or quint.
constexpr uint32_t countPlainBits(uint32_t levels)
{
    return static_cast<uint32_t>(std::bit_width(levels / getDigitBase(levels)) - 1);
}

/// Write the endpoint values of a block: first their trits in fives or quints in threes, as one number each,
/// then the plain bits.
inline void putEndpoints(UastcBits& out, uint32_t levels, std::span<const uint32_t> values)
{
    const uint32_t base = getDigitBase(levels), bits = countPlainBits(levels);
    const size_t per_pack = base == 3 ? 5 : 3;
    for (size_t at = 0; base > 1 && at < values.size(); at += per_pack)
    {
        uint32_t pack = 0, combinations = 1;
        for (size_t i = at; i < values.size() && i < at + per_pack; ++i, combinations *= base)
            pack += (values[i] >> bits) * combinations;
        out.put(pack, static_cast<uint32_t>(std::bit_width(combinations - 1)));
    }
    for (const uint32_t value : values)
        out.put(value, bits);
}

} // namespace hearth::import::test

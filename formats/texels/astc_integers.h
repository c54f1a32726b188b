// Integer sequences of ASTC: values of a few bits each, packed with trits or quints.
// Source: Khronos Data Format Specification, section "Integer Sequence Encoding".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace hearth::formats
{

/// Bits of an ASTC block; bit 0 is the lowest of the first byte. Bits from 128 on are 0.
struct AstcBits
{
    uint64_t low, high;

    /// Return `count` bits from `first` on. count  1 to 57
    constexpr uint64_t get(size_t first, size_t count) const
    {
        uint64_t bits = 0;
        if (first < 64)
            bits = low >> first | (first == 0 ? 0 : high << (64 - first));
        else if (first < 128)
            bits = high >> (first - 64);
        return bits & ((uint64_t{1} << count) - 1);
    }

    constexpr uint32_t get32(size_t first, size_t count) const
    {
        return static_cast<uint32_t>(get(first, count));
    }

    /// Return the bits from `first` on, moved down to bit 0, and 0 from bit `count` on. count  0 to 128
    AstcBits cut(size_t first, size_t count) const;

    /// Return the bits in reverse order, as weights are stored.
    AstcBits reverse() const;
};

/// Values from 0 to digit_base * 2^bits - 1.
struct AstcRange
{
    uint8_t digit_base; ///< 3: trits, 5: quints, 1: neither
    uint8_t bits;       ///< below the digit
};

/// Ranges in ascending order: the number of values is 2, 3, 4, 5, 6, 8, 10, 12, ... 256. Weights have the
/// first twelve; endpoints have those from kMinAstcColourRange on.
inline constexpr AstcRange kAstcRanges[] = {
    {1, 1}, {3, 0}, {1, 2}, {5, 0}, {3, 1}, {1, 3}, {5, 1}, {3, 2}, {1, 4}, {5, 2}, {3, 3},
    {1, 5}, {5, 3}, {3, 4}, {1, 6}, {5, 4}, {3, 5}, {1, 7}, {5, 5}, {3, 6}, {1, 8},
};
inline constexpr size_t kAstcRangeCount = std::size(kAstcRanges);
inline constexpr size_t kMinAstcColourRange = 4; ///< 0 to 5

/// Return the bits of a sequence.
constexpr size_t sequenceBits(const AstcRange& range, size_t count)
{
    const size_t digits = range.digit_base == 3   ? (count * 8 + 4) / 5
                          : range.digit_base == 5 ? (count * 7 + 2) / 3
                                                  : 0;
    return digits + count * range.bits;
}

/// Decode a sequence that starts at bit 0; bits behind it must be 0.
void decodeSequence(const AstcBits& sequence, const AstcRange& range, std::span<uint8_t> values);

} // namespace hearth::formats

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/texels/eac_decoder.h"

#include "formats/texels/etc2_tables.h"

#include <algorithm>

namespace hearth::formats
{

namespace
{

/// Range of the decoded values.
struct EacRange
{
    int minimum;
    int maximum;
};

/// Add each texel's modifier, times a step, to a base value. Indices of 3 bits follow the first two bytes,
/// column by column from the highest bit.
EacValues decodeEacTexels(std::span<const std::byte, 8> block, int base, int step, EacRange range)
{
    const std::array<int8_t, 8>& modifiers = kEacModifiers[std::to_integer<uint32_t>(block[1]) & 15];
    uint64_t indices = 0;
    for (size_t b = 2; b < block.size(); ++b)
        indices = indices << 8 | std::to_integer<uint64_t>(block[b]);
    EacValues values;
    for (uint32_t x = 0; x < 4; ++x)
        for (uint32_t y = 0; y < 4; ++y)
        {
            const uint64_t index = indices >> (45 - 3 * (4 * x + y)) & 7;
            values[4 * y + x] = std::clamp(base + modifiers[index] * step, range.minimum, range.maximum);
        }
    return values;
}

int eacMultiplier(std::span<const std::byte, 8> block)
{
    return std::to_integer<int>(block[1]) >> 4;
}

/// Return the step of 11 bits: multipliers count eighths, and 0 stands for the finest.
int eacFineStep(std::span<const std::byte, 8> block)
{
    return std::max(8 * eacMultiplier(block), 1);
}

} // namespace

EacValues decodeEacAlpha(std::span<const std::byte, 8> block)
{
    return decodeEacTexels(block, std::to_integer<int>(block[0]), eacMultiplier(block), {0, 255});
}

EacValues decodeEacUnsigned(std::span<const std::byte, 8> block)
{
    const int base = std::to_integer<int>(block[0]) * 8 + 4;
    return decodeEacTexels(block, base, eacFineStep(block), {0, 2047});
}

EacValues decodeEacSigned(std::span<const std::byte, 8> block)
{
    const auto code = static_cast<int8_t>(std::to_integer<uint8_t>(block[0]));
    const int base = std::max(int{code}, -127) * 8; // -128 is read as -127
    return decodeEacTexels(block, base, eacFineStep(block), {-1023, 1023});
}

} // namespace hearth::formats

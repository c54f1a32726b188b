// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/texels/astc_partitions.h"

#include <array>

namespace hearth::formats
{

namespace
{

/// Blocks with fewer texels have patterns of twice the frequency.
constexpr uint32_t kSmallBlockTexels = 31;

uint32_t hash52(uint32_t value)
{
    value ^= value >> 15;
    value -= value << 17;
    value += value << 7;
    value += value << 4;
    value ^= value >> 5;
    value += value << 16;
    value ^= value >> 7;
    value ^= value >> 3;
    value ^= value << 6;
    value ^= value >> 17;
    return value;
}

/// Ramp over a block, modulo 64: a texel belongs to the partition whose ramp is highest there.
struct Ramp
{
    uint32_t x, y, offset;
};

} // namespace

void writeAstcPartitions(uint32_t index, uint32_t count, uint32_t block_width, uint32_t block_height,
                         std::span<uint8_t> partitions)
{
    const uint32_t seed = index + (count - 1) * 1024;
    const uint32_t random = hash52(seed);
    const uint32_t by_seed = (seed & 2) != 0 ? 4 : 5, by_count = count == 3 ? 6 : 5;
    const uint32_t shift_x = (seed & 1) != 0 ? by_seed : by_count,
                   shift_y = (seed & 1) != 0 ? by_count : by_seed;
    const uint32_t step = block_width * block_height < kSmallBlockTexels ? 2 : 1;

    std::array<Ramp, 4> ramps{};
    for (uint32_t i = 0; i < count; ++i)
    {
        const uint32_t x = random >> (8 * i) & 15, y = random >> (8 * i + 4) & 15;
        ramps[i] = {(x * x >> shift_x) * step, (y * y >> shift_y) * step, random >> (14 - 4 * i)};
    }
    for (uint32_t y = 0; y < block_height; ++y)
        for (uint32_t x = 0; x < block_width; ++x)
        {
            uint32_t highest = 0, partition = 0;
            for (uint32_t i = 0; i < count; ++i)
            {
                const uint32_t value = (ramps[i].x * x + ramps[i].y * y + ramps[i].offset) & 63;
                if (i == 0 || value > highest)
                {
                    highest = value;
                    partition = i;
                }
            }
            partitions[y * block_width + x] = static_cast<uint8_t>(partition);
        }
}

} // namespace hearth::formats

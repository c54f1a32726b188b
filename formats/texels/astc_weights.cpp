// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/texels/astc_weights.h"

namespace hearth::formats
{

namespace
{

constexpr size_t kMaxWeights = 64;
constexpr size_t kMinWeightBits = 24, kMaxWeightBits = 96;
constexpr size_t kWeightRanges = 12;
constexpr uint32_t kMaxGridSide = 12;

/// Weights of a plane. Infill may look one row and one column beyond the grid, for weights that count 0.
using PaddedGrid = std::array<uint8_t, kMaxWeights + kMaxGridSide + 1>;

/// Return the weight from 0 to 64 of a stored value.
constexpr uint8_t unquantizeWeight(const AstcRange& range, uint32_t value)
{
    const uint32_t digit = value >> range.bits, low = value & ((1u << range.bits) - 1);
    uint32_t weight = 0;
    if (range.digit_base == 1) // repeat the bits from the highest on
        for (int shift = 6 - range.bits; shift > -range.bits; shift -= range.bits)
            weight |= shift >= 0 ? value << shift : value >> -shift;
    else if (range.bits == 0)
        weight = range.digit_base == 3 ? std::array{0u, 32u, 63u}[digit]
                                       : std::array{0u, 16u, 32u, 47u, 63u}[digit];
    else
    {
        const uint32_t a = (low & 1) != 0 ? 0x7F : 0, b = low >> 1 & 1, c = low >> 2 & 1;
        uint32_t factor = 0, spread = 0;
        switch (range.bits)
        {
        case 1:
            factor = range.digit_base == 3 ? 50 : 28;
            break;
        case 2:
            factor = range.digit_base == 3 ? 23 : 13;
            spread = range.digit_base == 3 ? b * 0b1000101 : b * 0b1000010;
            break;
        default:
            factor = 11;
            spread = c * 0b1000010 + b * 0b0100001;
            break;
        }
        weight = (digit * factor + spread) ^ a;
        weight = (a & 0x20) | weight >> 2;
    }
    return static_cast<uint8_t>(weight > 32 ? weight + 1 : weight);
}

/// [range][stored value]
constexpr auto kWeights = []
{
    std::array<std::array<uint8_t, 32>, kWeightRanges> table{};
    for (size_t i = 0; i < kWeightRanges; ++i)
        for (uint32_t value = 0; value < uint32_t{kAstcRanges[i].digit_base} << kAstcRanges[i].bits; ++value)
            table[i][value] = unquantizeWeight(kAstcRanges[i], value);
    return table;
}();

/// Places of a grid that a texel's column or row lies between, in sixteenths.
struct Infill
{
    uint8_t index, fraction;
};

std::array<Infill, kMaxGridSide> spreadGrid(uint32_t texels, uint32_t grid)
{
    const uint32_t scale = (1024 + texels / 2) / (texels - 1);
    std::array<Infill, kMaxGridSide> places{};
    for (uint32_t i = 0; i < texels; ++i)
    {
        const uint32_t place = (scale * i * (grid - 1) + 32) >> 6;
        places[i] = {static_cast<uint8_t>(place >> 4), static_cast<uint8_t>(place & 15)};
    }
    return places;
}

void infill(const PaddedGrid& grid, uint32_t grid_width, std::span<const Infill> columns,
            std::span<const Infill> rows, std::array<uint8_t, kMaxAstcBlockTexels>& weights)
{
    size_t texel = 0;
    for (const Infill& row : rows)
        for (const Infill& column : columns)
        {
            const size_t first = row.index * grid_width + column.index;
            const uint32_t w11 = (uint32_t{column.fraction} * row.fraction + 8) >> 4;
            const uint32_t w10 = row.fraction - w11, w01 = column.fraction - w11;
            const uint32_t w00 = 16 + w11 - column.fraction - row.fraction;
            weights[texel++] = static_cast<uint8_t>((grid[first] * w00 + grid[first + 1] * w01 +
                                                     grid[first + grid_width] * w10 +
                                                     grid[first + grid_width + 1] * w11 + 8) >>
                                                    4);
        }
}

/// Size, planes and number of the range, as stored.
struct BlockMode
{
    uint32_t width, height, planes, range;
};

/// Read the block mode by the table of its 2D layouts. Nothing if it is reserved.
std::optional<BlockMode> readBlockMode(uint32_t mode)
{
    const uint32_t a = mode >> 5 & 3, b = mode >> 7 & 3;
    const bool first_rows = (mode & 3) != 0;
    const uint32_t range = (first_rows ? mode & 3 : mode >> 2 & 3) << 1 | (mode >> 4 & 1);
    if (range < 2)
        return std::nullopt;
    BlockMode out{0, 0, 1 + (mode >> 10 & 1), range - 2 + ((mode >> 9 & 1) != 0 ? 6 : 0)};
    const auto resize = [&](uint32_t width, uint32_t height)
    {
        out.width = width;
        out.height = height;
    };
    if (first_rows)
        switch (mode >> 2 & 3)
        {
        case 0:
            resize(b + 4, a + 2);
            break;
        case 1:
            resize(b + 8, a + 2);
            break;
        case 2:
            resize(a + 2, b + 8);
            break;
        default:
            b < 2 ? resize(a + 2, b + 6) : resize(b, a + 2);
            break;
        }
    else
        switch (b)
        {
        case 0:
            resize(12, a + 2);
            break;
        case 1:
            resize(a + 2, 12);
            break;
        case 2: // bits 9 and 10 are the height's
            resize(a + 6, (mode >> 9 & 3) + 6);
            out.planes = 1;
            out.range = range - 2;
            break;
        default:
            if (a > 1)
                return std::nullopt;
            a == 0 ? resize(6, 10) : resize(10, 6);
            break;
        }
    return out;
}

} // namespace

std::optional<AstcGrid> readAstcGrid(uint32_t block_mode, uint32_t block_width, uint32_t block_height)
{
    const std::optional<BlockMode> mode = readBlockMode(block_mode);
    if (!mode || mode->width > block_width || mode->height > block_height)
        return std::nullopt;
    const size_t count = size_t{mode->width} * mode->height * mode->planes;
    const size_t bits = sequenceBits(kAstcRanges[mode->range], count);
    if (count > kMaxWeights || bits < kMinWeightBits || bits > kMaxWeightBits)
        return std::nullopt;
    return AstcGrid{mode->width, mode->height, mode->planes, mode->range, bits};
}

void decodeAstcWeights(const AstcBits& block, const AstcGrid& grid, uint32_t block_width,
                       uint32_t block_height,
                       std::array<std::array<uint8_t, kMaxAstcBlockTexels>, 2>& weights)
{
    std::array<uint8_t, kMaxWeights> stored;
    const size_t count = size_t{grid.width} * grid.height;
    decodeSequence(block.reverse().cut(0, grid.bits), kAstcRanges[grid.range],
                   std::span(stored).first(count * grid.planes));
    const auto columns = spreadGrid(block_width, grid.width), rows = spreadGrid(block_height, grid.height);
    for (size_t plane = 0; plane < grid.planes; ++plane)
    {
        PaddedGrid values{};
        for (size_t i = 0; i < count; ++i)
            values[i] = kWeights[grid.range][stored[i * grid.planes + plane]];
        infill(values, grid.width, std::span(columns).first(block_width), std::span(rows).first(block_height),
               weights[plane]);
    }
}

} // namespace hearth::formats

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/texels/bc6h_decoder.h"

#include "formats/base/half.h"
#include "formats/texels/bc6h_modes.h"
#include "formats/texels/block_bits.h"
#include "formats/texels/bptc_tables.h"

#include <algorithm>

namespace hearth::formats
{

namespace
{

/// [variable]: endpoints as stored, later unquantised. See Bc6hVariable.
using Variables = std::array<int32_t, 12>;

const Bc6hMode* findMode(uint32_t number)
{
    const auto found = std::find_if(kBc6hModes.begin(), kBc6hModes.end(),
                                    [&](const Bc6hMode& mode) { return mode.number == number; });
    return found == kBc6hModes.end() ? nullptr : &*found;
}

Variables readVariables(const Bc6hMode& mode, BlockBitReader& bits)
{
    Variables variables{};
    for (uint32_t i = 0; i < mode.field_count; ++i)
    {
        const Bc6hField field = mode.fields[i];
        int32_t& variable = variables[static_cast<size_t>(field.variable)];
        const int step = field.first <= field.last ? 1 : -1;
        for (int bit = field.first; bit != field.last + step; bit += step)
            variable |= static_cast<int32_t>(bits.read(1)) << bit;
    }
    return variables;
}

int32_t extendSign(int32_t value, uint32_t bits)
{
    const int32_t sign = int32_t{1} << (bits - 1);
    return ((value & (2 * sign - 1)) ^ sign) - sign;
}

/// Make whole endpoints of differences, and numbers with a sign where the format has one.
void resolve(const Bc6hMode& mode, bool is_signed, Variables& variables)
{
    const uint32_t width = mode.endpoint_bits;
    for (uint32_t i = 0; i < variables.size(); ++i)
    {
        int32_t& value = variables[i];
        if (mode.transformed && i >= 3)
            value = (variables[i % 3] + extendSign(value, mode.delta_bits[i % 3])) & ((1 << width) - 1);
    }
    if (is_signed)
        for (int32_t& value : variables)
            value = extendSign(value, width);
}

} // namespace

void decodeBc6hBlock(bool is_signed, std::span<const std::byte, 16> block, std::span<DecodedTexel, 16> texels)
{
    BlockBitReader bits(block);
    uint32_t number = bits.read(2);
    if (number >= 2)
        number |= bits.read(3) << 2;
    const Bc6hMode* const mode = findMode(number);
    if (mode == nullptr)
    {
        std::fill(texels.begin(), texels.end(), DecodedTexel{0, 0, 0, kHalfOne});
        return;
    }
    Variables ends = readVariables(*mode, bits);
    resolve(*mode, is_signed, ends);
    for (int32_t& value : ends)
        value = unquantizeBc6h(value, mode->endpoint_bits, is_signed);

    const uint32_t partition = mode->subsets == 2 ? bits.read(5) : 0;
    const uint32_t width = mode->subsets == 2 ? 3 : 4;
    for (uint32_t t = 0; t < 16; ++t)
    {
        const uint32_t subset = bptcSubset(mode->subsets, partition, t);
        const bool is_anchor = t == bptcAnchor(mode->subsets, partition, subset);
        const uint32_t weight = bptcWeight(bits.read(width - (is_anchor ? 1 : 0)), width);
        for (uint32_t channel = 0; channel < 3; ++channel)
        {
            const uint32_t first = 6 * subset + channel;
            texels[t][channel] = bc6hHalf(bptcInterpolate(ends[first], ends[first + 3], weight), is_signed);
        }
        texels[t][3] = kHalfOne;
    }
}

} // namespace hearth::formats

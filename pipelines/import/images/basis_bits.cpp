// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/images/basis_bits.h"

#include <algorithm>
#include <array>

namespace hearth::import
{

namespace
{

constexpr uint32_t kMaxCodeLength = 16;
constexpr uint32_t kSymbolCountBits = 14;

// Symbols of the code-length code: 0..16 are lengths, then runs.
constexpr uint32_t kShortZeroRun = 17; ///< 3 bits, from 3
constexpr uint32_t kLongZeroRun = 18;  ///< 7 bits, from 11
constexpr uint32_t kShortRepeat = 19;  ///< 2 bits, from 3
constexpr uint32_t kLongRepeat = 20;   ///< 7 bits, from 7
constexpr std::array<uint8_t, 21> kLengthOrder = {17, 18, 19, 20, 0,  8, 7,  9, 6,  10, 5,
                                                  11, 4,  12, 3,  13, 2, 14, 1, 15, 16};

uint32_t reverseBits(uint32_t code, uint32_t length)
{
    uint32_t result = 0;
    for (uint32_t i = 0; i < length; ++i)
        result |= ((code >> i) & 1u) << (length - 1 - i);
    return result;
}

} // namespace

uint32_t BasisBitReader::readVariableLength(uint32_t group_bits)
{
    uint32_t value = 0;
    for (uint32_t shift = 0; shift < 32; shift += group_bits)
    {
        const uint32_t group = bits(group_bits + 1);
        value |= (group & ((1u << group_bits) - 1u)) << shift;
        if ((group >> group_bits) == 0)
            return value;
    }
    fail();
    return 0;
}

bool BasisPrefixCode::build(std::span<const uint8_t> lengths)
{
    std::array<uint32_t, kMaxCodeLength + 1> count_of_length{};
    for (uint8_t length : lengths)
        ++count_of_length[length];
    count_of_length[0] = 0;
    max_length_ = kMaxCodeLength;
    while (max_length_ > 0 && count_of_length[max_length_] == 0)
        --max_length_;
    if (max_length_ == 0)
        return false;

    std::array<uint32_t, kMaxCodeLength + 2> next_code{};
    for (uint32_t length = 1; length <= max_length_; ++length)
        next_code[length + 1] = (next_code[length] + count_of_length[length]) << 1;
    const bool complete = next_code[max_length_ + 1] == 2u << max_length_;
    const bool single = max_length_ == 1 && count_of_length[1] == 1;
    if (!complete && !single)
        return false;

    lookup_.assign(size_t{1} << max_length_, {});
    for (size_t symbol = 0; symbol < lengths.size(); ++symbol)
    {
        const uint32_t length = lengths[symbol];
        if (length == 0)
            continue;
        for (size_t at = reverseBits(next_code[length]++, length); at < lookup_.size();
             at += size_t{1} << length)
            lookup_[at] = {static_cast<uint16_t>(symbol), static_cast<uint8_t>(length)};
    }
    return true;
}

bool BasisPrefixCode::read(BasisBitReader& reader)
{
    const uint32_t symbol_count = reader.bits(kSymbolCountBits);
    if (symbol_count == 0)
        return !reader.failed();

    std::array<uint8_t, kLengthOrder.size()> length_lengths{};
    const uint32_t length_count = reader.bits(5);
    if (length_count < 1 || length_count > kLengthOrder.size())
        return false;
    for (uint32_t i = 0; i < length_count; ++i)
        length_lengths[kLengthOrder[i]] = static_cast<uint8_t>(reader.bits(3));
    BasisPrefixCode length_code;
    if (!length_code.build(length_lengths))
        return false;

    std::vector<uint8_t> lengths;
    while (lengths.size() < symbol_count && !reader.failed())
    {
        const uint32_t symbol = length_code.decode(reader);
        if (symbol <= kMaxCodeLength)
            lengths.push_back(static_cast<uint8_t>(symbol));
        else if (symbol == kShortZeroRun || symbol == kLongZeroRun)
            lengths.resize(
                lengths.size() + (symbol == kShortZeroRun ? reader.bits(3) + 3 : reader.bits(7) + 11), 0);
        else
        {
            const uint32_t run = symbol == kShortRepeat ? reader.bits(2) + 3 : reader.bits(7) + 7;
            if (lengths.empty() || lengths.back() == 0)
                return false;
            lengths.resize(lengths.size() + run, lengths.back());
        }
    }
    static_assert(kLongRepeat == kLengthOrder.size() - 1);
    return !reader.failed() && lengths.size() == symbol_count && build(lengths);
}

uint32_t BasisPrefixCode::decode(BasisBitReader& reader) const
{
    if (lookup_.empty())
    {
        reader.fail();
        return 0;
    }
    const Entry entry = lookup_[reader.peek(max_length_)];
    if (entry.length == 0)
        reader.fail();
    reader.skip(entry.length);
    return entry.symbol;
}

} // namespace hearth::import

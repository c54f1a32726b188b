// Reads and writes blocks of 128 bits whose fields are not whole bytes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace hearth::formats
{

/// Reader of a block's bits in order: the lowest bit of the first byte comes first.
class BlockBitReader
{
public:
    explicit BlockBitReader(std::span<const std::byte, 16> block)
    {
        for (uint32_t i = 0; i < 8; ++i)
        {
            low_ |= std::to_integer<uint64_t>(block[i]) << 8 * i;
            high_ |= std::to_integer<uint64_t>(block[i + 8]) << 8 * i;
        }
    }

    /// Read a field; bits beyond the end are 0.
    /// count  0 to 32
    uint32_t read(uint32_t count)
    {
        if (count == 0)
            return 0;
        const auto value = static_cast<uint32_t>(low_ & ((uint64_t{1} << count) - 1));
        low_ = low_ >> count | high_ << (64 - count);
        high_ >>= count;
        return value;
    }

private:
    uint64_t low_ = 0, high_ = 0; ///< bits that are left
};

} // namespace hearth::formats

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

/// Writer of a block's bits in the same order.
class BlockBitWriter
{
public:
    /// Append the lowest bits of a value. At most 128 bits fit.
    /// count  0 to 32
    void write(uint32_t value, uint32_t count)
    {
        if (count == 0)
            return;
        const uint64_t bits = value & ((uint64_t{1} << count) - 1);
        if (used_ < 64)
        {
            low_ |= bits << used_;
            high_ |= used_ + count > 64 ? bits >> (64 - used_) : 0;
        }
        else
            high_ |= bits << (used_ - 64);
        used_ += count;
    }

    /// Store the bits; those that were not written are 0.
    void store(std::span<std::byte, 16> block) const
    {
        for (uint32_t i = 0; i < 8; ++i)
        {
            block[i] = static_cast<std::byte>(low_ >> 8 * i & 0xFFu);
            block[i + 8] = static_cast<std::byte>(high_ >> 8 * i & 0xFFu);
        }
    }

private:
    uint64_t low_ = 0, high_ = 0;
    uint32_t used_ = 0;
};

} // namespace hearth::formats

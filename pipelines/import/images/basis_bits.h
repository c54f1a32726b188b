// Reads bits and prefix codes of BasisLZ: least significant bit first, canonical codes of at most 16 bits.
// Source: Khronos KTX File Format Specification 2.0, "BasisLZ/ETC1S bitstream".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hearth::import
{

/// Bit reader. Reading past the end returns zeros and sets failed().
class BasisBitReader
{
public:
    explicit BasisBitReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

    /// Return the next `count` bits, at most 16, without consuming them.
    uint32_t peek(uint32_t count)
    {
        while (available_ < count)
        {
            buffer_ |= next_ < bytes_.size() ? static_cast<uint32_t>(bytes_[next_]) << available_ : 0u;
            ++next_;
            available_ += 8;
        }
        return buffer_ & ((1u << count) - 1u);
    }

    void skip(uint32_t count)
    {
        buffer_ >>= count;
        available_ -= count;
        failed_ = failed_ || next_ - available_ / 8 > bytes_.size();
    }

    uint32_t bits(uint32_t count)
    {
        const uint32_t value = peek(count);
        skip(count);
        return value;
    }

    /// Read a number in groups of `group_bits`, the lowest first; a bit after each group says if another
    /// follows.
    uint32_t readVariableLength(uint32_t group_bits);

    bool failed() const { return failed_; }
    void fail() { failed_ = true; }

private:
    std::span<const std::byte> bytes_;
    size_t next_ = 0;
    uint32_t buffer_ = 0;
    uint32_t available_ = 0;
    bool failed_ = false;
};

class BasisPrefixCode
{
public:
    /// Read the lengths of a code. Return false if they do not form a complete prefix code.
    bool read(BasisBitReader& reader);

    /// Decode the next symbol; fail the reader if there is none.
    uint32_t decode(BasisBitReader& reader) const;

    bool empty() const { return lookup_.empty(); }

private:
    bool build(std::span<const uint8_t> lengths);

    struct Entry
    {
        uint16_t symbol = 0;
        uint8_t length = 0; ///< 0: no code starts with these bits
    };
    std::vector<Entry> lookup_; ///< indexed by the next max_length_ bits
    uint32_t max_length_ = 0;
};

} // namespace hearth::import

// Reads binary data with bounds checks: the only place where sizes read from a file are used in arithmetic.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <type_traits>

namespace hearth
{

/// Reader of little-endian plain data from untrusted bytes. A read past the end returns nullopt and does not
/// advance.
class ByteReader
{
public:
    explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

    size_t position() const { return position_; }
    size_t remaining() const { return bytes_.size() - position_; }

    template <typename T>
    std::optional<T> read()
    {
        static_assert(std::is_trivially_copyable_v<T>);
        if (sizeof(T) > remaining())
            return std::nullopt;
        T value;
        std::memcpy(&value, bytes_.data() + position_, sizeof(T));
        position_ += sizeof(T);
        return value;
    }

    std::optional<std::span<const std::byte>> readBytes(uint64_t count)
    {
        if (count > remaining())
            return std::nullopt;
        const auto part = bytes_.subspan(position_, static_cast<size_t>(count));
        position_ += static_cast<size_t>(count);
        return part;
    }

    bool skip(uint64_t count) { return readBytes(count).has_value(); }

    bool seek(uint64_t position)
    {
        if (position > bytes_.size())
            return false;
        position_ = static_cast<size_t>(position);
        return true;
    }

private:
    std::span<const std::byte> bytes_;
    size_t position_ = 0;
};

/// Return the part [offset, offset + count * stride) of `bytes`, or nullopt if it does not lie inside.
inline std::optional<std::span<const std::byte>>
checkedPart(std::span<const std::byte> bytes, uint64_t offset, uint64_t count, uint64_t stride = 1)
{
    if (offset > bytes.size())
        return std::nullopt;
    const uint64_t rest = bytes.size() - offset;
    if (stride != 0 && count > rest / stride)
        return std::nullopt;
    return bytes.subspan(static_cast<size_t>(offset), static_cast<size_t>(count * stride));
}

} // namespace hearth

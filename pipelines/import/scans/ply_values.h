// Reads the values of a PLY body in sequence, in each of its formats.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/byte_reader.h"
#include "pipelines/import/scans/ply_header.h"
#include "pipelines/import/scans/text_cursor.h"

#include <bit>

namespace hearth::import
{

/// Values of an ascii body: each row of an element has a line of its own.
class AsciiValues
{
public:
    AsciiValues(std::string_view body, size_t first_line) : text_(body), first_line_(first_line) {}

    bool startRow()
    {
        text_.skipSpace();
        return !text_.atEnd();
    }
    bool endRow()
    {
        text_.skipBlanks();
        return text_.atLineEnd();
    }
    std::optional<double> read(PlyType) { return text_.number(); }
    size_t remaining() const { return text_.remaining(); }
    size_t location() const { return first_line_ + text_.line() - 1; }
    static std::string describe(size_t location) { return "line " + std::to_string(location); }

private:
    TextCursor text_;
    size_t first_line_;
};

class BinaryValues
{
public:
    BinaryValues(std::span<const std::byte> bytes, size_t offset, bool big_endian)
        : reader_(bytes), swap_(big_endian)
    {
        reader_.seek(offset);
    }

    bool startRow() const { return true; }
    bool endRow() const { return true; }
    size_t remaining() const { return reader_.remaining(); }
    size_t location() const { return reader_.position(); }
    static std::string describe(size_t location) { return "byte " + std::to_string(location); }

    std::optional<double> read(PlyType type)
    {
        switch (type)
        {
        case PlyType::int8:
            return integer<int8_t, uint8_t>();
        case PlyType::uint8:
            return integer<uint8_t, uint8_t>();
        case PlyType::int16:
            return integer<int16_t, uint16_t>();
        case PlyType::uint16:
            return integer<uint16_t, uint16_t>();
        case PlyType::int32:
            return integer<int32_t, uint32_t>();
        case PlyType::uint32:
            return integer<uint32_t, uint32_t>();
        case PlyType::float32:
            return floating<float, uint32_t>();
        case PlyType::float64:
            return floating<double, uint64_t>();
        }
        return std::nullopt;
    }

private:
    template <typename Bits>
    std::optional<Bits> bits()
    {
        auto value = reader_.read<Bits>();
        if (value && swap_)
        {
            uint64_t swapped = 0;
            for (size_t i = 0; i < sizeof(Bits); ++i)
                swapped = swapped << 8 | ((uint64_t{*value} >> (8 * i)) & 0xFFu);
            value = static_cast<Bits>(swapped);
        }
        return value;
    }

    template <typename T, typename Bits>
    std::optional<double> integer()
    {
        const auto value = bits<Bits>();
        return value ? std::optional<double>(static_cast<T>(*value)) : std::nullopt;
    }

    template <typename T, typename Bits>
    std::optional<double> floating()
    {
        const auto value = bits<Bits>();
        return value ? std::optional<double>(static_cast<double>(std::bit_cast<T>(*value))) : std::nullopt;
    }

    ByteReader reader_;
    bool swap_;
};

} // namespace hearth::import

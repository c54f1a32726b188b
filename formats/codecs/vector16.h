// SIMD vectors of sixteen bytes, as bytes and as halves of words, available on every x86-64 and ARM64
// processor.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace hearth::formats
{

inline constexpr size_t kHalves = 8;
using Halves = uint16_t __attribute__((vector_size(16)));
using Bytes = uint8_t __attribute__((vector_size(16)));

inline Halves asHalves(Bytes bytes)
{
    return std::bit_cast<Halves>(bytes);
}
inline Bytes asBytes(Halves halves)
{
    return std::bit_cast<Bytes>(halves);
}

inline Bytes loadBytes(const uint8_t* from)
{
    Bytes bytes;
    std::memcpy(&bytes, from, sizeof(bytes));
    return bytes;
}

inline Halves allHalves(uint16_t half)
{
    return Halves{half, half, half, half, half, half, half, half};
}

inline bool anyBit(Halves halves)
{
    const auto words = std::bit_cast<std::array<uint64_t, 2>>(halves);
    return (words[0] | words[1]) != 0;
}

/// Interleave bytes of a and b: the first halves of both, or the second halves.
inline Bytes interleaveLow(Bytes a, Bytes b)
{
    return __builtin_shufflevector(a, b, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
}
inline Bytes interleaveHigh(Bytes a, Bytes b)
{
    return __builtin_shufflevector(a, b, 8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13, 29, 14, 30, 15, 31);
}

/// Transpose: half j of row i changes places with half i of row j.
inline void transpose(std::array<Halves, kHalves>& rows)
{
    for (int round = 0; round < 3; ++round)
    {
        std::array<Halves, kHalves> mixed;
        for (size_t i = 0; i < 4; ++i)
        {
            mixed[2 * i] = __builtin_shufflevector(rows[i], rows[i + 4], 0, 8, 1, 9, 2, 10, 3, 11);
            mixed[2 * i + 1] = __builtin_shufflevector(rows[i], rows[i + 4], 4, 12, 5, 13, 6, 14, 7, 15);
        }
        rows = mixed;
    }
}

} // namespace hearth::formats

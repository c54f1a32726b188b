// Sixteen bytes side by side, as bytes and as halves of words: what every x86-64 and ARM64 processor has.
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

/// Where the mask has bits `yes`, else `no`.
inline Halves select(Halves mask, Halves yes, Halves no)
{
    return (yes & mask) | (no & ~mask);
}

inline Halves allHalves(uint16_t half)
{
    return Halves{half, half, half, half, half, half, half, half};
}

/// Shifts each half to the right by a number of its own, 1 to 16, given as 2 to the power of 16 less that.
inline Halves shiftRight(Halves halves, Halves power)
{
#if defined(__SSE2__)
    // shifts by different numbers came later; the upper half of a product is as old as MMX
    using Signed = int16_t __attribute__((vector_size(16)));
    return std::bit_cast<Halves>(
        __builtin_ia32_pmulhuw128(std::bit_cast<Signed>(halves), std::bit_cast<Signed>(power)));
#else
    using Words = uint32_t __attribute__((vector_size(32)));
    return __builtin_convertvector(
        (__builtin_convertvector(halves, Words) * __builtin_convertvector(power, Words)) >> 16, Halves);
#endif
}

inline bool anyBit(Halves halves)
{
    const auto words = std::bit_cast<std::array<uint64_t, 2>>(halves);
    return (words[0] | words[1]) != 0;
}

inline Halves addBytes(Halves a, Halves b)
{
    return asHalves(asBytes(a) + asBytes(b));
}

/// Bytes of a and b in turns: the first halves of both, or the second.
inline Bytes interleaveLow(Bytes a, Bytes b)
{
    return __builtin_shufflevector(a, b, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
}
inline Bytes interleaveHigh(Bytes a, Bytes b)
{
    return __builtin_shufflevector(a, b, 8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13, 29, 14, 30, 15, 31);
}

/// Byte j of row i changes places with byte i of row j.
inline void transpose(std::array<Bytes, 16>& rows)
{
    for (int round = 0; round < 4; ++round)
    {
        std::array<Bytes, 16> mixed;
        for (size_t i = 0; i < 8; ++i)
        {
            mixed[2 * i] = interleaveLow(rows[i], rows[i + 8]);
            mixed[2 * i + 1] = interleaveHigh(rows[i], rows[i + 8]);
        }
        rows = mixed;
    }
}

} // namespace hearth::formats

// Low-discrepancy points of the unit square at every count: Sobol' sequences with an Owen scramble for each
// seed. See cook/sampling/README.md.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

#include <cstdint>

namespace hearth::sampling
{

/// Derive one of 2^64 independent seeds for each `index`, such as the index of a sample or a triangle.
/// source  G. L. Steele, D. Lea, C. H. Flood, "Fast splittable pseudorandom number generators", 2014: its
///         finaliser
constexpr uint64_t deriveSeed(uint64_t seed, uint64_t index)
{
    uint64_t x = seed + (index + 1) * 0x9E3779B97F4A7C15u;
    x = (x ^ x >> 30) * 0xBF58476D1CE4E5B9u;
    x = (x ^ x >> 27) * 0x94D049BB133111EBu;
    return x ^ x >> 31;
}

constexpr uint32_t reverseBits(uint32_t x)
{
    x = x >> 16 | x << 16;
    x = (x & 0x00FF00FFu) << 8 | (x & 0xFF00FF00u) >> 8;
    x = (x & 0x0F0F0F0Fu) << 4 | (x & 0xF0F0F0F0u) >> 4;
    x = (x & 0x33333333u) << 2 | (x & 0xCCCCCCCCu) >> 2;
    return (x & 0x55555555u) << 1 | (x & 0xAAAAAAAAu) >> 1;
}

/// Point of the unit square, with coordinates as fractions of 2^32.
struct SquarePoint
{
    uint32_t x = 0, y = 0;
    friend bool operator==(const SquarePoint&, const SquarePoint&) = default;
};

namespace detail
{

/// Compute the second Sobol' coordinate with its bits reversed. The generator matrix is Pascal's triangle
/// modulo 2: for a polynomial over GF(2), the substitution of x + 1 for x in the index.
/// (1 + x)^16 = 1 + x^16, so that halves, quarters, ... do that.
constexpr uint32_t secondReversed(uint32_t index)
{
    index ^= index >> 16 & 0x0000FFFFu;
    index ^= index >> 8 & 0x00FF00FFu;
    index ^= index >> 4 & 0x0F0F0F0Fu;
    index ^= index >> 2 & 0x33333333u;
    return index ^ (index >> 1 & 0x55555555u);
}

/// Scramble reversed bits: each bit is flipped depending on the lower bits and the seed, which is a nested
/// uniform scramble.
/// source  S. Laine, T. Karras, "Stratified sampling for stochastic transparency", 2011; rounds and constants
///         of N. Vegdahl, "Building a better LK hash", 2021: less bias than the original's
constexpr uint32_t scrambledReversed(uint32_t x, uint32_t seed)
{
    x ^= x * 0x3D20ADEAu;
    x += seed;
    x *= seed >> 16 | 1;
    x ^= x * 0x05526C56u;
    x ^= x * 0x53A22864u;
    return x;
}

} // namespace detail

/// Compute point `index` of the Sobol' sequence in two dimensions, under the seed's own Owen scramble.
/// Of points k 2^m to (k + 1) 2^m - 1, every box of 2^-a x 2^-b with a + b = m holds exactly one.
/// source  A. B. Owen, "Scrambled net variance for integrals of smooth functions", 1997: error N^-3/2
constexpr SquarePoint owenSobol(uint32_t index, uint64_t seed)
{
    const auto low = static_cast<uint32_t>(seed), high = static_cast<uint32_t>(seed >> 32);
    return {reverseBits(detail::scrambledReversed(index, low)),
            reverseBits(detail::scrambledReversed(detail::secondReversed(index), high))};
}

/// Shuffle the indices of a sequence, under a shuffle for each seed. Blocks of 2^m indices from a multiple of
/// 2^m on stay together, so that their points are as even as before.
/// source  B. Burley, "Practical hash-based Owen scrambling", 2020
constexpr uint32_t shuffleIndex(uint32_t index, uint64_t seed)
{
    return reverseBits(
        detail::scrambledReversed(reverseBits(index), static_cast<uint32_t>(deriveSeed(seed, 0))));
}

/// Compute a point for one of several steps that points of the same index share, as the bounces of a path.
/// Scrambles alone would leave the same bits of the index in all steps, which would depend on each other.
/// seed  of the step
constexpr SquarePoint shuffledOwenSobol(uint32_t index, uint64_t seed)
{
    return owenSobol(shuffleIndex(index, seed), seed);
}

/// Convert to a float in (0, 1): the upper 23 bits plus half a step, which a float holds exactly.
constexpr float unitFloat(uint32_t fraction)
{
    return static_cast<float>(static_cast<int32_t>(fraction >> 9)) * 0x1p-23f + 0x1p-24f;
}

constexpr Float2 unitPoint(SquarePoint p)
{
    return {unitFloat(p.x), unitFloat(p.y)};
}

} // namespace hearth::sampling

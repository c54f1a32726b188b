// Direction along which texels vary most.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace hearth::texels
{

/// Square symmetric matrix.
template <size_t kSize>
using SymmetricMatrix = std::array<std::array<int64_t, kSize>, kSize>;

/// Shift numbers until the largest has at most 15 bits.
template <size_t kSize>
void reduce(std::array<int64_t, kSize>& numbers)
{
    uint64_t all = 0;
    for (const int64_t number : numbers)
        all |= static_cast<uint64_t>(number < 0 ? ~number : number);
    const auto width = static_cast<int>(std::bit_width(all));
    const int shift = width > 15 ? width - 15 : 0;
    for (int64_t& number : numbers)
        number >>= shift;
}

/// Return the direction of the largest eigenvalue, approximately, with components of up to 15 bits: power
/// iteration from the row with the largest diagonal. Zero if the matrix is.
template <size_t kSize>
std::array<int64_t, kSize> largestEigenvector(const SymmetricMatrix<kSize>& matrix, int iterations)
{
    size_t largest = 0;
    for (size_t i = 1; i < kSize; ++i)
        largest = matrix[i][i] > matrix[largest][largest] ? i : largest;
    std::array<int64_t, kSize> vector = matrix[largest];
    reduce(vector);
    for (int i = 0; i < iterations; ++i)
    {
        std::array<int64_t, kSize> next{};
        for (size_t row = 0; row < kSize; ++row)
            for (size_t column = 0; column < kSize; ++column)
                next[row] += matrix[row][column] * vector[column];
        reduce(next);
        vector = next;
    }
    return vector;
}

/// Return the direction along which the texels `used`, a bit each, vary most; zero if they are one colour.
/// texels  [channel][texel]
template <size_t kChannels>
std::array<int32_t, kChannels> principalAxis(const std::array<std::array<int16_t, 16>, kChannels>& texels,
                                             uint32_t used)
{
    std::array<int64_t, kChannels> sums{};
    SymmetricMatrix<kChannels> products{};
    const auto count = std::popcount(used);
    for (size_t t = 0; t < 16; ++t)
        for (size_t i = 0; (used >> t & 1u) != 0 && i < kChannels; ++i)
        {
            sums[i] += texels[i][t];
            for (size_t j = 0; j <= i; ++j)
                products[i][j] += texels[i][t] * texels[j][t];
        }
    for (size_t i = 0; i < kChannels; ++i)
        for (size_t j = 0; j <= i; ++j)
            products[i][j] = products[j][i] = products[i][j] * count - sums[i] * sums[j];
    const std::array<int64_t, kChannels> vector = largestEigenvector(products, 6);
    std::array<int32_t, kChannels> axis;
    for (size_t i = 0; i < kChannels; ++i)
        axis[i] = static_cast<int32_t>(vector[i]);
    return axis;
}

} // namespace hearth::texels

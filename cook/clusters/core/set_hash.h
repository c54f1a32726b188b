// Compares sets of numbers by the sums of their hashes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>

namespace hearth::clusters
{

/// Hash a number. Sums of hashes, modulo 2^64, are equal only for equal multisets, with an error chance of
/// 2^-64.
inline uint64_t hashNumber(uint64_t number)
{
    number = (number + 1) * 0x9E3779B97F4A7C15u;
    number = (number ^ (number >> 32)) * 0xD6E8FEB86659FD93u;
    return number ^ (number >> 32);
}

} // namespace hearth::clusters

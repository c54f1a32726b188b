// Random numbers of a path.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>

namespace hearth::reference
{

/// SplitMix64 (S. Vigna), as a random stream.
class Random
{
public:
    explicit Random(uint64_t seed) : state_(seed * 0xD1342543DE82EF95u + 1) {}
    double next()
    {
        uint64_t x = state_ += 0x9E3779B97F4A7C15u;
        x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
        x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
        return static_cast<double>((x ^ (x >> 31)) >> 11) * 0x1p-53;
    }

private:
    uint64_t state_;
};

} // namespace hearth::reference

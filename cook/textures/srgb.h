// sRGB transfer function by tables (IEC 61966-2-1). Results are the same on every machine: the tables hold
// floats rounded from doubles, and mathematical libraries disagree only on the last bits of doubles.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace hearth::textures
{

/// Tables for both directions of the transfer function.
class SrgbTables
{
public:
    static const SrgbTables& get();

    float linear(uint8_t stored) const { return linear_[stored]; }

    /// Return the stored value whose encoding is nearest; values outside 0..1 and NaN are clamped.
    uint8_t stored(float linear) const
    {
        if (!(linear > 0))
            return 0;
        if (linear >= 1)
            return 255;
        uint8_t value = first_of_bucket_[static_cast<size_t>(linear * kBuckets)];
        while (linear >= upper_[value])
            ++value;
        return value;
    }

private:
    SrgbTables();

    static constexpr size_t kBuckets = 4096; ///< fine enough that the search above takes two steps at most
    std::array<float, 256> linear_;
    std::array<float, 256> upper_; ///< linear value above which the next stored value is nearer
    std::array<uint8_t, kBuckets> first_of_bucket_;
};

/// Table of the transfer function for 16 bits, made when it is first needed.
class WideSrgbTable
{
public:
    static const WideSrgbTable& get();

    float linear(uint16_t stored) const { return linear_[stored]; }

private:
    WideSrgbTable();

    std::array<float, 65536> linear_;
};

} // namespace hearth::textures

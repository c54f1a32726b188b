// Reduces the keys and the bits of a curve within a tolerance.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_compression/curve.h"

#include <array>

namespace hearth::animation_compression
{

/// Data of a channel in chunk AKBT, before it has an offset there. FORMAT.md, "Skins and animations".
struct PackedCurve
{
    struct Key
    {
        size_t curve_key = 0; ///< index of the key in the curve
        uint32_t largest = 0; ///< index of the omitted component of a rotation
        std::array<uint32_t, 3> codes{};
    };
    std::vector<Key> keys;
    std::array<float, 3> base{}; ///< value of code 0
    float step = 0;
    std::array<uint8_t, 3> bits{};
    double deviation = 0; ///< upper bound for the distance from the curve at any time

    uint32_t keyBits(formats::AnimationPath path) const
    {
        return uint32_t{bits[0]} + bits[1] + bits[2] +
               (path == formats::AnimationPath::rotation ? formats::kOmittedIndexBits : 0);
    }
};

/// Return the smallest of a few divisions of the tolerance between quantisation and omitted keys.
/// Deterministic.
/// tolerance  above 0, as distance() measures
/// returns    nothing if 24 bits are not enough, or no bound is known
std::optional<PackedCurve> packCurve(const Curve& curve, double tolerance);

} // namespace hearth::animation_compression

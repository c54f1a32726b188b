// A curve with fewer keys in fewer bits, within a tolerance.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_compression/curve.h"

#include <array>

namespace hearth::clips
{

/// What chunk AKBT has of a channel, before it has a place there. FORMAT.md, "Skins and animations".
struct PackedCurve
{
    struct Key
    {
        size_t of_curve = 0;  ///< its number there
        uint32_t largest = 0; ///< the number of a rotation that is left out
        std::array<uint32_t, 3> codes{};
    };
    std::vector<Key> keys;
    std::array<float, 3> base{}; ///< value of the codes 0
    float step = 0;
    std::array<uint8_t, 3> bits{};
    double deviation = 0; ///< at least the distance from the curve at any time

    uint32_t keyBits(formats::AnimationPath path) const
    {
        return uint32_t{bits[0]} + bits[1] + bits[2] +
               (path == formats::AnimationPath::rotation ? formats::kLargestBits : 0);
    }
};

/// The smallest of a few ways to share the tolerance between steps of codes and keys that are left out. Deterministic.
/// tolerance  above 0, as distance() measures
/// returns    nothing where 24 bits are not enough, or no bound is known
std::optional<PackedCurve> packedCurve(const Curve& curve, double tolerance);

} // namespace hearth::clips

// Reads the keys of an animation channel as values and cubic Bezier pieces.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/codecs/channel_keys.h"
#include "formats/scene/animation.h"

#include <algorithm>
#include <array>

namespace hearth::animation_bounds
{

/// Components of a channel's value, up to four; missing ones are 0.
using ChannelValue = formats::KeyValue;
/// Control points of a cubic over the parameters 0 to 1.
using BezierPiece = std::array<ChannelValue, 4>;

/// Keys of a channel, restricted to `count` components from `first` on.
class CurveKeys
{
public:
    CurveKeys(const formats::AnimationTables& tables, const formats::AnimationChannelRecord& channel,
              uint32_t first, uint32_t count)
        : keys_(tables.keys, tables.key_bits, channel), first_(first), count_(count)
    {
    }

    bool isSpline() const { return keys_.interpolation() == formats::Interpolation::cubic_spline; }
    bool isStep() const { return keys_.interpolation() == formats::Interpolation::step; }

    uint32_t count() const { return keys_.count(); }

    /// Return the time of a key, seconds.
    double time(uint32_t key) const { return keys_.time(key); }

    /// Return the last key that is not later than a time; the first key if all are later.
    uint32_t keyBefore(double time) const { return std::max(keys_.firstKeyAfter(time), 1u) - 1; }

    ChannelValue at(uint32_t key) const { return keys_.value(key, first_, count_); }

    /// True if the value changes from the key to the next one: false where both keys have the same time.
    bool hasPiece(uint32_t key) const { return key + 1 < count() && time(key + 1) > time(key); }
    bool hasSpline(uint32_t key) const { return isSpline() && hasPiece(key); }

    /// Return the spline from a key to the next one.
    BezierPiece piece(uint32_t key) const
    {
        const double third = (time(key + 1) - time(key)) / 3;
        const ChannelValue start = at(key), end = at(key + 1);
        const ChannelValue out = keys_.outTangent(key, first_, count_),
                           in = keys_.inTangent(key + 1, first_, count_);
        BezierPiece bezier{start, start, end, end};
        for (size_t i = 0; i < count_; ++i)
        {
            bezier[1][i] += third * out[i];
            bezier[2][i] -= third * in[i];
        }
        return bezier;
    }

private:
    formats::ChannelKeys keys_;
    uint32_t first_;
    uint32_t count_;
};

} // namespace hearth::animation_bounds

// Piecewise linear form of an animation channel, and upper bounds for the distance between two channels at
// any time. See cook/animation_compression/README.md, "Distance between two channels".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/codecs/channel_keys.h"
#include "formats/scene/animation.h"

#include <optional>
#include <vector>

namespace hearth::animation_compression
{

/// Return the distance between two values. Translations: metres. Scales: the largest difference of an axis.
/// Rotations: the chord between the unit quaternions, of either sign; a point moves by at most twice that
/// times its distance from the pivot.
double distance(formats::AnimationPath path, const formats::KeyValue& a, const formats::KeyValue& b);

/// Translations, rotations (of length 1) or scales over time, linear or in steps. At least one key.
struct Curve
{
    formats::AnimationPath path = formats::AnimationPath::translation;
    bool steps = false;
    std::vector<float> times; ///< seconds, never decreasing
    std::vector<formats::KeyValue> values;
    double remainder = 0; ///< for splines: upper bound for the distance from the source's channel
};

/// Convert a channel to a curve. Splines are divided into linear pieces with a remainder of at most
/// `tolerance`.
/// returns  nothing if that takes so many pieces that the spline itself is smaller, or if the spline comes
///          too near to 0 for a bound on its rotation
std::optional<Curve> makeCurve(const formats::AnimationTables& tables,
                               const formats::AnimationChannelRecord& channel, double tolerance);

/// Return an upper bound for the distance, at any time, between the curve and the linear piece from `start`
/// at key `first` to `end` at key `last`. Infinite if the shorter arc of a rotation is ambiguous. Stops early
/// above `limit`.
double pieceDeviation(const Curve& curve, size_t first, size_t last, const formats::KeyValue& start,
                      const formats::KeyValue& end, double limit);

/// Return an upper bound for the distance between the channel and one value, at any time.
double constantDeviation(const formats::AnimationTables& tables,
                         const formats::AnimationChannelRecord& channel, const formats::KeyValue& value);

/// Return a value in the middle of the channel's values, in single precision.
formats::KeyValue middleValue(const formats::AnimationTables& tables,
                              const formats::AnimationChannelRecord& channel);

} // namespace hearth::animation_compression

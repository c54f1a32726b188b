// A channel of a clip as straight pieces between keys, and how far another one can be from it, at any time.
// cook/animation_compression/README.md, "How far two channels are apart".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/codecs/channel_keys.h"
#include "formats/scene/animation.h"

#include <optional>
#include <vector>

namespace hearth::clips
{

/// How far apart two values are. Translations: metres. Scales: the largest difference of an axis. Rotations: the chord
/// between the unit quaternions, of either sign; a point turns by at most twice that times its distance from the pivot.
double distance(formats::AnimationPath path, const formats::KeyValue& a, const formats::KeyValue& b);

/// Translations, rotations (of length 1) or scales over time: linear or in steps. At least one key.
struct Curve
{
    formats::AnimationPath path = formats::AnimationPath::translation;
    bool steps = false;
    std::vector<float> times; ///< seconds, never decreasing
    std::vector<formats::KeyValue> values;
    double remainder = 0; ///< how far the channel that it stands for can be from it: of splines
};

/// Splines are cut into straight pieces so that what remains is at most `tolerance`.
/// returns  nothing where that takes so many pieces that the spline itself is smaller, or where the spline comes too near
///          to 0 for a bound on its rotation
std::optional<Curve> curveOf(const formats::MotionTables& tables,
                             const formats::AnimationChannelRecord& channel, double tolerance);

/// At least the distance between the curve and the straight piece that goes from `start` at key `first` to `end` at key
/// `last`, at any time between; infinite where it is not known which way round a rotation goes. Stops early where it is
/// above `limit`.
double pieceDeviation(const Curve& curve, size_t first, size_t last, const formats::KeyValue& start,
                      const formats::KeyValue& end, double limit);

/// At least the distance between the channel and one value, at any time.
double constantDeviation(const formats::MotionTables& tables, const formats::AnimationChannelRecord& channel,
                         const formats::KeyValue& value);

/// A value in the middle of the channel's, in single precision.
formats::KeyValue middleValue(const formats::MotionTables& tables,
                              const formats::AnimationChannelRecord& channel);

} // namespace hearth::clips

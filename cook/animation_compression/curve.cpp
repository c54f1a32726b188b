// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/animation_compression/curve.h"

#include "cook/animation_bounds/key_hull.h"
#include "cook/animation_bounds/quaternion.h"
#include "formats/base/assert.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hearth::animation_compression
{

using namespace formats;
using animation_bounds::dot;
using animation_bounds::length;
using animation_bounds::normalizedOrNone;
using animation_bounds::scaled;

namespace
{

constexpr double kUnknown = std::numeric_limits<double>::infinity();

// Cosine between two quaternions below which a rounding may change the shorter arc.
constexpr double kAmbiguousCosine = 1e-9;

// Chord between a value and all keys below which a rotation stays within that distance of the value: the
// shorter arcs stay inside.
constexpr double kNearChord = 0.2;

// Maximum number of linear pieces of one piece of a spline: with more, the spline's own keys are smaller.
constexpr uint32_t kMaxPieces = 8;

// Upper bound for a few roundings of numbers up to 1.
constexpr double kAngleRounding = 1e-14;

KeyValue minus(const KeyValue& a, const KeyValue& b)
{
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]};
}

KeyValue interpolated(const KeyValue& a, const KeyValue& b, double t)
{
    KeyValue value;
    for (size_t i = 0; i < value.size(); ++i)
        value[i] = a[i] * (1 - t) + b[i] * t;
    return value;
}

/// Return the angle between unit quaternions.
double angle(const KeyValue& a, const KeyValue& b)
{
    return 2 * std::asin(std::min(0.5 * length(minus(a, b)), 1.0));
}

/// Return an upper bound for the chord between two arcs that are traversed at constant speed in the same
/// time, each shorter than half a turn of the sphere. d = a - b has d'' = -theta^2 d + (phi^2 - theta^2) b.
/// The solution is the part from the ends, at most max / cos(theta / 2), plus the part from the second term,
/// at most (1 / cos(theta / 2) - 1) / theta^2 times it.
double arcDeviation(const KeyValue& a0, const KeyValue& a1, const KeyValue& b0, const KeyValue& b1)
{
    const double theta = angle(a0, a1), phi = angle(b0, b1);
    const double ends = std::max(length(minus(a0, b0)), length(minus(a1, b1)));
    const double growth = 1 / std::cos(0.5 * theta);
    // (1 / cos(x / 2) - 1) / x^2 grows from 1 / 8, but computing it cancels digits for small x
    constexpr double kSmallArc = 1e-3, kOfSmallArc = 0.1250001;
    const double of_speed = theta < kSmallArc ? kOfSmallArc : (growth - 1) / (theta * theta);
    return ends * growth + std::abs(phi - theta) * (phi + theta) * of_speed + kAngleRounding;
}

double rotationDeviation(const Curve& curve, size_t first, size_t last, const KeyValue& start,
                         const KeyValue& end, double limit)
{
    if (std::abs(dot(start, end)) < kAmbiguousCosine)
        return kUnknown;
    const double from = curve.times[first], seconds = curve.times[last] - from;
    double worst = 0;
    for (size_t key = first; key < last && worst <= limit; ++key)
    {
        if (!(curve.times[key + 1] > curve.times[key]))
            continue;
        const KeyValue& a0 = curve.values[key];
        const double cosine = dot(a0, curve.values[key + 1]);
        if (std::abs(cosine) < kAmbiguousCosine)
            return kUnknown;
        const KeyValue a1 = scaled(curve.values[key + 1], cosine < 0 ? -1 : 1);
        const KeyValue b0 = slerp(start, end, (curve.times[key] - from) / seconds);
        const KeyValue b1 = slerp(start, end, (curve.times[key + 1] - from) / seconds);
        const double side = dot(a0, b0) < 0 ? -1 : 1;
        worst = std::max(worst, arcDeviation(a0, a1, scaled(b0, side), scaled(b1, side)));
    }
    return worst;
}

/// Return the maximum distance: the difference of linear functions is largest at an end.
double vectorDeviation(const Curve& curve, size_t first, size_t last, const KeyValue& start,
                       const KeyValue& end, double limit)
{
    const double from = curve.times[first], seconds = curve.times[last] - from;
    double worst = 0;
    for (size_t key = first; key < last && worst <= limit; ++key)
    {
        if (!(curve.times[key + 1] > curve.times[key]))
            continue;
        for (const size_t at : {key, key + 1})
            worst = std::max(worst, distance(curve.path, curve.values[at],
                                             interpolated(start, end, (curve.times[at] - from) / seconds)));
    }
    return worst;
}

double stepDeviation(const Curve& curve, size_t first, size_t last, const KeyValue& start)
{
    double worst = 0;
    for (size_t key = first; key < last; ++key)
        worst = std::max(worst, distance(curve.path, curve.values[key], start));
    return worst;
}

// ---- splines

/// Piece of a spline between two keys, parameterised by the share of its time.
struct Spline
{
    KeyValue start, out, in, end; ///< tangents for the whole piece

    KeyValue at(double t) const
    {
        const double t2 = t * t, t3 = t2 * t;
        KeyValue value;
        for (size_t i = 0; i < value.size(); ++i)
            value[i] = (2 * t3 - 3 * t2 + 1) * start[i] + (t3 - 2 * t2 + t) * out[i] +
                       (3 * t2 - 2 * t3) * end[i] + (t3 - t2) * in[i];
        return value;
    }

    KeyValue secondDerivative(double t) const
    {
        KeyValue value;
        for (size_t i = 0; i < value.size(); ++i)
            value[i] = (12 * t - 6) * (start[i] - end[i]) + (6 * t - 4) * out[i] + (6 * t - 2) * in[i];
        return value;
    }

    /// Return an upper bound for the distance from the line between two parameters: the second derivative is
    /// linear, so it is largest at an end.
    double sagitta(double from, double to) const
    {
        const double most = std::max(length(secondDerivative(from)), length(secondDerivative(to)));
        return most * (to - from) * (to - from) / 8;
    }
};

/// Return an upper bound for the chord between the normalized spline and the arc between two of its
/// parameters.
double rotationRemainder(const Spline& spline, double from, double to)
{
    const KeyValue start = spline.at(from), end = spline.at(to);
    const double shorter = std::min(length(start), length(end));
    const double longer = std::max(length(start), length(end));
    if (!(shorter > 1e-3) || dot(start, end) < 0.5 * length(start) * length(end))
        return kUnknown;
    const double theta = angle(normalizedOrNone(start), normalizedOrNone(end));
    // minimum distance between the line and 0
    const double near = shorter * std::cos(0.5 * theta);
    const double sagitta = spline.sagitta(from, to);
    if (sagitta > 0.5 * near)
        return kUnknown;
    // |a/|a| - b/|b|| <= 2 |a - b| / (|a| + |b|)
    const double off_arc = 2 * sagitta / (2 * near - sagitta);
    // the line's point moves along the arc at |start| |end| sin(theta) / |line|^2: ahead or behind by a
    // quarter of the variation of that speed
    const double speed = length(start) * length(end) * std::sin(theta);
    const double off_time = 0.25 * speed * (1 / (near * near) - 1 / (longer * longer));
    return off_arc + off_time;
}

double remainder(AnimationPath path, const Spline& spline, double from, double to)
{
    return path == AnimationPath::rotation ? rotationRemainder(spline, from, to) : spline.sagitta(from, to);
}

/// Append the keys behind the piece's first key, its end included. False if that takes too many pieces.
bool appendPieces(const Spline& spline, float start_time, float end_time, double tolerance, Curve& curve)
{
    const double seconds = double{end_time} - double{start_time};
    for (uint32_t pieces = 1; pieces <= kMaxPieces; ++pieces)
    {
        std::vector<float> times{start_time};
        for (uint32_t i = 1; i < pieces; ++i)
            times.push_back(static_cast<float>(start_time + seconds * i / pieces));
        times.push_back(end_time);
        // two adjacent floats have no time between them
        if (std::adjacent_find(times.begin(), times.end(), std::greater_equal<>()) != times.end())
            return false;
        const auto share = [&](float time) { return (double{time} - double{start_time}) / seconds; };
        double worst = 0;
        for (size_t i = 0; i + 1 < times.size() && worst <= tolerance; ++i)
            worst = std::max(worst, remainder(curve.path, spline, share(times[i]), share(times[i + 1])));
        if (worst > tolerance)
            continue;
        curve.remainder = std::max(curve.remainder, worst);
        for (size_t i = 1; i < times.size(); ++i)
        {
            curve.times.push_back(times[i]);
            curve.values.push_back(spline.at(share(times[i])));
        }
        return true;
    }
    return false;
}

std::optional<Curve> toLinearPieces(const ChannelKeys& keys, Curve curve, uint32_t components,
                                    double tolerance)
{
    curve.times = {keys.time(0)};
    curve.values = {keys.value(0, 0, components)};
    for (uint32_t key = 0; key + 1 < keys.count(); ++key)
    {
        const double seconds = double{keys.time(key + 1)} - double{keys.time(key)};
        const Spline spline{
            keys.value(key, 0, components), scaled(keys.outTangent(key, 0, components), seconds),
            scaled(keys.inTangent(key + 1, 0, components), seconds), keys.value(key + 1, 0, components)};
        if (!(seconds > 0))
        {
            curve.times.push_back(keys.time(key + 1));
            curve.values.push_back(spline.end);
        }
        else if (!appendPieces(spline, keys.time(key), keys.time(key + 1), tolerance, curve))
            return std::nullopt;
    }
    return curve;
}

animation_bounds::Box3d channelBox(const AnimationTables& tables, const AnimationChannelRecord& channel)
{
    animation_bounds::Box3d box;
    animation_bounds::addValues(tables, channel, box);
    return box;
}

} // namespace

double distance(AnimationPath path, const KeyValue& a, const KeyValue& b)
{
    const KeyValue d = minus(a, b);
    if (path == AnimationPath::scale)
        return std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])});
    if (path == AnimationPath::rotation && dot(a, b) < 0)
        return length(minus(a, scaled(b, -1)));
    return length(d);
}

std::optional<Curve> makeCurve(const AnimationTables& tables, const AnimationChannelRecord& channel,
                               double tolerance)
{
    const ChannelKeys keys(tables.keys, tables.key_bits, channel);
    std::optional<Curve> curve(std::in_place);
    curve->path = static_cast<AnimationPath>(channel.path);
    curve->steps = keys.interpolation() == Interpolation::step;
    HEARTH_ASSERT(curve->path != AnimationPath::weights);
    if (keys.interpolation() == Interpolation::cubic_spline)
        curve = toLinearPieces(keys, *curve, channel.components, tolerance);
    else
        for (uint32_t key = 0; key < keys.count(); ++key)
        {
            curve->times.push_back(keys.time(key));
            curve->values.push_back(keys.value(key, 0, channel.components));
        }
    if (curve && curve->path == AnimationPath::rotation)
        for (KeyValue& value : curve->values)
            value = normalizedOrNone(value);
    return curve;
}

double pieceDeviation(const Curve& curve, size_t first, size_t last, const KeyValue& start,
                      const KeyValue& end, double limit)
{
    if (curve.steps)
        return stepDeviation(curve, first, last, start);
    return curve.path == AnimationPath::rotation ? rotationDeviation(curve, first, last, start, end, limit)
                                                 : vectorDeviation(curve, first, last, start, end, limit);
}

double constantDeviation(const AnimationTables& tables, const AnimationChannelRecord& channel,
                         const KeyValue& value)
{
    const auto path = static_cast<AnimationPath>(channel.path);
    if (path == AnimationPath::rotation)
    {
        animation_bounds::RotationPoints points;
        animation_bounds::addRotations(tables, channel, points);
        double worst = points.unbounded ? kUnknown : 0;
        for (const Quaternion& point : points.points)
            worst = std::max(worst, distance(path, normalizedOrNone(point), value));
        return worst <= kNearChord ? worst : kUnknown;
    }
    const animation_bounds::Box3d box = channelBox(tables, channel);
    KeyValue farthest{};
    for (size_t i = 0; i < 3; ++i)
        farthest[i] = std::max(box[i].high - value[i], value[i] - box[i].low);
    return distance(path, farthest, {});
}

KeyValue middleValue(const AnimationTables& tables, const AnimationChannelRecord& channel)
{
    if (static_cast<AnimationPath>(channel.path) == AnimationPath::rotation)
        return ChannelKeys(tables.keys, tables.key_bits, channel).value(0, 0, 4);
    const animation_bounds::Box3d box = channelBox(tables, channel);
    KeyValue middle{};
    for (size_t i = 0; i < 3; ++i)
        middle[i] = double{static_cast<float>(box[i].middle())};
    return middle;
}

} // namespace hearth::animation_compression

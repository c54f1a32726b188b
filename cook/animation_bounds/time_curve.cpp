// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/animation_bounds/time_curve.h"

#include "cook/animation_bounds/quaternion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace hearth::animation_bounds
{

using namespace formats;

namespace
{

// Number of parts of a spline between two keys, half of them on either side of the span's middle: the slack
// of a chord is 1/64 of the slack of the whole.
constexpr uint32_t kSplineParts = 8;

// Rounding error of a value, as a share of its length.
constexpr double kCurveRounding = 1e-13;

constexpr double kUnknown = std::numeric_limits<double>::infinity();

ChannelValue addScaled(const ChannelValue& a, const ChannelValue& b, double factor)
{
    return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2], a[3] + factor * b[3]};
}

/// Smooth part of the curve between two of the span's parameters.
struct Piece
{
    double from = -1;
    double to = 1;
    ChannelValue start;
    ChannelValue end;
    ChannelValue second{};   ///< derivative over a parameter from 0 to 1
    double second_slack = 0; ///< maximum distance of the second derivative from `second`
    double chord_slack = 0;  ///< maximum distance of the curve from a curve with such a second derivative
};

/// Collects the pieces of a channel in a span.
class Pieces
{
public:
    Pieces(TimeSpan time, const CurveKeys& keys, bool is_rotation)
        : time_(time), keys_(keys), is_rotation_(is_rotation)
    {
        // include all of several keys at the very start: they are a jump
        uint32_t key = keys.time(0) >= time.from ? 0 : keys.keyBefore(time.from);
        if (keys.time(key) > time.from)
            addConstant(key, time.from, std::min(keys.time(key), time.to));
        for (; key < keys.count() &&
               (keys.time(key) < time.to || pieces_.empty() || (time.last && keys.time(key) <= time.to));
             ++key)
            addKey(key);
    }

    const std::vector<Piece>& all() const { return pieces_; }

    bool unknown() const { return unknown_; }

private:
    double parameter(double time) const
    {
        const double half = 0.5 * (time_.to - time_.from);
        return half > 0 ? std::clamp((time - time_.from) / half - 1, -1.0, 1.0) : -1;
    }

    void addKey(uint32_t key)
    {
        const double from = std::max(keys_.time(key), time_.from);
        const bool is_last = key + 1 == keys_.count();
        const double to = is_last ? time_.to : std::min(keys_.time(key + 1), time_.to);
        if (is_last || keys_.isStep() || !keys_.hasPiece(key))
        {
            addConstant(key, from, std::max(from, to));
            return;
        }
        const double middle = 0.5 * (time_.from + time_.to);
        if (from < middle && middle < to)
        {
            addInterval(key, from, middle);
            addInterval(key, middle, to);
        }
        else
            addInterval(key, from, to);
    }

    void addConstant(uint32_t key, double from, double to)
    {
        const ChannelValue value = is_rotation_ ? normalizedOrNone(keys_.at(key)) : keys_.at(key);
        add({parameter(from), parameter(to), value, value});
    }

    /// Add the part between two times of the curve from a key to the next one.
    void addInterval(uint32_t key, double from, double to)
    {
        const double start = keys_.time(key), seconds = keys_.time(key + 1) - start;
        const auto share = [&](double time) { return std::clamp((time - start) / seconds, 0.0, 1.0); };
        if (keys_.isSpline())
        {
            const BezierPiece spline = keys_.piece(key);
            for (uint32_t part = 0; part < kSplineParts; ++part)
            {
                const double a = from + (to - from) * part / kSplineParts;
                const double b = from + (to - from) * (part + 1) / kSplineParts;
                addSpline(clipped(spline, share(a), share(b)), parameter(a), parameter(b));
            }
        }
        else if (is_rotation_)
            addArc(normalizedOrNone(keys_.at(key)), normalizedOrNone(keys_.at(key + 1)), share(from),
                   share(to), {parameter(from), parameter(to), {}, {}});
        else
        {
            const ChannelValue a = keys_.at(key), delta = addScaled(keys_.at(key + 1), a, -1);
            add({parameter(from), parameter(to), addScaled(a, delta, share(from)),
                 addScaled(a, delta, share(to))});
        }
    }

    void addArc(const Quaternion& a, const Quaternion& b, double from, double to, Piece piece)
    {
        piece.start = slerp(a, b, from);
        piece.end = slerp(a, b, to);
        // at constant speed the second derivative is the position times the square of the angle, towards the
        // sphere's center
        const double angle = std::acos(std::min(1.0, std::abs(dot(a, b)))) * (to - from);
        piece.second = scaled(slerp(a, b, 0.5 * (from + to)), -angle * angle);
        piece.second_slack = 0.5 * angle * angle * angle;
        add(piece);
    }

    void addSpline(const BezierPiece& b, double from, double to)
    {
        ChannelValue second[2];
        for (size_t end = 0; end < 2; ++end)
            second[end] = scaled(addScaled(addScaled(b[end], b[end + 2], 1), b[end + 1], -2), 6);
        Piece piece{from, to, b[0], b[3]};
        if (!is_rotation_)
        {
            // the second derivative is linear between the ends
            piece.second = scaled(addScaled(second[0], second[1], 1), 0.5);
            piece.second_slack = 0.5 * length(addScaled(second[0], second[1], -1));
            add(piece);
            return;
        }
        // the cubic is near its chord; both, projected to the sphere, are near the chord between the
        // projected ends
        const double from_chord = std::max(length(second[0]), length(second[1])) / 8;
        const double lengths[2] = {length(b[0]), length(b[3])};
        const double shorter = std::min(lengths[0], lengths[1]), longer = std::max(lengths[0], lengths[1]);
        const double cosine = dot(b[0], b[3]) / (lengths[0] * lengths[1]);
        // minimum length on the chord, where the ends are less than a right angle apart: the triangle's
        // height
        const double least = shorter * std::sqrt(0.5 * (1 + cosine)) - from_chord;
        if (!(cosine > 0.5) || !(least > 0.2 * longer))
        {
            unknown_ = true;
            return;
        }
        piece.start = scaled(b[0], 1 / lengths[0]);
        piece.end = scaled(b[3], 1 / lengths[1]);
        const double chord = length(addScaled(piece.end, piece.start, -1));
        piece.chord_slack = from_chord / least +
                            // difference of the parameters along the chord, if the ends' lengths differ
                            chord * (longer - shorter) / (4 * shorter) +
                            // from the arc to its chord
                            1 - std::sqrt(std::max(0.0, 1 - 0.25 * chord * chord));
        add(piece);
    }

    /// Return the part of a piece between two parameters, 0 to 1.
    static BezierPiece clipped(const BezierPiece& b, double from, double to)
    {
        // blossom of a cubic at three parameters
        const auto blossom = [&](double r, double s, double t)
        {
            ChannelValue value;
            for (size_t i = 0; i < value.size(); ++i)
            {
                const double ab = std::lerp(b[0][i], b[1][i], r), bc = std::lerp(b[1][i], b[2][i], r),
                             cd = std::lerp(b[2][i], b[3][i], r);
                value[i] = std::lerp(std::lerp(ab, bc, s), std::lerp(bc, cd, s), t);
            }
            return value;
        };
        return {blossom(from, from, from), blossom(from, from, to), blossom(from, to, to),
                blossom(to, to, to)};
    }

    void add(Piece piece)
    {
        // q and -q are the same rotation: continue with the nearer one
        if (is_rotation_ && !pieces_.empty() && dot(pieces_.back().end, piece.start) < 0)
            for (ChannelValue* const value : {&piece.start, &piece.end, &piece.second})
                *value = scaled(*value, -1);
        pieces_.push_back(piece);
    }

    TimeSpan time_;
    const CurveKeys& keys_;
    bool is_rotation_;
    std::vector<Piece> pieces_;
    bool unknown_ = false;
};

double differenceAt(const std::array<ChannelValue, 3>& terms, double s, const ChannelValue& value)
{
    return length(addScaled(addScaled(addScaled(terms[0], terms[1], s), terms[2], s * s), value, -1));
}

/// Return an upper bound for the distance between the pieces and a quadratic.
double computeRemainder(const std::array<ChannelValue, 3>& terms, const std::vector<Piece>& pieces)
{
    double remainder = 0;
    for (const Piece& piece : pieces)
    {
        const double width = piece.to - piece.from;
        // between its ends a function deviates from its chord by at most an eighth of the second derivative
        const double bend =
            (length(addScaled(piece.second, terms[2], -2 * width * width)) + piece.second_slack) / 8;
        remainder = std::max(remainder, std::max(differenceAt(terms, piece.from, piece.start),
                                                 differenceAt(terms, piece.to, piece.end)) +
                                            bend + piece.chord_slack);
    }
    return remainder;
}

/// Return the quadratic that interpolates the first, the middle and the last value.
std::array<ChannelValue, 3> fitQuadratic(const std::vector<Piece>& pieces)
{
    const ChannelValue start = pieces.front().start, end = pieces.back().end;
    ChannelValue middle = start;
    for (const Piece& piece : pieces)
        if (piece.from <= 0 && piece.to >= 0)
            middle = piece.to > -piece.from ? piece.start : piece.end;
    const ChannelValue mean = scaled(addScaled(start, end, 1), 0.5);
    return {middle, scaled(addScaled(end, start, -1), 0.5), addScaled(mean, middle, -1)};
}

/// Return the middle of the values as a constant, for values that jump.
std::array<ChannelValue, 3> fitConstant(const std::vector<Piece>& pieces)
{
    ChannelValue low = pieces.front().start, high = low;
    for (const Piece& piece : pieces)
        for (const ChannelValue* const value : {&piece.start, &piece.end})
            for (size_t i = 0; i < low.size(); ++i)
            {
                low[i] = std::min(low[i], (*value)[i]);
                high[i] = std::max(high[i], (*value)[i]);
            }
    return {scaled(addScaled(low, high, 1), 0.5), {}, {}};
}

TimeCurve fitCurve(const Pieces& pieces)
{
    if (pieces.unknown())
        return {{ChannelValue{0, 0, 0, 1}}, kUnknown};
    const std::array<ChannelValue, 3> smooth = fitQuadratic(pieces.all()), still = fitConstant(pieces.all());
    const double of_smooth = computeRemainder(smooth, pieces.all());
    const double of_still = computeRemainder(still, pieces.all());
    TimeCurve curve{of_smooth <= of_still ? smooth : still, std::min(of_smooth, of_still)};
    curve.remainder += kCurveRounding * (length(curve.terms[0]) + length(curve.terms[1]) + curve.remainder);
    return curve;
}

} // namespace

TimeCurve constantCurve(const ChannelValue& value)
{
    return {{value}, kCurveRounding * length(value)};
}

TimeCurve fitVectorCurve(TimeSpan time, const AnimationTables& tables, const AnimationChannelRecord& channel)
{
    const CurveKeys vectors(tables, channel, 0, 3);
    return fitCurve(Pieces(time, vectors, false));
}

TimeCurve fitRotationCurve(TimeSpan time, const AnimationTables& tables,
                           const AnimationChannelRecord& channel)
{
    const CurveKeys rotations(tables, channel, 0, 4);
    return fitCurve(Pieces(time, rotations, true));
}

} // namespace hearth::animation_bounds

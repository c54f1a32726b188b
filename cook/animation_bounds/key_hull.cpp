// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/animation_bounds/key_hull.h"

#include "cook/animation_bounds/curve_keys.h"
#include "cook/animation_bounds/quaternion.h"

#include <algorithm>
#include <cmath>

namespace hearth::animation_bounds
{

using namespace formats;

namespace
{

// Subdivisions of a vector spline: control points of an eighth exceed its hull by less than 1/64 of the
// excess of the whole.
constexpr int kVectorHalvings = 3;

// Cosine between quaternions, of 0.1 rad: control points of a rotation's piece are this near to each other,
// if 2^10 pieces suffice.
constexpr double kNearCosine = 0.995;
constexpr int kMaxRotationHalvings = 10;

// Cosine below which a piece at the last subdivision may pass through 0.
constexpr double kConeCosine = 0.5;

ChannelValue mean(const ChannelValue& a, const ChannelValue& b)
{
    return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2]), 0.5 * (a[3] + b[3])};
}

/// Split a piece in halves (de Casteljau).
std::array<BezierPiece, 2> halves(const BezierPiece& b)
{
    const ChannelValue ab = mean(b[0], b[1]), bc = mean(b[1], b[2]), cd = mean(b[2], b[3]);
    const ChannelValue abc = mean(ab, bc), bcd = mean(bc, cd);
    const ChannelValue middle = mean(abc, bcd);
    return {BezierPiece{b[0], ab, abc, middle}, BezierPiece{middle, bcd, cd, b[3]}};
}

template <typename AddValue>
void addPiece(const BezierPiece& piece, int halvings, const AddValue& add)
{
    if (halvings == 0)
    {
        add(piece[1]);
        add(piece[2]);
        add(piece[3]);
        return;
    }
    for (const BezierPiece& half : halves(piece))
        addPiece(half, halvings - 1, add);
}

template <typename AddValue>
void addAll(const CurveKeys& keys, const AddValue& add)
{
    for (uint32_t key = 0; key < keys.count(); ++key)
    {
        add(keys.at(key));
        if (keys.hasSpline(key))
            addPiece(keys.piece(key), kVectorHalvings, add);
    }
}

/// Return the smallest cosine between two of the points; -1 where a point is 0.
double minCosine(const BezierPiece& piece)
{
    double least = 1;
    for (size_t i = 0; i < piece.size(); ++i)
        for (size_t j = i + 1; j < piece.size(); ++j)
        {
            const double lengths = length(piece[i]) * length(piece[j]);
            least = std::min(least, lengths > 1e-20 ? dot(piece[i], piece[j]) / lengths : -1.0);
        }
    return least;
}

void addRotationPiece(const BezierPiece& piece, int halvings, RotationPoints& points)
{
    const double cosine = minCosine(piece);
    if (cosine >= kNearCosine || (halvings == 0 && cosine > kConeCosine))
        points.points.insert(points.points.end(), piece.begin() + 1, piece.end());
    else if (halvings == 0)
        points.unbounded = true;
    else
        for (const BezierPiece& half : halves(piece))
            addRotationPiece(half, halvings - 1, points);
}

} // namespace

void addValues(const AnimationTables& tables, const AnimationChannelRecord& channel, Box3d& box)
{
    addAll(CurveKeys(tables, channel, 0, 3), [&](const ChannelValue& v) { add(box, {v[0], v[1], v[2]}); });
}

void addValues(const AnimationTables& tables, const AnimationChannelRecord& channel, uint32_t component,
               Interval& range)
{
    addAll(CurveKeys(tables, channel, component, 1), [&](const ChannelValue& v) { range.add(v[0]); });
}

void addRotations(const AnimationTables& tables, const AnimationChannelRecord& channel,
                  RotationPoints& points)
{
    const CurveKeys rotations(tables, channel, 0, 4);
    for (uint32_t key = 0; key < rotations.count() && !points.unbounded; ++key)
    {
        points.points.push_back(normalizedOrNone(rotations.at(key)));
        if (rotations.hasSpline(key))
            addRotationPiece(rotations.piece(key), kMaxRotationHalvings, points);
    }
}

} // namespace hearth::animation_bounds

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/motion/key_hull.h"

#include "cook/motion/quaternion.h"

#include <algorithm>
#include <cmath>

namespace hearth::motion
{

using namespace formats;

namespace
{

// Control points of the eighth of a spline leave its hull by less than 1/64 of what those of the whole do.
constexpr int kVectorHalvings = 3;

// Control points of a rotation's piece are this near to each other (cosine of 0.1 rad between quaternions), if 2^10
// pieces are enough for it.
constexpr double kNearCosine = 0.995;
constexpr int kMostRotationHalvings = 10;

// Below this cosine a piece that is not divided further may go through 0.
constexpr double kConeCosine = 0.5;

/// Four numbers of a channel's value.
using Value = std::array<double, 4>;
using BezierPiece = std::array<Value, 4>;

Value mean(const Value& a, const Value& b)
{
    return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2]), 0.5 * (a[3] + b[3])};
}

/// De Casteljau's halves.
std::array<BezierPiece, 2> halves(const BezierPiece& b)
{
    const Value ab = mean(b[0], b[1]), bc = mean(b[1], b[2]), cd = mean(b[2], b[3]);
    const Value abc = mean(ab, bc), bcd = mean(bc, cd);
    const Value middle = mean(abc, bcd);
    return {BezierPiece{b[0], ab, abc, middle}, BezierPiece{middle, bcd, cd, b[3]}};
}

/// A channel's keys, `count` components from `first` on.
class Keys
{
public:
    Keys(const AnimationChannelRecord& channel, std::span<const float> keys, uint32_t first, uint32_t count)
        : channel_(channel), keys_(keys), first_(first), count_(count)
    {
    }

    bool isSpline() const
    {
        return static_cast<Interpolation>(channel_.interpolation) == Interpolation::cubic_spline;
    }

    bool isStep() const { return static_cast<Interpolation>(channel_.interpolation) == Interpolation::step; }

    uint32_t count() const { return channel_.key_count; }

    double time(uint32_t key) const { return keys_[channel_.first_time + key]; }

    /// The last key that is not later than a time; the first where all are.
    uint32_t keyBefore(double time) const
    {
        const auto times = keys_.subspan(channel_.first_time, channel_.key_count);
        const auto later = std::upper_bound(times.begin(), times.end(), time,
                                            [](double t, float key) { return t < double{key}; });
        return later == times.begin() ? 0 : static_cast<uint32_t>(later - times.begin()) - 1;
    }

    Value at(uint32_t key) const { return isSpline() ? row(key * 3 + 1) : row(key); }

    /// Whether the value moves from the key to the next: not where the two are at one time.
    bool hasPiece(uint32_t key) const { return key + 1 < count() && time(key + 1) > time(key); }
    bool hasSpline(uint32_t key) const { return isSpline() && hasPiece(key); }

    /// The spline from a key to the next.
    BezierPiece piece(uint32_t key) const
    {
        const double third = (time(key + 1) - time(key)) / 3;
        const Value start = at(key), out = row(key * 3 + 2), in = row(key * 3 + 3), end = at(key + 1);
        BezierPiece bezier{start, start, end, end};
        for (size_t i = 0; i < count_; ++i)
        {
            bezier[1][i] += third * out[i];
            bezier[2][i] -= third * in[i];
        }
        return bezier;
    }

private:
    Value row(size_t row) const
    {
        Value value{};
        for (size_t i = 0; i < count_; ++i)
            value[i] = keys_[channel_.first_value + row * channel_.components + first_ + i];
        return value;
    }

    const AnimationChannelRecord& channel_;
    std::span<const float> keys_;
    uint32_t first_;
    uint32_t count_;
};

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
void addAll(const Keys& keys, const AddValue& add)
{
    for (uint32_t key = 0; key < keys.count(); ++key)
    {
        add(keys.at(key));
        if (keys.hasSpline(key))
            addPiece(keys.piece(key), kVectorHalvings, add);
    }
}

/// The least cosine between two of the points; -1 where one is 0.
double leastCosine(const BezierPiece& piece)
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
    const double cosine = leastCosine(piece);
    if (cosine >= kNearCosine || (halvings == 0 && cosine > kConeCosine))
        points.points.insert(points.points.end(), piece.begin() + 1, piece.end());
    else if (halvings == 0)
        points.unbounded = true;
    else
        for (const BezierPiece& half : halves(piece))
            addRotationPiece(half, halvings - 1, points);
}

/// What is left of a piece between two of its parameters, 0 to 1.
BezierPiece clipped(const BezierPiece& b, double from, double to)
{
    // the blossom of a cubic at three parameters
    const auto blossom = [&](double r, double s, double t)
    {
        Value value;
        for (size_t i = 0; i < value.size(); ++i)
        {
            const auto mix = [](double a, double c, double at) { return a + (c - a) * at; };
            const double ab = mix(b[0][i], b[1][i], r), bc = mix(b[1][i], b[2][i], r),
                         cd = mix(b[2][i], b[3][i], r);
            value[i] = mix(mix(ab, bc, s), mix(bc, cd, s), t);
        }
        return value;
    };
    return {blossom(from, from, from), blossom(from, from, to), blossom(from, to, to), blossom(to, to, to)};
}

/// Hand on the keys of a time span, and what is left in it of the ways between keys: (key, from, to), as shares.
template <typename AddKey, typename AddWay>
void visit(TimeSpan time, const Keys& keys, const AddKey& add_key, const AddWay& add_way)
{
    const uint32_t first = keys.keyBefore(time.from);
    for (uint32_t key = first; key < keys.count() && (key == first || keys.time(key) <= time.to); ++key)
    {
        const bool is_last = key + 1 == keys.count();
        if (keys.isStep() || is_last || keys.time(key) >= time.from)
            add_key(key);
        if (keys.isStep() || !keys.hasPiece(key))
            continue;
        const double seconds = keys.time(key + 1) - keys.time(key);
        const double from = std::clamp((time.from - keys.time(key)) / seconds, 0.0, 1.0);
        const double to = std::clamp((time.to - keys.time(key)) / seconds, 0.0, 1.0);
        add_way(key, from, to);
    }
}

} // namespace

void addValuesIn(TimeSpan time, const AnimationChannelRecord& channel, std::span<const float> keys,
                 Box3d& box)
{
    const Keys values(channel, keys, 0, 3);
    const auto add_value = [&](const Value& v) { add(box, {v[0], v[1], v[2]}); };
    visit(
        time, values, [&](uint32_t key) { add_value(values.at(key)); },
        [&](uint32_t key, double from, double to)
        {
            if (values.isSpline())
                for (const Value& point : clipped(values.piece(key), from, to))
                    add_value(point);
            else
                for (const double at : {from, to})
                {
                    const Value a = values.at(key), b = values.at(key + 1);
                    add_value(
                        {a[0] + (b[0] - a[0]) * at, a[1] + (b[1] - a[1]) * at, a[2] + (b[2] - a[2]) * at, 0});
                }
        });
}

void addRotationsIn(TimeSpan time, const AnimationChannelRecord& channel, std::span<const float> keys,
                    RotationPoints& points)
{
    const Keys rotations(channel, keys, 0, 4);
    visit(
        time, rotations, [&](uint32_t key) { points.points.push_back(normalizedOrNone(rotations.at(key))); },
        [&](uint32_t key, double from, double to)
        {
            if (!rotations.isSpline())
            {
                const Quaternion a = normalizedOrNone(rotations.at(key));
                const Quaternion b = normalizedOrNone(rotations.at(key + 1));
                points.points.push_back(slerp(a, b, from));
                points.points.push_back(slerp(a, b, to));
                return;
            }
            const BezierPiece piece = clipped(rotations.piece(key), from, to);
            points.unbounded = points.unbounded || leastCosine(piece) <= kConeCosine;
            points.points.insert(points.points.end(), piece.begin(), piece.end());
        });
}

void addValues(const AnimationChannelRecord& channel, std::span<const float> keys, Box3d& box)
{
    addAll(Keys(channel, keys, 0, 3), [&](const Value& v) { add(box, {v[0], v[1], v[2]}); });
}

void addValues(const AnimationChannelRecord& channel, std::span<const float> keys, uint32_t component,
               Interval& range)
{
    addAll(Keys(channel, keys, component, 1), [&](const Value& v) { range.add(v[0]); });
}

void addRotations(const AnimationChannelRecord& channel, std::span<const float> keys, RotationPoints& points)
{
    const Keys rotations(channel, keys, 0, 4);
    for (uint32_t key = 0; key < rotations.count() && !points.unbounded; ++key)
    {
        points.points.push_back(normalizedOrNone(rotations.at(key)));
        if (rotations.hasSpline(key))
            addRotationPiece(rotations.piece(key), kMostRotationHalvings, points);
    }
}

} // namespace hearth::motion

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/animation_bounds/node_motion.h"

#include "cook/animation_bounds/quaternion.h"
#include "cook/animation_bounds/symmetric.h"
#include "formats/base/assert.h"

#include <algorithm>
#include <cmath>

namespace hearth::animation_bounds
{

using namespace formats;

namespace
{

// Share of the node's largest scale below which a scale counts as 0.
constexpr double kMinScale = 1e-5;

// Relative margin for single precision in the tables and in a runtime's sampling: a few roundings.
constexpr double kRoundingMargin = 1e-7;

/// Points on an axis whose convex hull, up to `slack`, is an interval: one point if the interval is short
/// enough.
struct IntervalPoints
{
    std::array<double, 2> values{};
    size_t count = 1;
    double slack = 0;
};

IntervalPoints intervalPoints(const Interval& interval, double tolerance)
{
    if (interval.half() <= tolerance)
        return {{interval.middle(), 0}, 1, interval.half()};
    return {{interval.low, interval.high}, 2, 0};
}

/// Corners of a box. Axes shorter than the tolerance are replaced by their middle.
struct Corners
{
    std::vector<Double3> points;
    Double3 slack;
};

Corners boxCorners(const Box3d& box, double tolerance)
{
    const IntervalPoints x = intervalPoints(box[0], tolerance), y = intervalPoints(box[1], tolerance),
                         z = intervalPoints(box[2], tolerance);
    Corners corners{{}, {x.slack, y.slack, z.slack}};
    for (size_t i = 0; i < x.count; ++i)
        for (size_t j = 0; j < y.count; ++j)
            for (size_t k = 0; k < z.count; ++k)
                corners.points.push_back({x.values[i], y.values[j], z.values[k]});
    return corners;
}

size_t cornerCount(const Box3d& box, double tolerance)
{
    return intervalPoints(box[0], tolerance).count * intervalPoints(box[1], tolerance).count *
           intervalPoints(box[2], tolerance).count;
}

double largest(Double3 v)
{
    return std::max({v.x, v.y, v.z});
}

double magnitude(const Box3d& box)
{
    return std::max({box[0].magnitude(), box[1].magnitude(), box[2].magnitude()});
}

Box3d reciprocals(const Box3d& box)
{
    Box3d result;
    for (size_t i = 0; i < 3; ++i)
        result[i] = {1 / box[i].high, 1 / box[i].low};
    return result;
}

double hullNorm(std::span<const Matrix3> matrices)
{
    double norm = 0;
    for (const Matrix3& matrix : matrices)
        norm = std::max(norm, operatorNorm(matrix));
    return norm;
}

/// Return the tolerance of the rotation: half of the linear tolerance if scales move, too, else all of it.
double rotationTolerance(const NodeMotion& motion, Tolerance tolerance, double scale)
{
    const bool scales_move = largest(half(motion.scales)) > kRoundingMargin * 10 * magnitude(motion.scales);
    return tolerance.linear * (scales_move ? 0.5 : 1.0) / std::max(scale, 1e-30);
}

void grow(Box3d& box)
{
    for (Interval& axis : box)
        axis.grow(kRoundingMargin * axis.magnitude());
}

/// Values of all channels of a node, before they are combined.
struct ChannelBounds
{
    Box3d translations;
    Box3d scales;
    RotationPoints rotations;
};

ChannelBounds boundsFromRestPose(const NodeRecord& node)
{
    ChannelBounds channel_bounds;
    add(channel_bounds.translations, widen(node.translation));
    add(channel_bounds.scales, widen(node.scale));
    const Quaternion rotation{node.rotation.x, node.rotation.y, node.rotation.z, node.rotation.w};
    channel_bounds.rotations.points.push_back(normalizedOrNone(rotation));
    return channel_bounds;
}

void addChannel(const AnimationTables& tables, const AnimationChannelRecord& channel,
                ChannelBounds& channel_bounds)
{
    switch (static_cast<AnimationPath>(channel.path))
    {
    case AnimationPath::translation:
        addValues(tables, channel, channel_bounds.translations);
        break;
    case AnimationPath::rotation:
        addRotations(tables, channel, channel_bounds.rotations);
        break;
    case AnimationPath::scale:
        addValues(tables, channel, channel_bounds.scales);
        break;
    default:
        break;
    }
}

} // namespace

bool NodeMotion::canBeSingular() const
{
    if (fixed)
    {
        const std::optional<Affine3d> inverse = inverted(*fixed);
        return !inverse || operatorNorm(*fixed) * operatorNorm(*inverse) > 1 / kMinScale;
    }
    const double least = kMinScale * magnitude(scales);
    return std::any_of(scales.begin(), scales.end(),
                       [&](const Interval& axis) { return axis.low <= least && axis.high >= -least; });
}

bool NodeMotion::canMirror() const
{
    if (fixed)
    {
        const Affine3d& t = *fixed;
        const Double3 x{t.m[0][0], t.m[1][0], t.m[2][0]};
        const Double3 y{t.m[0][1], t.m[1][1], t.m[2][1]};
        const Double3 z{t.m[0][2], t.m[1][2], t.m[2][2]};
        return !(dot(cross(x, y), z) > 0);
    }
    return std::any_of(scales.begin(), scales.end(), [](const Interval& axis) { return axis.low <= 0; });
}

double NodeMotion::norm() const
{
    return fixed ? operatorNorm(*fixed) : magnitude(scales);
}

double NodeMotion::inverseNorm() const
{
    HEARTH_ASSERT(!canBeSingular());
    return fixed ? operatorNorm(*inverted(*fixed)) : magnitude(reciprocals(scales));
}

std::vector<NodeMotion> nodeMotions(const AnimationTables& tables)
{
    std::vector<ChannelBounds> channel_bounds;
    channel_bounds.reserve(tables.nodes.size());
    for (const NodeRecord& node : tables.nodes)
        channel_bounds.push_back(boundsFromRestPose(node));
    for (const AnimationRecord& animation : tables.animations)
        for (const AnimationChannelRecord& channel :
             tables.channels.subspan(animation.channels.first, animation.channels.count))
            addChannel(tables, channel, channel_bounds[channel.target]);
    std::vector<NodeMotion> motions;
    motions.reserve(tables.nodes.size());
    for (size_t i = 0; i < tables.nodes.size(); ++i)
    {
        grow(channel_bounds[i].translations);
        grow(channel_bounds[i].scales);
        NodeMotion motion{channel_bounds[i].translations, RotationSet::around(channel_bounds[i].rotations),
                          channel_bounds[i].scales, std::nullopt};
        if (tables.nodes[i].has_trs == 0)
            motion.fixed = widened(tables.nodes[i].parent_from_node);
        motions.push_back(std::move(motion));
    }
    return motions;
}

MatrixSet parentFromNode(const NodeMotion& motion, Tolerance tolerance)
{
    if (motion.fixed)
        return singletonSet(*motion.fixed);
    const double scale = motion.norm();
    const RotationHull rotations = motion.rotations.hull(rotationTolerance(motion, tolerance, scale));
    const Corners scales = boxCorners(motion.scales, 0.5 * tolerance.linear);
    const Corners translations = boxCorners(motion.translations, tolerance.shift);
    MatrixSet set;
    for (const Matrix3& r : rotations.matrices)
        for (const Double3 s : scales.points)
            for (const Double3 t : translations.points)
                set.hull.push_back({{{r[0][0] * s.x, r[0][1] * s.y, r[0][2] * s.z, t.x},
                                     {r[1][0] * s.x, r[1][1] * s.y, r[1][2] * s.z, t.y},
                                     {r[2][0] * s.x, r[2][1] * s.y, r[2][2] * s.z, t.z}}});
    const double rotation_norm = hullNorm(rotations.matrices);
    set.norm = scale;
    set.hull_norm = rotation_norm * scale;
    set.linear_slack = rotations.slack * scale + rotation_norm * largest(scales.slack);
    set.point_slack = length(translations.slack);
    return set;
}

MatrixSet nodeFromParent(const NodeMotion& motion, Tolerance tolerance)
{
    HEARTH_ASSERT(!motion.canBeSingular());
    if (motion.fixed)
        return singletonSet(*inverted(*motion.fixed));
    const double scale = motion.inverseNorm();
    const RotationHull rotations = motion.rotations.hull(rotationTolerance(motion, tolerance, scale));
    const Corners scales = boxCorners(reciprocals(motion.scales), 0.5 * tolerance.linear);
    const Corners translations = boxCorners(motion.translations, tolerance.shift);
    MatrixSet set;
    for (const Matrix3& r : rotations.matrices)
        for (const Double3 s : scales.points)
            for (const Double3 t : translations.points)
            {
                // the inverse of a rotation matrix is its transpose
                Affine3d inverse{{{r[0][0] * s.x, r[1][0] * s.x, r[2][0] * s.x, 0},
                                  {r[0][1] * s.y, r[1][1] * s.y, r[2][1] * s.y, 0},
                                  {r[0][2] * s.z, r[1][2] * s.z, r[2][2] * s.z, 0}}};
                const Double3 shift = transformVector(inverse, t);
                inverse.m[0][3] = -shift.x;
                inverse.m[1][3] = -shift.y;
                inverse.m[2][3] = -shift.z;
                set.hull.push_back(inverse);
            }
    const double rotation_norm = hullNorm(rotations.matrices);
    set.norm = scale;
    set.hull_norm = rotation_norm * scale;
    set.pivot = middle(motion.translations);
    set.linear_slack = rotations.slack * scale + rotation_norm * largest(scales.slack);
    // the translation can be as far from the pivot as half its box is large
    set.point_slack =
        set.linear_slack * length(half(motion.translations)) + scale * length(translations.slack);
    return set;
}

double hullSize(const NodeMotion& motion, Tolerance tolerance)
{
    if (motion.fixed)
        return 1;
    const double scale = std::max(motion.norm(), motion.canBeSingular() ? 0.0 : motion.inverseNorm());
    const size_t translations = cornerCount(motion.translations, tolerance.shift);
    const size_t scales = std::max(
        cornerCount(motion.scales, 0.5 * tolerance.linear),
        motion.canBeSingular() ? size_t{1} : cornerCount(reciprocals(motion.scales), 0.5 * tolerance.linear));
    return motion.rotations.hullSize(rotationTolerance(motion, tolerance, scale)) *
           static_cast<double>(translations * scales);
}

std::vector<Interval> morphWeightRanges(const AnimationTables& tables, uint32_t node, size_t targets)
{
    std::vector<Interval> ranges(targets, Interval{0, 1});
    const Range rest = tables.nodes[node].morph_weights;
    for (uint32_t i = 0; i < std::min<size_t>(rest.count, targets); ++i)
        ranges[i].add(tables.morph_weights[rest.first + i]);
    for (const AnimationRecord& animation : tables.animations)
        for (const AnimationChannelRecord& channel :
             tables.channels.subspan(animation.channels.first, animation.channels.count))
            if (channel.target == node && static_cast<AnimationPath>(channel.path) == AnimationPath::weights)
                for (uint32_t i = 0; i < std::min<size_t>(channel.components, targets); ++i)
                    addValues(tables, channel, i, ranges[i]);
    for (Interval& range : ranges)
        range.grow(kRoundingMargin * range.magnitude());
    return ranges;
}

} // namespace hearth::animation_bounds

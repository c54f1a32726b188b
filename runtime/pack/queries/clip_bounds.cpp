// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/queries/clip_bounds.h"

#include "formats/base/rounding.h"
#include "formats/codecs/channel_keys.h"
#include "formats/scene/animation.h"
#include "runtime/pack/pose_player.h"
#include "runtime/pack/queries/rest_transforms.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hearth::pack
{

namespace
{

using formats::AnimationPath;
using formats::ChannelKeys;
using formats::Interpolation;
using formats::NodePose;
using formats::ScenePose;

// Short enough that what a limb sweeps between two samples is small beside it.
constexpr double kMaxStepSeconds = 1.0 / 30;
constexpr uint32_t kMaxSteps = 4096; ///< beyond the clip's keys

// Instances are placed by floats: far above their rounding.
constexpr double kSlack = 1e-6;

/// Largest distance of a node's own transform from that in the middle of a time span.
struct NodeRange
{
    double translation = 0;
    double turn = 0;  ///< of a unit vector, as a length: at most 2
    double scale = 0; ///< of an axis
};

double difference(Double3 a, Double3 b)
{
    return length(a - b);
}

double largestDifference(Double3 a, Double3 b)
{
    return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
}

/// Largest way of a unit vector on the arc between two rotations, from a rotation that lies on it.
double turnBetween(const formats::Quaternion& from, const formats::Quaternion& middle,
                   const formats::Quaternion& to)
{
    const auto product = [](const formats::Quaternion& a, const formats::Quaternion& b)
    { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]; };
    // an arc's farthest points are its ends, and half the angle has this cosine
    const double cosine = std::min(std::abs(product(from, middle)), std::abs(product(middle, to)));
    return 2 * std::sqrt(std::max(0.0, 1 - cosine * cosine));
}

/// Largest second derivative of a spline's vector between two keys.
double secondDerivative(const ChannelKeys& keys, uint32_t first)
{
    const double seconds = double{keys.time(first + 1)} - double{keys.time(first)};
    const auto start = keys.value(first, 0, 3), end = keys.value(first + 1, 0, 3);
    const auto out = keys.outTangent(first, 0, 3), in = keys.inTangent(first + 1, 0, 3);
    double at_start = 0, at_end = 0; // it is linear in between
    for (size_t i = 0; i < 3; ++i)
    {
        const double way = 6 * (end[i] - start[i]);
        at_start += std::pow((way - seconds * (4 * out[i] + 2 * in[i])) / (seconds * seconds), 2);
        at_end += std::pow((-way + seconds * (2 * out[i] + 4 * in[i])) / (seconds * seconds), 2);
    }
    return std::sqrt(std::max(at_start, at_end));
}

/// Clip that is swept span by span: no key lies within a span.
class ClipSweep
{
public:
    ClipSweep(const formats::PackView& pack, const formats::AnimationRecord& animation)
        : tables_(formats::animationTables(pack)),
          animation_(animation),
          begin_(formats::restPose(tables_)),
          middle_(begin_),
          end_(begin_),
          ranges_(tables_.nodes.size()),
          is_animated_(tables_.nodes.size())
    {
        for (const formats::AnimationChannelRecord& channel : channels())
            if (isOfNode(channel))
                is_animated_[channel.target] = true;
    }

    /// Return the bounds of all spans in order, without a last time after which nothing changes.
    std::vector<double> spanTimes() const
    {
        std::vector<double> keys{0};
        for (const formats::AnimationChannelRecord& channel : channels())
        {
            const ChannelKeys of_channel(tables_.keys, tables_.key_bits, channel);
            for (uint32_t k = 0; isOfNode(channel) && k < of_channel.count(); ++k)
                keys.push_back(double{of_channel.time(k)});
        }
        std::sort(keys.begin(), keys.end());
        keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
        const double step = std::max(kMaxStepSeconds, (keys.back() - keys.front()) / kMaxSteps);
        std::vector<double> times;
        for (size_t k = 0; k + 1 < keys.size(); ++k)
        {
            const double count = std::ceil((keys[k + 1] - keys[k]) / step);
            for (double i = 0; i < count; ++i)
                times.push_back(keys[k] + (keys[k + 1] - keys[k]) * (i / count));
        }
        times.push_back(keys.back());
        return times;
    }

    /// Go to a span; its end may be its begin.
    void goTo(double begin, double end)
    {
        formats::sampleAnimation(tables_, animation_, begin, begin_);
        formats::sampleAnimation(tables_, animation_, (begin + end) / 2, middle_);
        formats::sampleAnimation(tables_, animation_, end, end_);
        std::fill(ranges_.begin(), ranges_.end(), NodeRange{});
        for (const formats::AnimationChannelRecord& channel : channels())
            if (isOfNode(channel))
                widen(channel, begin, end);
    }

    /// Return true if the clip moves the node or one above it.
    bool moves(uint32_t node) const
    {
        for (; node != kInvalidIndex; node = tables_.nodes[node].parent)
            if (is_animated_[node])
                return true;
        return false;
    }

    /// Add the places of a point of a node's space in the span to a box in the world.
    void addPoint(uint32_t node, Double3 point, Box3& box) const
    {
        double reach = 0; // from `point`, which is the place in the middle
        for (uint32_t up = node; up != kInvalidIndex; up = tables_.nodes[up].parent)
        {
            const NodeRange& range = ranges_[up];
            const Affine3d transform = parentFromPosed(up);
            const double scale = largestScale(up);
            reach = range.translation + (scale + range.scale) * reach +
                    (range.turn * scale + range.scale) * length(point);
            point = transformPoint(transform, point);
        }
        reach += kSlack * (length(point) + reach);
        box.add(Float3{roundDown(point.x - reach), roundDown(point.y - reach), roundDown(point.z - reach)});
        box.add(Float3{roundUp(point.x + reach), roundUp(point.y + reach), roundUp(point.z + reach)});
    }

private:
    static bool isOfNode(const formats::AnimationChannelRecord& channel)
    {
        return channel.path <= static_cast<uint32_t>(AnimationPath::scale);
    }

    std::span<const formats::AnimationChannelRecord> channels() const
    {
        return recordsInRange(tables_.channels, animation_.channels);
    }

    Affine3d parentFromPosed(uint32_t node) const
    {
        const NodePose& pose = middle_.nodes[node];
        return tables_.nodes[node].has_trs != 0
                   ? makeAffineFromTrs(pose.translation, pose.rotation, pose.scale)
                   : widened(tables_.nodes[node].parent_from_node);
    }

    /// Return how much longer a vector gets in the parent, at most.
    double largestScale(uint32_t node) const
    {
        if (tables_.nodes[node].has_trs != 0)
        {
            const Double3 scale = middle_.nodes[node].scale;
            return std::max({std::abs(scale.x), std::abs(scale.y), std::abs(scale.z)});
        }
        double sum = 0;
        for (const auto& row : tables_.nodes[node].parent_from_node.m)
            for (int column = 0; column < 3; ++column)
                sum += double{row[column]} * double{row[column]};
        return std::sqrt(sum);
    }

    /// Widen a node's range by what a channel does within the span. A step comes at the begin of a span.
    void widen(const formats::AnimationChannelRecord& channel, double begin, double end)
    {
        const ChannelKeys keys(tables_.keys, tables_.key_bits, channel);
        if (keys.interpolation() == Interpolation::step)
            return;
        const bool is_spline = keys.interpolation() == Interpolation::cubic_spline;
        const uint32_t after = keys.firstKeyAfter(begin);
        const bool is_between = after > 0 && after < keys.count() && begin < end;
        // a curve is at most this far from its chord
        const double bend = is_spline && is_between && channel.components == 3
                                ? secondDerivative(keys, after - 1) * (end - begin) * (end - begin) / 8
                                : 0;
        const uint32_t node = channel.target;
        const NodePose &first = begin_.nodes[node], &middle = middle_.nodes[node], &last = end_.nodes[node];
        NodeRange& range = ranges_[node];
        switch (static_cast<AnimationPath>(channel.path))
        {
        case AnimationPath::translation:
            range.translation = bend + std::max(difference(first.translation, middle.translation),
                                                difference(last.translation, middle.translation));
            break;
        case AnimationPath::rotation:
            range.turn =
                is_spline && is_between ? 2 : turnBetween(first.rotation, middle.rotation, last.rotation);
            break;
        default:
            range.scale = bend + std::max(largestDifference(first.scale, middle.scale),
                                          largestDifference(last.scale, middle.scale));
            break;
        }
    }

    formats::AnimationTables tables_;
    const formats::AnimationRecord& animation_;
    ScenePose begin_, middle_, end_;
    std::vector<NodeRange> ranges_; ///< of each node, in the span
    std::vector<bool> is_animated_;
};

/// Box that a node carries.
struct CarriedBox
{
    uint32_t node;
    Affine3d node_from_box;
    Box3 box;
};

CarriedBox carriedBox(const formats::PackView& pack, uint32_t number)
{
    const formats::InstanceRecord& instance = pack.instances()[number];
    const formats::MeshRecord& mesh = pack.meshes()[instance.mesh];
    const formats::DeformedMeshRecord* const deformed = findDeformedMesh(pack, instance.mesh);
    if (deformed != nullptr && deformed->skin != kInvalidIndex)
    {
        const formats::SkinRecord& skin = pack.skins()[deformed->skin];
        const formats::JointRecord& anchor = pack.joints()[skin.joints.first + deformed->anchor];
        return {anchor.node, widened(anchor.joint_from_bind), {deformed->box_min, deformed->box_max}};
    }
    const Box3 box =
        deformed != nullptr ? Box3{deformed->box_min, deformed->box_max} : Box3{mesh.box_min, mesh.box_max};
    return {instance.node,
            formats::nodeFromObject(worldFromNode(pack.nodes(), instance.node), instance.world_from_object),
            box};
}

std::array<Double3, 8> corners(const CarriedBox& carried)
{
    std::array<Double3, 8> points;
    for (size_t i = 0; i < points.size(); ++i)
        points[i] = transformPoint(carried.node_from_box,
                                   widen(Float3{(i & 1) != 0 ? carried.box.max.x : carried.box.min.x,
                                                (i & 2) != 0 ? carried.box.max.y : carried.box.min.y,
                                                (i & 4) != 0 ? carried.box.max.z : carried.box.min.z}));
    return points;
}

} // namespace

Box3 clipBounds(const formats::PackView& pack, uint32_t animation, formats::Range instances)
{
    ClipSweep sweep(pack, pack.animations()[animation]);
    std::vector<CarriedBox> moving, resting;
    for (uint32_t i = instances.first; i < instances.first + instances.count; ++i)
        if (pack.meshes()[pack.instances()[i].mesh].clusters.count > 0)
        {
            const CarriedBox carried = carriedBox(pack, i);
            (sweep.moves(carried.node) ? moving : resting).push_back(carried);
        }
    Box3 box;
    sweep.goTo(0, 0);
    const auto add = [&](const CarriedBox& carried)
    {
        for (const Double3 corner : corners(carried))
            sweep.addPoint(carried.node, corner, box);
    };
    std::for_each(resting.begin(), resting.end(), add);
    const std::vector<double> times = sweep.spanTimes();
    for (size_t i = 0; i < times.size() && !moving.empty(); ++i)
    {
        sweep.goTo(times[i], times[std::min(i + 1, times.size() - 1)]);
        std::for_each(moving.begin(), moving.end(), add);
    }
    return box;
}

} // namespace hearth::pack

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/motion/pose_regions.h"

#include "cook/motion/quaternion.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace hearth::motion
{

using namespace formats;

namespace
{

// A clip is cut into at most so many spans, all clips together into about so many.
constexpr uint32_t kMostLeaves = 128;
constexpr uint32_t kLeavesOfAllClips = 2048;
constexpr uint32_t kLeastLeaves = 8;

// Blends are cut down to this share of the way between two clips.
constexpr double kLeastWeights = 1.0 / 64;

constexpr double kAnyRotation = std::numbers::pi / 2;
// Wider spans of rotations count as any rotation.
constexpr double kMostAngle = 0.78;
// What the arc cosine of rounded quaternions loses.
constexpr double kAngleMargin = 3e-8;

double angleBetween(const Quaternion& a, const Quaternion& b)
{
    return std::acos(std::min(1.0, std::abs(dot(a, b)))) + kAngleMargin;
}

void setRotations(NodeSpan& span, const RotationPoints& points)
{
    Quaternion sum{};
    for (const Quaternion& q : points.points)
    {
        const double factor = (dot(q, points.points.front()) < 0 ? -1 : 1) / length(q);
        for (size_t i = 0; i < 4; ++i)
            sum[i] += factor * q[i];
    }
    span.rotation = normalizedOrNone(sum);
    span.angle = points.unbounded ? kAnyRotation : 0;
    for (const Quaternion& q : points.points)
        span.angle = std::max(span.angle, angleBetween(span.rotation, scaled(q, 1 / length(q))));
    if (!(span.angle <= kMostAngle))
        span.angle = kAnyRotation;
}

void join(Box3d& box, const Box3d& other)
{
    for (size_t i = 0; i < 3; ++i)
    {
        box[i].add(other[i].low);
        box[i].add(other[i].high);
    }
}

NodeSpan joined(const NodeSpan& a, const NodeSpan& b)
{
    NodeSpan span = a;
    join(span.translations, b.translations);
    join(span.scales, b.scales);
    span.rotation = slerp(a.rotation, b.rotation, 0.5);
    span.angle = std::max(angleBetween(span.rotation, a.rotation) + a.angle,
                          angleBetween(span.rotation, b.rotation) + b.angle);
    if (!(span.angle <= kMostAngle))
        span.angle = kAnyRotation;
    return span;
}

/// The blend of two boxes with weights around a middle one.
Box3d blended(const Box3d& from, const Box3d& to, const PoseRegion& region)
{
    Box3d box;
    for (size_t i = 0; i < 3; ++i)
        for (const double weight : {region.low_weight, region.high_weight})
        {
            box[i].add((1 - weight) * from[i].low + weight * to[i].low);
            box[i].add((1 - weight) * from[i].high + weight * to[i].high);
        }
    return box;
}

double size(const NodeSpan& span)
{
    return 2 * span.angle +
           length(half(span.translations)) /
               (length(middle(span.translations)) + length(half(span.translations)) + 1e-30) +
           length(half(span.scales));
}

} // namespace

PoseRegions::PoseRegions(const MotionTables& tables, std::span<const NodeMotion> nodes) : nodes_(nodes)
{
    for (const NodePose& pose : restPose(tables).nodes)
    {
        NodeSpan span;
        add(span.translations, pose.translation);
        add(span.scales, pose.scale);
        setRotations(span, {{pose.rotation}, false});
        rest_.push_back(span);
    }
    clips_.push_back(restClip());
    for (const AnimationRecord& animation : tables.animations)
        clips_.push_back(clipOf(tables, animation));
}

PoseRegions::Clip PoseRegions::restClip() const
{
    Clip clip;
    clip.spans = rest_; // part 0 is not used
    clip.spans.insert(clip.spans.end(), rest_.begin(), rest_.end());
    return clip;
}

PoseRegions::Clip PoseRegions::clipOf(const MotionTables& tables, const AnimationRecord& animation) const
{
    Clip clip;
    const auto share = static_cast<uint32_t>(kLeavesOfAllClips / tables.animations.size());
    clip.leaves = std::bit_floor(std::clamp(share, kLeastLeaves, kMostLeaves));
    const size_t count = nodes_.size();
    clip.spans.resize(2 * clip.leaves * count);
    for (uint32_t leaf = 0; leaf < clip.leaves; ++leaf)
    {
        const double step = double{animation.duration} / clip.leaves;
        const TimeSpan time{leaf * step, (leaf + 1) * step};
        NodeSpan* const spans = &clip.spans[(clip.leaves + leaf) * count];
        std::copy(rest_.begin(), rest_.end(), spans);
        for (const AnimationChannelRecord& channel :
             tables.channels.subspan(animation.channels.first, animation.channels.count))
        {
            NodeSpan& span = spans[channel.node];
            RotationPoints rotations;
            switch (static_cast<AnimationPath>(channel.path))
            {
            case AnimationPath::translation:
                span.translations = {};
                addValuesIn(time, channel, tables.keys, span.translations);
                break;
            case AnimationPath::rotation:
                addRotationsIn(time, channel, tables.keys, rotations);
                setRotations(span, rotations);
                break;
            case AnimationPath::scale:
                span.scales = {};
                addValuesIn(time, channel, tables.keys, span.scales);
                break;
            case AnimationPath::weights:
                break;
            }
        }
    }
    for (uint32_t part = clip.leaves - 1; part > 0; --part)
        for (size_t node = 0; node < count; ++node)
            clip.spans[part * count + node] =
                joined(clip.spans[2 * part * count + node], clip.spans[(2 * part + 1) * count + node]);
    return clip;
}

std::vector<PoseRegion> PoseRegions::all() const
{
    std::vector<PoseRegion> regions;
    for (uint32_t from = 0; from < clips_.size(); ++from)
        for (uint32_t to = from; to < clips_.size(); ++to)
            regions.push_back({from, 1, to, 1, 0, 1});
    return regions;
}

PoseRegion PoseRegions::sample(size_t number) const
{
    // the plastic number's sequence, in four dimensions spread evenly (M. Roberts, 2018)
    const auto share = [&](double step)
    {
        const double at = 0.5 + step * static_cast<double>(number);
        return at - std::floor(at);
    };
    const auto leaf = [&](uint32_t clip, double at)
    { return clips_[clip].leaves + static_cast<uint32_t>(at * clips_[clip].leaves); };
    const auto count = static_cast<double>(clips_.size());
    const auto from = static_cast<uint32_t>(number % clips_.size());
    const auto to = static_cast<uint32_t>(share(0.856674884) * count);
    // half of them of one clip alone
    const double weight = number % 2 == 0 ? 0.0 : share(0.733891856);
    return {from, leaf(from, share(0.628706728)), to, leaf(to, share(0.538597197)), weight, weight};
}

double PoseRegions::motionIn(uint32_t clip, uint32_t part, std::span<const uint32_t> nodes) const
{
    double motion = 0;
    for (const uint32_t node : nodes)
        motion += size(span(clip, part, node));
    return motion;
}

std::optional<std::array<PoseRegion, 2>> PoseRegions::halves(const PoseRegion& region,
                                                             std::span<const uint32_t> nodes) const
{
    const double weights = region.high_weight - region.low_weight;
    const bool can_cut_from = region.from_span < clips_[region.from_clip].leaves && region.low_weight < 1;
    const bool can_cut_to = region.to_span < clips_[region.to_clip].leaves && region.high_weight > 0;
    double between = 0;
    for (const uint32_t node : nodes)
    {
        const NodeSpan& from = span(region.from_clip, region.from_span, node);
        const NodeSpan& to = span(region.to_clip, region.to_span, node);
        between += 2 * angleBetween(from.rotation, to.rotation);
    }
    const double of_from =
        can_cut_from ? motionIn(region.from_clip, region.from_span, nodes) * (1 - region.low_weight) : -1;
    const double of_to =
        can_cut_to ? motionIn(region.to_clip, region.to_span, nodes) * region.high_weight : -1;
    // around its middle the blend goes half of its way to either side
    const double of_weights = weights > kLeastWeights ? 0.5 * between * weights : -1;
    std::array<PoseRegion, 2> halves{region, region};
    if (of_from < 0 && of_to < 0 && of_weights < 0)
        return std::nullopt;
    if (of_weights >= of_from && of_weights >= of_to)
        halves[0].high_weight = halves[1].low_weight = 0.5 * (region.low_weight + region.high_weight);
    else if (of_from >= of_to)
    {
        halves[0].from_span = 2 * region.from_span;
        halves[1].from_span = 2 * region.from_span + 1;
    }
    else
    {
        halves[0].to_span = 2 * region.to_span;
        halves[1].to_span = 2 * region.to_span + 1;
    }
    return halves;
}

NodeSpan PoseRegions::spanOf(const PoseRegion& region, uint32_t node) const
{
    const NodeSpan& from = span(region.from_clip, region.from_span, node);
    const NodeSpan& to = span(region.to_clip, region.to_span, node);
    NodeSpan blend;
    blend.translations = blended(from.translations, to.translations, region);
    blend.scales = blended(from.scales, to.scales, region);
    blend.rotation = slerp(from.rotation, to.rotation, 0.5 * (region.low_weight + region.high_weight));
    // two arcs whose ends are near each other are nowhere farther apart than that over the cosine of half their length
    // (Jacobi fields of the sphere); then along the arc by half of the weights
    const double arc = angleBetween(from.rotation, to.rotation);
    const double longest = arc + from.angle + to.angle;
    if (longest < kAnyRotation - 0.02)
        blend.angle = std::max(from.angle, to.angle) / std::cos(0.5 * longest) +
                      0.5 * (region.high_weight - region.low_weight) * arc + kAngleMargin;
    else
        blend.angle = kAnyRotation;
    if (!(blend.angle <= kMostAngle))
        blend.angle = kAnyRotation;
    return blend;
}

} // namespace hearth::motion

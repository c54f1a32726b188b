// Divides the space of all poses into regions: two clips, a time span in each, and a range of blend weights.
// In a small region the motions of joints are correlated, which bounds of each joint by itself cannot
// express.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_bounds/node_motion.h"
#include "cook/animation_bounds/slerp_model.h"
#include "cook/animation_bounds/taylor_model.h"
#include "cook/animation_bounds/time_curve.h"

#include <memory>
#include <mutex>

namespace hearth::animation_bounds
{

/// Local transform of a node during a time span.
struct NodeSpan
{
    TimeCurve translation;
    TimeCurve rotation;
    TimeCurve scale;
};

/// Local transform of a node in a region of poses: x0 is the time in the first clip, x1 the time in the
/// second clip, x2 the weight, each from -1 to 1 over the region.
struct NodeModel
{
    VectorModel translation;
    TaylorModel<4> rotation; ///< of length 1 up to the remainder, with either sign
    VectorModel scale;
};

/// Region of poses: two time spans, as indices into the span trees of two clips, and weights of the second
/// clip.
struct PoseRegion
{
    uint32_t from_clip = 0;
    uint32_t from_span = 1;
    uint32_t to_clip = 0;
    uint32_t to_span = 1;
    double low_weight = 0;
    double high_weight = 1;

    Interval weights() const { return {low_weight, high_weight}; }
};

/// Binary subdivision of the space of all poses. Thread-safe.
class PoseRegions
{
public:
    /// Construct from a scene's motion.
    /// tables, nodes  must outlive this
    PoseRegions(const formats::AnimationTables& tables, std::span<const NodeMotion> nodes);

    /// Return regions that cover all poses: each clip, the rest pose as a further clip, and all blends of
    /// two.
    std::vector<PoseRegion> all() const;

    /// Return a smallest region. The results for different `number` are spread over all clips, times and
    /// weights.
    PoseRegion sample(size_t number) const;

    /// Split a region in two along the parameter with the most motion. Return nothing if the region cannot be
    /// split.
    /// nodes  nodes whose motion counts
    std::optional<std::array<PoseRegion, 2>> split(const PoseRegion& region,
                                                   std::span<const uint32_t> nodes) const;

    /// True if another region of the same clip contains all poses of this one: times and weights exchanged.
    bool isMirrored(const PoseRegion& region) const
    {
        if (region.from_clip != region.to_clip)
            return false;
        const TimeSpan& from = clips_[region.from_clip].times[region.from_span];
        const TimeSpan& to = clips_[region.to_clip].times[region.to_span];
        return from.from >= to.to && from.from > to.from;
    }

    /// Compute the local transform of a node over a region.
    /// weights  of the region
    void setNodeModel(const PoseRegion& region, uint32_t node, BlendWeights& weights, NodeModel& model) const;

    /// Return a pose of the node in the region, or near it: all nodes at the middle of the times and weights.
    formats::NodePose middlePose(const PoseRegion& region, uint32_t node) const;

    /// Return the time span of a node of a clip's span tree.
    TimeSpan timeSpan(uint32_t clip, uint32_t span) const { return clips_[clip].times[span]; }

    /// Return the transform of a node that has a matrix, nothing for other nodes.
    const std::optional<Affine3d>& fixed(uint32_t node) const { return nodes_[node].fixed; }

private:
    /// Curves of all nodes in one span, computed on first use.
    struct Part
    {
        std::once_flag once;
        std::vector<NodeSpan> spans; ///< by node
    };

    /// Binary tree of a clip's time spans: part 1 is the whole clip, part i is split into 2 i and 2 i + 1.
    /// Splits are at keys if there are any near the middle, because curves are smooth between keys.
    struct Clip
    {
        const formats::AnimationRecord* animation = nullptr; ///< null for the rest pose
        uint32_t leaves = 1;
        std::vector<TimeSpan> times;   ///< by part; entry 0 is not used
        std::unique_ptr<Part[]> parts; ///< by part
    };

    Clip makeClip(const formats::AnimationRecord& animation) const;
    std::vector<NodeSpan> computeSpans(const Clip& clip, uint32_t part) const;
    const NodeSpan& span(uint32_t clip, uint32_t part, uint32_t node) const;

    formats::AnimationTables tables_;
    std::span<const NodeMotion> nodes_;
    std::vector<NodeSpan> rest_;
    std::vector<Clip> clips_;
};

} // namespace hearth::animation_bounds

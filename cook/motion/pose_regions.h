// Parts of the space of all poses: two clips, a span of time in each, and a span of weights of their blend. In a small part
// joints move together, which sets of each joint's poses by itself do not know.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/motion/node_motion.h"

namespace hearth::motion
{

/// Where a node is in its parent for a while: around a middle.
struct NodeSpan
{
    Box3d translations;
    Box3d scales;
    formats::Quaternion rotation{0, 0, 0, 1}; ///< the middle, of length 1
    double angle = 0; ///< radians between quaternions: how far from the middle; a right angle: any rotation
};

/// Two spans of time, by their place in the trees of two clips, and the weights of the second in the blend.
struct PoseRegion
{
    uint32_t from_clip = 0;
    uint32_t from_span = 1;
    uint32_t to_clip = 0;
    uint32_t to_span = 1;
    double low_weight = 0;
    double high_weight = 1;
};

class PoseRegions
{
public:
    PoseRegions(const formats::MotionTables& tables, std::span<const NodeMotion> nodes);

    /// Regions that hold all poses together: the clips, the rest pose as one more, and all blends of two.
    std::vector<PoseRegion> all() const;

    /// A region as small as they get, each `number` another one, spread over all clips, times and weights.
    PoseRegion sample(size_t number) const;

    /// The two halves of a region, cut where it moves the most; nothing where it cannot be cut.
    /// nodes  those whose motion counts
    std::optional<std::array<PoseRegion, 2>> halves(const PoseRegion& region,
                                                    std::span<const uint32_t> nodes) const;

    /// What a node does in a region.
    NodeSpan spanOf(const PoseRegion& region, uint32_t node) const;

    /// Nodes with a matrix alone.
    const std::optional<Affine3d>& fixed(uint32_t node) const { return nodes_[node].fixed; }

private:
    /// Spans of the nodes in the dyadic parts of a clip's time: part 1 is all of it, 2 i and 2 i + 1 the halves of i.
    struct Clip
    {
        uint32_t leaves = 1;
        std::vector<NodeSpan> spans; ///< [part * node count + node]
    };

    Clip clipOf(const formats::MotionTables& tables, const formats::AnimationRecord& animation) const;
    Clip restClip() const;
    const NodeSpan& span(uint32_t clip, uint32_t part, uint32_t node) const
    {
        return clips_[clip].spans[part * nodes_.size() + node];
    }
    double motionIn(uint32_t clip, uint32_t part, std::span<const uint32_t> nodes) const;

    std::span<const NodeMotion> nodes_;
    std::vector<NodeSpan> rest_;
    std::vector<Clip> clips_;
};

} // namespace hearth::motion

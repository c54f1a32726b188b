// Parts of the space of all poses: two clips, a span of time in each, and a span of weights of their blend. In a small part
// joints move together, which sets of each joint's poses by itself do not know.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_bounds/node_motion.h"
#include "cook/animation_bounds/taylor_model.h"
#include "cook/animation_bounds/time_curve.h"

#include <memory>
#include <mutex>

namespace hearth::motion
{

/// Where a node is in its parent for a span of time.
struct NodeSpan
{
    TimeCurve translation;
    TimeCurve rotation;
    TimeCurve scale;
};

/// Where a node is in its parent in a region of poses: x0 is the time in the first clip, x1 that in the second, x2 the
/// weight, each from -1 to 1 over the region.
struct NodeModel
{
    VectorModel translation;
    TaylorModel<4> rotation; ///< of length 1 up to its remainder, up to its sign
    VectorModel scale;
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

/// Any number of threads may ask at once.
class PoseRegions
{
public:
    /// tables, nodes  outlive it
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
    NodeModel modelOf(const PoseRegion& region, uint32_t node) const;

    /// A pose of the node in the region, or near it: all nodes at the middle of the times and weights.
    formats::NodePose middleOf(const PoseRegion& region, uint32_t node) const;

    /// Of a part of a clip.
    TimeSpan timeOf(uint32_t clip, uint32_t span) const { return clips_[clip].times[span]; }

    /// Nodes with a matrix alone.
    const std::optional<Affine3d>& fixed(uint32_t node) const { return nodes_[node].fixed; }

private:
    /// Filled when it is asked for.
    struct Part
    {
        std::once_flag once;
        std::vector<NodeSpan> spans; ///< by node
    };

    /// A clip's time in parts: 1 is all of it, 2 i and 2 i + 1 what i is cut into. Cuts are at keys where there are any
    /// near the middle: between keys, curves are smooth.
    struct Clip
    {
        const formats::AnimationRecord* animation = nullptr; ///< null: the rest pose
        uint32_t leaves = 1;
        std::vector<TimeSpan> times;   ///< by part; 0 is not used
        std::unique_ptr<Part[]> parts; ///< as many
    };

    Clip clipOf(const formats::AnimationRecord& animation) const;
    std::vector<NodeSpan> spansOf(const Clip& clip, uint32_t part) const;
    const NodeSpan& span(uint32_t clip, uint32_t part, uint32_t node) const;

    formats::MotionTables tables_;
    std::span<const NodeMotion> nodes_;
    std::vector<NodeSpan> rest_;
    std::vector<Clip> clips_;
};

} // namespace hearth::motion

// Which shadow maps still show what they would show if they were drawn anew: bit for bit, whatever moved, streamed in or
// was looked at since. Plain data, no Vulkan. See runtime/gpu/README.md, "Shadows".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "runtime/frame/shadow_cull.h"
#include "runtime/gpu/scene/instance_motion.h"
#include "runtime/gpu/scene/shadow_plan.h"
#include "runtime/pack/resident_groups.h"

#include <optional>
#include <span>
#include <vector>

namespace hearth::gpu
{

/// Belongs to a scene. For each frame: publish and move, in any order, then plan.
class ShadowCache
{
public:
    /// With moving layers, map i has layer i for what rests, and layer i + options.max_maps for all, where anything moves.
    ///
    /// pack  outlives the cache where anything is published
    ShadowCache(const formats::PackView& pack, const ShadowOptions& options);

    /// Instances that have new transforms from this frame on.
    void move(std::span<const InstanceMove> moves);

    /// A deformed instance that has a new pose from this frame on.
    void pose(const DeformedInstance& instance, const PosedRows& rows);

    /// Groups that came or went with this frame.
    void publish(std::span<const pack::ResidentGroups::Change> groups);

    /// A layer that must be drawn, and what finds its casters.
    struct StaleMap
    {
        uint32_t map = 0; ///< of the plan
        uint32_t layer = 0;
        std::optional<uint32_t> over; ///< a copy of this layer
        shared::FrameView casters{};
    };

    /// Those that must be drawn, in this order, so that every map of the plan can be used; they count as drawn from now on.
    /// Valid until the next call.
    ///
    /// plan  gets the layers that its maps are looked up in
    /// view  of the picture
    std::span<const StaleMap> plan(ShadowPlan& plan, const shared::FrameView& view);

    /// Everything must be drawn anew.
    void forget();

private:
    /// All that decides what a map shows, but for what moves and streams.
    struct Layer
    {
        bool drawn = false;        ///< all casters, or with moving layers those that rest
        bool moving_drawn = false; ///< over them, those that move
        shared::ShadowLight light{};
        shared::ShadowMap map{};
        shared::FrameView casters{};
    };

    void place(uint32_t instance, const Box3& box, float scale);
    void touch(const Box3& box, bool moves);
    void touchFiner(size_t instance, float error_object);
    bool isMoverIn(const shared::FrameView& casters) const;
    void planMoving(uint32_t map, const shared::FrameView& casters, Layer& layer, ShadowPlan& plan);

    const formats::PackView& pack_;
    /// Object space, or where the anchor of a deformed mesh carries it: its clusters and the spheres of its groups.
    std::vector<Box3> reach_of_mesh_;
    std::vector<uint32_t> mesh_of_instance_;
    std::vector<float> scale_of_instance_;
    std::vector<Box3> box_of_instance_;  ///< world
    std::vector<float> changed_of_mesh_; ///< the largest error of a group that came or went; scratch
    std::vector<uint8_t> moves_;         ///< for each instance, 1 where it has moved, with moving layers
    std::vector<uint32_t> movers_;
    bool moving_layers_;
    std::vector<Layer> layers_;
    std::vector<StaleMap> stale_;
};

} // namespace hearth::gpu

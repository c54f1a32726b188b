// Shadow map cache: finds the maps whose content would be the same, bit for bit, if they were drawn again.
// Handles moves, streaming and camera changes. Plain data, no Vulkan. See runtime/gpu/README.md, "Shadows".
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

/// Cache of one scene's maps. For each frame: publish and move, in any order, then plan.
class ShadowCache
{
public:
    /// With moving layers, a map that has layer i for resting casters has layer i + options.max_maps for all
    /// casters if any of them moves.
    ///
    /// pack  outlives the cache if publish is called
    /// reaches  VertexMotions::reaches
    ShadowCache(const formats::PackView& pack, const ShadowOptions& options,
                std::span<const float> reaches = {});

    /// Set instances that have new transforms from this frame on.
    void move(std::span<const InstanceMove> moves);

    /// Set a deformed instance that has a new pose from this frame on.
    void pose(const DeformedInstance& instance, const PoseRows& rows);

    /// Set instances whose vertices have moved, by motions of their materials, from this frame on.
    void disturb(std::span<const uint32_t> instances);

    /// Set groups that became resident or were evicted with this frame.
    void publish(std::span<const pack::ResidentGroups::Change> groups);

    /// Layer that must be drawn, and the view that culls its casters.
    struct LayerUpdate
    {
        uint32_t map = 0; ///< index in the plan
        uint32_t layer = 0;
        std::optional<uint32_t> copy_from; ///< starts as a copy of this layer
        shared::FrameView casters{};
    };

    /// Return the layers that must be drawn, in this order, so that every map of the plan is valid; they
    /// count as drawn from now on. Valid until the next call. A map whose content is in a layer keeps it,
    /// whatever its row and its place in the plan, and after frames without it, too; others get the layers
    /// that have not been used for longest.
    ///
    /// plan  gets the layer of each map
    /// view  of the frame
    std::span<const LayerUpdate> plan(ShadowPlan& plan, const shared::FrameView& view);

    /// Invalidate all maps.
    void forget();

private:
    /// Everything that decides the content of a map, except moves and streaming.
    struct Layer
    {
        bool drawn = false;        ///< has all casters, or with moving layers the resting ones
        bool moving_drawn = false; ///< has the moving casters on top of the resting ones
        shared::ShadowLight light{};
        shared::ShadowMap map{};
        shared::FrameView casters{};
        uint64_t last_use = 0; ///< number of the plan that had it last
    };
    static bool hasSameContent(const Layer& layer, const Layer& other);

    Layer makeLayer(const ShadowPlan& plan, uint32_t map, const shared::FrameView& view) const;
    void claimLayers(ShadowPlan& plan, std::span<const Layer> wanted);
    void place(uint32_t instance, const Box3& box, float scale);
    void invalidate(const Box3& box, bool moves);
    void invalidateFiner(size_t instance, float error_object);
    bool hasMoverIn(const shared::FrameView& casters) const;
    void planMoving(uint32_t map, const shared::FrameView& casters, Layer& layer, ShadowPlan& plan);

    const formats::PackView& pack_;
    std::vector<Box3> proxy_boxes_; ///< per mesh; empty if it casts its own shadow
    /// Per mesh: bounds of its clusters and of the spheres of its groups, or of the proxy that casts its
    /// shadow, in object space or in the space of a deformed mesh's anchor.
    std::vector<Box3> mesh_bounds_;
    std::vector<uint32_t> mesh_of_instance_;
    std::vector<float> instance_scales_;
    std::vector<Box3> instance_bounds_; ///< world
    std::vector<float> changed_errors_; ///< the largest error of a changed group; scratch
    std::vector<uint8_t> has_moved_;    ///< per instance: 1 if it has moved, with moving layers
    std::vector<uint32_t> movers_;
    bool moving_layers_;
    bool follows_eye_ = false; ///< clusters cast, by the levels that the eye sees
    std::vector<Layer> layers_;
    std::vector<Layer> wanted_; ///< by the maps of a plan; scratch
    std::vector<LayerUpdate> stale_;
    uint64_t plans_ = 0; ///< made so far
};

} // namespace hearth::gpu

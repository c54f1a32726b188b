// Lists lights on the device: those of the frame, and those of the cells of its light grid, the tiles of its
// image or the slots of its visible list. runtime/frame/light_lists.h has the same of cells on the CPU.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/passes/frame_targets.h"
#include "runtime/gpu/scene/scene.h"

#include <array>
#include <map>

namespace hearth::gpu
{

class LightListsPass
{
public:
    static Result<LightListsPass> create(const Device& device, const DrawLayouts& layouts);

    /// Create what a scene needs beside, if its frames list the lights of such areas.
    Status prepare(const Device& device, const DrawLayouts& layouts, Scene& scene, LightAreas areas);

    /// Record in FrameStep::light_lists, for a frame that lists its lights on the device
    /// (SceneLights::listsOnDevice): its lights, and those of LightAreas::cells.
    void record(const Device& device, VkCommandBuffer commands, const Scene& scene, LightAreas areas) const;

    /// Record in FrameStep::slot_lights, for LightAreas::slots.
    void recordSlots(const Device& device, VkCommandBuffer commands, const Scene& scene) const;

    /// Record in FrameStep::visible_lights, for areas that needPixels.
    void recordVisible(const Device& device, VkCommandBuffer commands, const Scene& scene,
                       const FrameTargets& targets, LightAreas areas) const;

private:
    /// Values of shared::kConstantUsedSlices, kConstantDeformed and kConstantLightList.
    using MarkVariant = std::array<uint32_t, 3>;
    static MarkVariant markVariant(const Scene& scene, LightAreas areas);
    Status prepareSlots(const Device& device, const DrawLayouts& layouts, Scene& scene);

    ComputePipeline list_lights_, cell_lights_, place_lists_;
    ComputePipeline tile_lights_;                               ///< once tiles are prepared
    std::map<MarkVariant, ComputePipeline> mark_lists_;         ///< once they or visible cells are
    std::array<std::optional<ComputePipeline>, 2> slot_lights_; ///< once slots are; [1] with deformed meshes
};

} // namespace hearth::gpu

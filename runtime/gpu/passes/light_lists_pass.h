// Lists the lights of the frame and of the cells of its light grid on the device: runtime/frame/light_lists.h
// has the same on the CPU.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/scene/scene.h"

namespace hearth::gpu
{

class LightListsPass
{
public:
    static Result<LightListsPass> create(const Device& device, const DrawLayouts& layouts);

    /// Record in FrameStep::light_lists, for a frame whose SceneLights::beginFrame asked for it.
    void record(const Device& device, VkCommandBuffer commands, const Scene& scene) const;

private:
    ComputePipeline list_lights_, cell_lights_, place_lists_;
};

} // namespace hearth::gpu

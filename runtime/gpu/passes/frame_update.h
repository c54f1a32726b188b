// Frame update: brings the tables on the device up to date before anything of a frame is culled or drawn: the
// view, moved instances, poses, lights and streamed pages.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/passes/frame_targets.h"
#include "runtime/gpu/scene/instance_motion.h"
#include "runtime/gpu/scene/light_change.h"
#include "runtime/gpu/scene/scene.h"

#include <span>

namespace hearth::gpu
{

/// Changes of a scene since its last frame.
struct FrameChanges
{
    std::span<const InstanceMove> moves{};
    std::span<const InstancePose> poses{};
    std::span<const LightChange> lights{};
};

/// Record the update of a frame. Outside a render pass; waits for earlier frames of the scene on the same
/// queue.
void recordFrameUpdate(const Device& device, VkCommandBuffer commands, const Scene& scene,
                       const FrameTargets& targets, const shared::FrameView& view,
                       const FrameChanges& changes);

/// Switch the same frame to another view: other constants, and cleared counters. After recordFrameUpdate.
void recordViewChange(const Device& device, VkCommandBuffer commands, const Scene& scene,
                      const FrameTargets& targets, const shared::FrameView& view);

} // namespace hearth::gpu

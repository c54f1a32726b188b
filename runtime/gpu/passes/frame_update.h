// Frame update: brings the tables on the device up to date before anything of a frame is culled or drawn: the
// view, moved instances, poses, lights and streamed pages.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/passes/frame_targets.h"
#include "runtime/gpu/passes/word_copy_pass.h"
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
    const DaylightChange* daylight = nullptr; ///< before `lights`
    std::span<const LightChange> lights{};
    std::span<const LampWeight> lamp_weights{};
    bool draws = true; ///< false: nothing is drawn, and shadow maps stay with the lights that have them
};

/// Begin a frame of a scene with targets: takes the oldest of the scene's frames in flight, which has
/// completed, and writes what the frame changes. Records copies of streamed pages, in FrameStep::update.
/// Returns the frame's copies, for more of them.
WordCopies recordFrameUpdate(const Device& device, VkCommandBuffer commands, const Scene& scene,
                             FrameTargets& targets, const WordCopyPass& copy_words,
                             const shared::FrameView& view, const FrameChanges& changes);

/// Write the constants of a view of the frame, before it is culled.
void writeView(const SceneView& target, const shared::FrameView& view);

/// Record another view in place of one that has been drawn in the same frame: waits for its draws.
void recordViewChange(const Device& device, VkCommandBuffer commands, const SceneView& target,
                      const shared::FrameView& view);

} // namespace hearth::gpu

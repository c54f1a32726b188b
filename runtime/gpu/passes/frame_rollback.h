// Undoes the progress of a scene and of targets when memory runs out while a frame is recorded.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/passes/frame_targets.h"
#include "runtime/gpu/scene/scene.h"

namespace hearth::gpu
{

/// Guard of a frame, or a part of one, that is being recorded. Without `keep`, as after an exception, the scene
/// and the targets are at the end as if nothing had been recorded: what the same frame records again has the
/// same result. What the frame has changed stays, as far as recording it again changes it in the same way:
/// moves, poses, lights. Does not undo the exchange of streamed textures.
class FrameRollback
{
public:
    FrameRollback(const Scene& scene, FrameTargets& targets)
        : scene_(scene), targets_(targets), frame_(scene.tables->frame), progress_(targets.progress())
    {
    }
    ~FrameRollback();
    FrameRollback(const FrameRollback&) = delete;
    FrameRollback& operator=(const FrameRollback&) = delete;

    void keep() { is_kept_ = true; }

private:
    const Scene& scene_;
    FrameTargets& targets_;
    uint32_t frame_; ///< of the scene's frames in flight
    FrameTargets::Progress progress_;
    bool is_kept_ = false;
};

} // namespace hearth::gpu

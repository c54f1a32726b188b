// Undoes the progress of a scene and of targets when memory runs out while a frame is recorded.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/passes/frame_targets.h"
#include "runtime/gpu/scene/scene.h"

namespace hearth::gpu
{

/// Guard of a frame, or a part of one, that is being recorded. Without `keep`, as after an exception, it
/// takes back that the scene and the targets have had the frame, so that it can be recorded again with the
/// same result. Moves, poses and lights of the frame stay: it sets them again. Exchanges of streamed
/// textures are not undone.
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

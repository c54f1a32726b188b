// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/passes/frame_rollback.h"

#include "runtime/gpu/scene/scene_shadows.h"
#include "runtime/gpu/scene/scene_tables.h"

namespace hearth::gpu
{

FrameRollback::~FrameRollback()
{
    if (is_kept_)
        return;
    scene_.tables->frame = frame_;
    targets_.restore(progress_);
    if (scene_.stream != nullptr)
        scene_.stream->cancelRecording();
    if (scene_.shadows != nullptr)
        scene_.shadows->forget(); // maps that count as drawn are not
}

} // namespace hearth::gpu

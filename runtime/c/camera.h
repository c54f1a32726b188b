// Cameras of frames of hearth.h.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/c/call.h"
#include "runtime/frame/frame.h"

namespace hearth::c
{

/// errors: usage.
Status checkCamera(const hearth_frame& frame);

shared::Camera toCamera(const hearth_frame& frame);

/// Make the ray of hearth_frame_get_ray. errors: usage.
Result<hearth_ray> makePixelRay(const hearth_frame& frame, uint32_t width, uint32_t height, float x,
                                float y);

inline Float3 toFloat3(const float (&v)[3])
{
    return {v[0], v[1], v[2]};
}

} // namespace hearth::c

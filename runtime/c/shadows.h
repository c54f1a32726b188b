// Shadow options and spheres of the C API, checked and converted.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/c/handles.h"

namespace hearth::c
{

/// Convert options that are in range to the renderer's. errors: usage.
Result<gpu::ShadowOptions> shadowOptions(const hearth_shadow_options& options);

/// Fill scene.shadow_spheres with the spheres of a frame. errors: usage.
Status makeShadowSpheres(hearth_scene& scene, const hearth_frame& frame);

} // namespace hearth::c

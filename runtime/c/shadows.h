// Shadows of the C API: what its structures say, checked and handed on.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/c/handles.h"

namespace hearth::c
{

/// Options in their ranges become the renderer's. errors: usage.
Result<gpu::ShadowOptions> shadowOptions(const hearth_shadow_options& options);

/// The spheres of a frame, into scene.shadow_spheres. errors: usage.
Status makeShadowSpheres(hearth_scene& scene, const hearth_frame& frame);

} // namespace hearth::c

// What a frame of a C caller says of lights.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/c/handles.h"

namespace hearth::c
{

/// Into scene.lights. errors: usage.
Status makeLights(hearth_scene& scene, const hearth_frame& frame);

/// Into scene.emissions. errors: usage.
Status makeEmissions(hearth_scene& scene, const hearth_frame& frame);

} // namespace hearth::c

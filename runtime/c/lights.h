// Lights, their weights and emission scales of a C caller's frame, converted and checked.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/c/handles.h"

namespace hearth::c
{

/// Fill scene.lights. errors: usage.
Status makeLights(hearth_scene& scene, const hearth_frame& frame);

/// Fill scene.daylight. errors: usage.
Status makeDaylight(hearth_scene& scene, const hearth_frame& frame);

/// Fill scene.lamp_weights. errors: usage.
Status makeLampWeights(hearth_scene& scene, const hearth_frame& frame);

/// Fill scene.emissions. errors: usage.
Status makeEmissions(hearth_scene& scene, const hearth_frame& frame);

} // namespace hearth::c

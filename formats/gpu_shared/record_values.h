// Values in the records of packs that shaders compare: flags of instances and materials, modes of alpha,
// types of lights. One source for C++ and GLSL.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_RECORD_VALUES_H
#define HEARTH_SHARED_RECORD_VALUES_H

#include "formats/gpu_shared/language.h"

HEARTH_SHARED_BEGIN

/// Bit of InstanceRecord::flags: the determinant of world_from_object is negative, so triangles have reversed
/// winding.
HEARTH_CONSTANT uint kInstanceMirrored = 1;

/// Bits of MaterialRecord::flags.
HEARTH_CONSTANT uint kMaterialDoubleSided = 1;
HEARTH_CONSTANT uint kMaterialUnlit = 2;

/// formats::AlphaMode.
HEARTH_CONSTANT uint kAlphaOpaque = 0;
HEARTH_CONSTANT uint kAlphaMask = 1;
HEARTH_CONSTANT uint kAlphaBlend = 2;

/// formats::LightType.
HEARTH_CONSTANT uint kLightDirectional = 0;
HEARTH_CONSTANT uint kLightPoint = 1;
HEARTH_CONSTANT uint kLightSpot = 2;

HEARTH_SHARED_END

#endif

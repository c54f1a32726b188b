// Lights of a pixel as bits, in two images of four 8-bit channels: light i of the frame's list of ranged
// lights is bit i. Blending adds a bit at most once, so that sums of channels are sets of lights. One source
// for C++ and GLSL.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_LIGHT_BITS_H
#define HEARTH_SHARED_LIGHT_BITS_H

#include "formats/gpu_shared/light_cells.h"

HEARTH_SHARED_BEGIN

/// Lights that have a bit. Those behind them are found by the cell of the pixel.
HEARTH_CONSTANT uint kMarkedLights = 64;

/// True if a light with a range may reach a point. It errs to the side of more light by rounding alone.
/// place  in the space of the view
HEARTH_FUNCTION bool mayReachPoint(HEARTH_IN(CellLight) light, Float3 place)
{
    Float3 offset = place - light.apex;
    float distance = sqrt(dot3(offset, offset));
    if (distance > light.range + light.slack)
        return false;
    if (light.cosine < 0.0f)
        return true;
    // a point within the slack of the cone, whose sides are nowhere closer than their distance by angle
    return dot3(offset, light.axis) >= (distance - light.slack) * light.cosine - light.slack;
}

HEARTH_SHARED_END

#endif

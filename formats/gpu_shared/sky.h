// The sky that lights every scene, a smooth gradient from ground over horizon to zenith: its radiance from a
// direction, and its mean over a cone of directions through a table. One source for C++ and GLSL.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_SKY_H
#define HEARTH_SHARED_SKY_H

#include "formats/gpu_shared/language.h"
#include "formats/gpu_shared/precision.h"

// The radiance depends on the height of the direction alone, the sine of its elevation. It is
//     ground + (horizon - ground) above + (zenith - horizon) above high,
// and the table has the means of both products over cones (formats/scene/sky_table.h). Everything that the
// sky lights reads one of two functions, skyRadiance here or skyConeRadiance of sky.glsl: a sky from an image
// would replace these two, with prefiltered images in place of the table.

HEARTH_SHARED_BEGIN

/// Nodes of the table: heights of axes are columns, half-angles rows.
HEARTH_CONSTANT uint kSkyTableHeights = 128;
HEARTH_CONSTANT uint kSkyTableAngles = 16;

/// Colours of the sky, radiance, as in shared::Lighting.
struct Sky
{
    Float3 zenith;
    Float3 horizon;
    Float3 ground;
};

HEARTH_FUNCTION float skySmoothstep(float from, float to, float x)
{
    float t = min(max((x - from) / (to - from), 0.0f), 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

/// Return how far a direction of this height is above the ground, [0, 1].
HEARTH_FUNCTION float skyAbove(float height)
{
    return skySmoothstep(-0.296f, 0.296f, height);
}

/// Return how far a direction of this height is from the horizon to the zenith, [0, 1].
HEARTH_FUNCTION float skyHigh(float height)
{
    return skySmoothstep(-0.2f, 1.0f, height);
}

/// Return the radiance from a direction.
/// direction  unit
HEARTH_FUNCTION Float3 skyRadiance(HEARTH_IN(Sky) sky, Float3 direction)
{
    Float3 above = sky.horizon + (sky.zenith - sky.horizon) * skyHigh(direction.y);
    return sky.ground + (above - sky.ground) * skyAbove(direction.y);
}

/// Return the mean radiance over a cone.
/// means  of skyAbove (x) and skyAbove * skyHigh (y), as the table has them
HEARTH_FUNCTION Half3 skyMeanRadiance(HEARTH_IN(Sky) sky, Half2 means)
{
    Half3 ground = sky.ground;
    Half3 horizon = sky.horizon;
    Half3 zenith = sky.zenith;
    return ground + (horizon - ground) * means.x + (zenith - horizon) * means.y;
}

/// Return the coordinates of a lookup, each in [0, 1], the first node at 0, the last at 1.
/// height          of the cone's axis, [-1, 1]
/// cos_half_angle  [0, 1]
HEARTH_FUNCTION Half2 skyTableCoordinates(Half height, Half cos_half_angle)
{
    // linear in the half-angle, about
    return Float2(min(max(0.5f + 0.5f * height, 0.0f), 1.0f),
                  sqrt(min(max(1.0f - cos_half_angle, 0.0f), 1.0f)));
}

/// Return height (x) and cosine of the half-angle (y) of a node.
HEARTH_FUNCTION Float2 skyTableNode(uint column, uint row)
{
    float across = float(column) / float(kSkyTableHeights - 1u);
    float down = float(row) / float(kSkyTableAngles - 1u);
    return Float2(2.0f * across - 1.0f, 1.0f - down * down);
}

HEARTH_SHARED_END

#endif

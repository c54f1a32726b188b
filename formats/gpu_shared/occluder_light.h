// Light that the occluders of a surface give back: radiance from occluded directions, a function of the
// direction for each instance. One source for C++ and GLSL.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_OCCLUDER_LIGHT_H
#define HEARTH_SHARED_OCCLUDER_LIGHT_H

#include "formats/gpu_shared/visibility_cone.h"

// Surfaces that occlude the sky are lit themselves: a wall sees sunlit ground. The cooker bakes how much
// light of the sky and of suns the surroundings of an instance give back (formats/records/surroundings.h),
// and each frame multiplies that by its light (formats/scene/radiance_transfer.h). Shading adds the result
// where visibility_cone.h says that the sky is occluded.

HEARTH_SHARED_BEGIN

/// Radiance from occluded directions, linear in the direction. A row for each colour: xyz times the
/// direction, plus w.
struct OccluderLight
{
    Half4 red;
    Half4 green;
    Half4 blue;
};

/// Rows of 16 bytes in the buffer of lights: three for each radiance transfer, the OccluderLight
/// under the frame's light, then one for each instance: the number of its transfer, and the four halves of
/// its visibility (instance_visibility.h).
HEARTH_CONSTANT uint kOccluderLightRows = 3;

/// Lighting::surroundings_row of a scene without surroundings.
HEARTH_CONSTANT uint kNoSurroundings = 0xFFFFFFFFu;

/// Number of the transfer of an instance that nothing occludes.
HEARTH_CONSTANT uint kNoTransfer = 0xFFFFFFFFu;

/// Return the radiance from a direction.
/// direction  at most unit: a mean of directions gets their mean radiance
HEARTH_FUNCTION Half3 occluderRadiance(HEARTH_IN(OccluderLight) light, Half3 direction)
{
    Half3 radiance = Float3(light.red.w, light.green.w, light.blue.w) +
                     Float3(light.red.x, light.green.x, light.blue.x) * direction.x +
                     Float3(light.red.y, light.green.y, light.blue.y) * direction.y +
                     Float3(light.red.z, light.green.z, light.blue.z) * direction.z;
    return Float3(max(radiance.x, 0.0f), max(radiance.y, 0.0f), max(radiance.z, 0.0f));
}

/// Return the mean of the occluded directions of a hemisphere.
/// normal  of the hemisphere, whose visible part has the moments m0 and m1
HEARTH_FUNCTION Half3 meanOccludedDirection(Half m0, Half3 m1, Half3 normal)
{
    Half solid_angle = 2.0f * kVisibilityPi - m0;
    // a noisy direction of next to nothing does not matter
    return (normal * kVisibilityPi - m1) * (1.0f / max(solid_angle, 0.01f));
}

HEARTH_SHARED_END

#endif

// Visibility of an instance: that of its mesh, changed by its surroundings. One source for C++ and GLSL.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_INSTANCE_VISIBILITY_H
#define HEARTH_SHARED_INSTANCE_VISIBILITY_H

#include "formats/gpu_shared/visibility_cone.h"

// Vertices have the mean visibility V of all instances of their mesh. An instance in a cave and one on a hill
// see different parts of it: the visibility of each is V times a function of the direction, which is the same
// at all of its vertices, and here linear. The moments of the product need the second moments of V, which are
// those of the visibility cone.

HEARTH_SHARED_BEGIN

/// Return the moments of V (f.w + dot(f.xyz, w)), where V has the given moments.
/// normal  of the surface; m1, normal and factor are in world axes
HEARTH_FUNCTION VisibilityMoments changedVisibility(HEARTH_IN(VisibilityMoments) moments, Float3 normal,
                                                    Float4 factor)
{
    Float3 slope = Float3(factor.x, factor.y, factor.z);
    VisibilityMoments changed;
    changed.m0 = moments.m0 * factor.w + dot(moments.m1, slope);
    changed.m1 = moments.m1 * factor.w;
    if (dot(slope, slope) == 0.0f)
        return changed;
    VisibilityCone cone = visibilityCone(moments.m0, moments.m1, normal);
    float c = cone.cos_aperture;
    float all = 2.0f * kVisibilityPi * cone.scale * (1.0f - c);
    float along = all * (1.0f + c + c * c) * (1.0f / 3.0f);
    float across = 0.5f * (all - along);
    changed.m1 = changed.m1 + slope * across + cone.axis * ((along - across) * dot(cone.axis, slope));
    return changed;
}

HEARTH_SHARED_END

#endif

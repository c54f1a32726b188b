// How much of a constant sky lights a surface through a visibility cone: the horizon-clipped form in closed form, two cheap
// ones, and what becomes of it where a normal map bends the normal. Written once for C++ and GLSL.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_AMBIENT_OCCLUSION_H
#define HEARTH_SHARED_AMBIENT_OCCLUSION_H

#include "formats/gpu_shared/language.h"

// A cone of the moments of visibility (visibility_cone.h) has the surface's own horizon in it already: at the normal that it was
// baked for, the occlusion is the plain product cos(theta) sin^2(aperture) scale = dot(n, m1) / pi, exactly, and clipping the
// cone at that horizon once more would make creases too bright (0.517 for 0.5). Only what a bent normal changes comes from
// the clipped form. Sources: the closed form is the form factor of a spherical cap, checked against integration; the correction
// for bent normals follows "Practical mobile rendering" (GDC 2023), whose weight `a` is a^3 here, and only where the normal
// leaves the axis: rms error 0.017 in place of 0.045, over random skies and bends of up to 45 degrees
// (tests/formats/ambient_occlusion_test.cpp).

HEARTH_SHARED_BEGIN

/// How ambient occlusion is reckoned. The numbers are those of the settings.
HEARTH_CONSTANT uint kAmbientOcclusionExact = 0;
HEARTH_CONSTANT uint kAmbientOcclusionSmoothstep = 1;
HEARTH_CONSTANT uint kAmbientOcclusionQuadratic = 2;
HEARTH_CONSTANT uint kAmbientOcclusionOff = 3;

/// The part of a constant sky's irradiance that comes through an open cone, horizon-clipped: [0, 1].
/// cos_theta     of the angle between normal and axis, any
/// cos_aperture  of the half-angle, [0, 1]
HEARTH_FUNCTION float clippedConeOcclusion(float cos_theta, float cos_aperture)
{
    float sin2_aperture = 1.0f - cos_aperture * cos_aperture;
    float w2 = sin2_aperture - cos_theta * cos_theta;
    // the whole cone on one side of the horizon: theta + aperture <= pi / 2, or theta - aperture >= pi / 2
    if (w2 <= 0.0f)
        return max(cos_theta, 0.0f) * sin2_aperture;
    float w = sqrt(w2);
    // acos(-cot(theta) cot(aperture)), whose sine is w over the product of both sines: no quotient at the poles
    float turn = arcTangent(w, -cos_theta * cos_aperture);
    float share = cos_theta * sin2_aperture * turn - w * cos_aperture + arcTangent(w, cos_aperture);
    return max(share * (1.0f / 3.14159265f), 0.0f);
}

/// sin^2(a pi / 2), a in [0, 1]: off by at most 0.010.
HEARTH_FUNCTION float smoothstepShare(float a)
{
    return a * a * (3.0f - 2.0f * a);
}

/// The same by two parabolas: off by at most 0.029. Continuous, which a^2 and 1 - (1 - a)^2 would not be.
HEARTH_FUNCTION float quadraticShare(float a)
{
    float b = 1.0f - a;
    return a < 0.5f ? 2.0f * a * a : 1.0f - 2.0f * b * b;
}

/// Ambient occlusion, [0, 1]: 1 is the open sky. The same as without a normal map where both cosines are the same.
/// mode           one of kAmbientOcclusion*
/// scale          of the cone, [0, 1]
/// cos_aperture   [0, 1]; aperture its angle in radians, which the exact form does not look at
/// cos_geometric  between the axis and the normal that the cone was baked for
/// cos_shading    between the axis and the normal that is lit: bent by a normal map
HEARTH_FUNCTION float ambientOcclusion(uint mode, float scale, float cos_aperture, float aperture,
                                       float cos_geometric, float cos_shading)
{
    if (mode == kAmbientOcclusionOff)
        return 1.0f;
    float share;
    if (mode == kAmbientOcclusionExact)
    {
        share = max(cos_geometric, 0.0f) * (1.0f - cos_aperture * cos_aperture);
        if (cos_shading != cos_geometric)
            share += clippedConeOcclusion(cos_shading, cos_aperture) -
                     clippedConeOcclusion(cos_geometric, cos_aperture);
    }
    else
    {
        float a = min(aperture * (2.0f / 3.14159265f), 1.0f);
        float bend = cos_shading - cos_geometric;
        // away from the axis more than the product says is left: half of a hemisphere's loss is hidden by the horizon
        float cosine = cos_geometric + (bend < 0.0f ? bend * (1.0f - 0.5f * a * a * a) : bend);
        share =
            max(cosine, 0.0f) * (mode == kAmbientOcclusionQuadratic ? quadraticShare(a) : smoothstepShare(a));
    }
    return min(max(scale * share, 0.0f), 1.0f);
}

HEARTH_SHARED_END

#endif

// Computes ambient occlusion of a constant sky through a visibility cone: the exact horizon-clipped form, two
// cheap approximations, and the correction for normal maps. One source for C++ and GLSL.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_AMBIENT_OCCLUSION_H
#define HEARTH_SHARED_AMBIENT_OCCLUSION_H

#include "formats/gpu_shared/language.h"
#include "formats/gpu_shared/precision.h"

// A cone of the moments of visibility (visibility_cone.h) already contains the surface's own horizon. At the
// normal that the cone was baked for, the ambient occlusion is exactly the product cos(theta) sin^2(aperture)
// scale = dot(n, m1) / pi. Clipping the cone at that horizon once more would make creases too bright (0.517
// for 0.5). So the clipped form only supplies the change that a bent normal makes.
// Sources: the closed form is the form factor of a spherical cap, checked against integration. The correction
// for bent normals follows "Practical mobile rendering" (GDC 2023); its weight `a` is a^3 here, and applies
// only where the normal leaves the axis: rms error 0.017 instead of 0.045 over random skies and bends of up
// to 45 degrees (tests/formats/ambient_occlusion_test.cpp).

HEARTH_SHARED_BEGIN

/// Method of ambient occlusion. The numbers are the values of the setting.
HEARTH_CONSTANT uint kAmbientOcclusionExact = 0;
HEARTH_CONSTANT uint kAmbientOcclusionSmoothstep = 1;
HEARTH_CONSTANT uint kAmbientOcclusionQuadratic = 2;
HEARTH_CONSTANT uint kAmbientOcclusionOff = 3;

/// Return the fraction of a constant sky's irradiance that comes through an open cone, horizon-clipped: [0,
/// 1].
/// cos_theta     cosine of the angle between normal and axis, any angle
/// cos_aperture  cosine of the half-angle, [0, 1]
HEARTH_FUNCTION Half clippedConeOcclusion(Half cos_theta, Half cos_aperture)
{
    Half sin2_aperture = 1.0f - cos_aperture * cos_aperture;
    Half w2 = sin2_aperture - cos_theta * cos_theta;
    // the whole cone on one side of the horizon: theta + aperture <= pi / 2, or theta - aperture >= pi / 2
    if (w2 <= 0.0f)
        return max(cos_theta, 0.0f) * sin2_aperture;
    Half w = sqrt(w2);
    // acos(-cot(theta) cot(aperture)). Its sine is w over the product of both sines: no quotient at the poles
    Half turn = arcTangent(w, -cos_theta * cos_aperture);
    Half share = cos_theta * sin2_aperture * turn - w * cos_aperture + arcTangent(w, cos_aperture);
    return max(share * (1.0f / 3.14159265f), 0.0f);
}

/// Approximate sin^2(a pi / 2), a in [0, 1], by a smoothstep. Error at most 0.010.
HEARTH_FUNCTION Half smoothstepSinSquared(Half a)
{
    return a * a * (3.0f - 2.0f * a);
}

/// Approximate sin^2(a pi / 2), a in [0, 1], by two parabolas. Error at most 0.029. Continuous, unlike a^2
/// and 1 - (1 - a)^2.
HEARTH_FUNCTION Half quadraticSinSquared(Half a)
{
    Half b = 1.0f - a;
    return a < 0.5f ? 2.0f * a * a : 1.0f - 2.0f * b * b;
}

/// Compute ambient occlusion, [0, 1]: 1 is the open sky. Equal cosines give the result without a normal map.
/// mode           one of kAmbientOcclusion*
/// scale          scale of the cone, [0, 1]
/// cos_aperture   cosine of the half-angle, [0, 1]
/// aperture       half-angle in radians; the exact form ignores it
/// cos_geometric  cosine between the axis and the normal that the cone was baked for
/// cos_shading    cosine between the axis and the shading normal, bent by a normal map
HEARTH_FUNCTION Half ambientOcclusion(uint mode, Half scale, Half cos_aperture, Half aperture,
                                      Half cos_geometric, Half cos_shading)
{
    if (mode == kAmbientOcclusionOff)
        return 1.0f;
    Half share;
    if (mode == kAmbientOcclusionExact)
    {
        share = max(cos_geometric, 0.0f) * (1.0f - cos_aperture * cos_aperture);
        if (cos_shading != cos_geometric)
            share += clippedConeOcclusion(cos_shading, cos_aperture) -
                     clippedConeOcclusion(cos_geometric, cos_aperture);
    }
    else
    {
        Half a = min(aperture * (2.0f / 3.14159265f), 1.0f);
        Half bend = cos_shading - cos_geometric;
        // away from the axis more light remains than the product says: the horizon hides half of a
        // hemisphere's loss
        Half cosine = cos_geometric + (bend < 0.0f ? bend * (1.0f - 0.5f * a * a * a) : bend);
        share = max(cosine, 0.0f) *
                (mode == kAmbientOcclusionQuadratic ? quadraticSinSquared(a) : smoothstepSinSquared(a));
    }
    return min(max(scale * share, 0.0f), 1.0f);
}

HEARTH_SHARED_END

#endif

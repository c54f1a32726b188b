// Visibility of the hemisphere at a surface point, for ambient occlusion and bent normals: the code of its
// two moments, and the cone with the same moments. One source for C++ and GLSL. The cone is the closed form
// for two moments: m0 = 2 pi s (1 - c) and m1 = pi s (1 - c^2) d with c the cosine of its half-angle, d its
// axis, s the fraction of light that it lets through.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_VISIBILITY_CONE_H
#define HEARTH_SHARED_VISIBILITY_CONE_H

#include "formats/gpu_shared/precision.h"
#include "formats/gpu_shared/vertex_layout.h"

HEARTH_SHARED_BEGIN

HEARTH_CONSTANT float kVisibilityPi = 3.14159265f;

/// Moments of visibility. With V(w) in [0, 1] the visibility in direction w: m0 = int V dw, in [0, 2 pi], and
/// m1 = int V w dw, of length at most m0 (1 - m0 / (4 pi)). Both are linear in V: they may be averaged and
/// interpolated. If V is 0 below the horizon of the normal n, the ambient occlusion of the surface is dot(n,
/// m1) / pi, without a cone.
struct VisibilityMoments
{
    float m0;
    Float3 m1;
};

/// Cone of visible directions. Light from directions within `aperture` of the axis is multiplied by `scale`,
/// other light is occluded.
struct VisibilityCone
{
    Half3 axis;         ///< unit
    float cos_aperture; ///< [0, 1]; full, because narrow cones have a cosine next to 1
    Half aperture;      ///< half-angle, radians, [0, pi / 2]
    Half scale;         ///< [0, 1]
};

// Code of a vertex. The length x = min(|m1| / pi, 1) follows from the first three numbers:
//   bits 1 to 7 of byte 1   7 bits q: rho = |m1| / m0 is mix(x / 2, (1 + sqrt(1 - x)) / 2, q / 127), the
//                           smallest and largest rho with this x; m0 = pi x / rho, 0 where x is 0
//   byte 0, bit 0 of byte 1 9 bits, byte 0 the upper ones: dot(n, m1) / pi = q / 511, the ambient occlusion
//   bytes 2 and 3           8 bits q, signed, not -128: m1 / pi along the first and the second vector of the
//                           normal's frame is q / 254
// The code stores rho instead of m0 because the cosine of the cone's half-angle is 2 rho - 1: its error is
// small for narrow cones too, where m0 is small.

/// Decode rho where |m1| / pi is x.
/// place  code of rho scaled to [0, 1]
HEARTH_FUNCTION float visibilityRatio(float x, float place)
{
    float least = 0.5f * x;
    float greatest = 0.5f + 0.5f * sqrt(1.0f - x);
    return least + (greatest - least) * place;
}

/// Return x of a code: |m1| / pi, at most 1.
HEARTH_FUNCTION float visibilityLength(Float3 m1_over_pi)
{
    return min(sqrt(dot(m1_over_pi, m1_over_pi)), 1.0f);
}

/// Decode the moments in the frame of the normal: x and y along its first and second vector, z along the
/// normal.
HEARTH_FUNCTION VisibilityMoments decodeVisibilityInFrame(uint code)
{
    Float3 p = Float3(float(int(code << 8) >> 24) / 254.0f, float(int(code) >> 24) / 254.0f,
                      float((code & 255u) << 1 | (code >> 8 & 1u)) / 511.0f);
    float x = visibilityLength(p);
    float ratio = visibilityRatio(x, float(code >> 9 & 127u) / 127.0f);
    VisibilityMoments moments;
    moments.m0 = x > 0.0f ? kVisibilityPi * (x / ratio) : 0.0f;
    moments.m1 = p * kVisibilityPi;
    return moments;
}

/// Decode the moments in the space of the normal.
/// normal  unit, as decoded from the vertex's code; its frame is the one of tangents
HEARTH_FUNCTION VisibilityMoments decodeVisibility(uint code, Float3 normal)
{
    VisibilityMoments moments = decodeVisibilityInFrame(code);
    NormalFrame frame = makeNormalFrame(normal);
    moments.m1 = frame.first * moments.m1.x + frame.second * moments.m1.y + normal * moments.m1.z;
    return moments;
}

/// Return the nearest moments along the same direction that a visibility in [0, 1] on a hemisphere can have:
/// noise and fits overshoot.
HEARTH_FUNCTION VisibilityMoments feasibleVisibility(float m0, Float3 m1)
{
    VisibilityMoments moments;
    moments.m0 = max(min(m0, 2.0f * kVisibilityPi), 0.0f);
    float most = moments.m0 * (1.0f - moments.m0 / (4.0f * kVisibilityPi));
    float size = sqrt(dot(m1, m1));
    moments.m1 = size > most ? m1 * (most / size) : m1;
    return moments;
}

/// Return the cone with these moments. Where it would be wider than a hemisphere, as below an overhang,
/// return the hemisphere that keeps m1, and with it the ambient occlusion. Infeasible moments are made
/// feasible first. Without any light, axis = normal and scale = 0.
HEARTH_FUNCTION VisibilityCone visibilityCone(float m0, Float3 m1, Float3 normal)
{
    VisibilityMoments moments = feasibleVisibility(m0, m1);
    float size = sqrt(dot(moments.m1, moments.m1));
    VisibilityCone cone;
    cone.axis = normal;
    cone.cos_aperture = 0.0f;
    cone.scale = 0.0f;
    // below this the quotients are numerically meaningless
    if (size > 1e-12f && moments.m0 > 1e-12f)
    {
        float ratio = min(size / moments.m0, 1.0f);
        cone.axis = moments.m1 * (1.0f / size);
        cone.cos_aperture = max(2.0f * ratio - 1.0f, 0.0f);
        cone.scale = ratio > 0.5f ? moments.m0 / (4.0f * kVisibilityPi * max(1.0f - ratio, 1e-12f))
                                  : size / kVisibilityPi;
        cone.scale = min(cone.scale, 1.0f);
    }
    cone.aperture = acos(cone.cos_aperture);
    return cone;
}

HEARTH_SHARED_END

#endif

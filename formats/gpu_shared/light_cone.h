// Cones from which a surface gets the light of the sky: open or through a visibility cone, for the diffuse
// part and for a specular lobe. One source for C++ and GLSL.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_LIGHT_CONE_H
#define HEARTH_SHARED_LIGHT_CONE_H

#include "formats/gpu_shared/reflectance.h"
#include "formats/gpu_shared/visibility_cone.h"

// The diffuse part weighs visible directions by the cosine to the normal. A cone stands for them that has the
// same mean of directions, and the same variance of heights. Occlusion (ambient_occlusion.h) says how much
// light arrives, the cone from where: a wall on real ground sees the sky above the horizon, and half of the
// hemisphere about its normal is ground.
//
// Moments of visibility (visibility_cone.h) stand for directions within an angle of an axis that are also
// above the surface's own horizon. Let c be the cosine of the half-angle that they give, k the cosine between
// axis and normal, s its sine. Where s <= c the cone is clear of the horizon: mean and variances are closed
// forms. Where s > c the horizon cuts it, and corrections with the factor s - c apply, fitted to cones of all
// angles and widths: means within .017, variances within .008; for two planes that meet, a floor and a wall,
// within .004.

HEARTH_SHARED_BEGIN

#ifdef __cplusplus
using std::cos;
using std::sin;
#endif

/// Cone with uniform weight. The axis is as long as the mean of the directions it stands for demands, about
/// 1.
struct LightCone
{
    Half3 axis;
    Half cos_half_angle; ///< [0, 1]
};

/// Return the cosine of the half-angle of the cone whose directions have this variance across its axis.
HEARTH_FUNCTION Half coneOfVariance(Half variance)
{
    return min(max(0.5f * sqrt(max(9.0f - 24.0f * variance, 0.0f)) - 0.5f, 0.0f), 1.0f);
}

/// Return the cone with a mean of directions, and a variance across it.
HEARTH_FUNCTION LightCone coneOfMoments(Half3 mean, Half variance)
{
    LightCone cone;
    cone.cos_half_angle = coneOfVariance(variance);
    cone.axis = mean * (2.0f / (1.0f + cone.cos_half_angle));
    return cone;
}

/// Return the cone of the diffuse part under an open sky: mean 2 / 3 along the normal, variance 1 / 4 across.
HEARTH_FUNCTION LightCone cosineCone(Half3 normal)
{
    return coneOfMoments(normal * (2.0f / 3.0f), 0.25f);
}

/// Return the cone of the diffuse part through a visibility cone.
/// normal  shading normal, unit
HEARTH_FUNCTION LightCone visibleCosineCone(HEARTH_IN(VisibilityCone) visible, Half3 normal)
{
    // of moments, which are those of the uncut cone
    Half c = visible.cos_aperture;
    Half k = min(max(dot(visible.axis, normal), 1e-3f), 1.0f);
    Half s = sqrt(1.0f - k * k);
    Half cut = max(s - c, 0.0f);
    Half spread = (2.0f + c) / (3.0f * (1.0f + c)) * min((1.0f - c) / k, k / (1.0f + s));
    Half across = 0.25f * (1.0f - c * c);
    Half up = spread + c * k + cut * (-0.0523f - 0.2714f * cut + 0.6874f * k + 0.2863f * c);
    Half aside = c * s + cut * (0.0451f + 0.836f * cut - 0.0504f * k + 0.4513f * c);
    // variances across the mean: in the plane of normal and axis, and along the edge, perpendicular to the
    // plane
    Half in_plane =
        across - spread * spread * s * s + cut * (0.0498f - 0.3916f * cut - 0.023f * k - 0.4807f * c);
    Half along_edge = across + cut * (0.0143f + 0.1971f * cut + 0.0069f * k + 0.1606f * c);

    Half3 tangent = (visible.axis - normal * dot(visible.axis, normal)) * (1.0f / max(s, 1e-3f));
    Half3 mean = normal * up + tangent * aside;
    // part of each variance in the height
    Half edge = cross(normal, tangent).y;
    Half edge_share = edge * edge;
    Half plane_share = max(1.0f - edge_share - mean.y * mean.y / max(dot(mean, mean), 1e-6f), 0.0f);
    Half variance = (max(in_plane, 0.0f) * plane_share + along_edge * edge_share + 1e-4f * across) /
                    (plane_share + edge_share + 1e-4f);
    // heights of a cut cone end abruptly at its cut, where those of a cone thin out: a narrower cone is
    // nearer
    return coneOfMoments(mean, variance * (1.0f - 0.5f * cut));
}

/// Return the cone of a specular lobe under an open sky.
/// mirror  reflection vector at the normal, unit
HEARTH_FUNCTION LightCone lobeCone(HEARTH_IN(LobeTotal) lobe, Half3 mirror, Half3 normal)
{
    LightCone cone;
    cone.axis = normalize(mirror * (1.0f - lobe.turn) + normal * lobe.turn);
    cone.cos_half_angle = lobe.cos_half_angle;
    return cone;
}

/// Return the part of a lobe's cone inside of a visibility cone: from the nearer ends of both to the farther
/// ends, along the arc between their axes. Apart from each other, a direction between both.
HEARTH_FUNCTION LightCone visibleLobeCone(HEARTH_IN(LightCone) lobe, HEARTH_IN(VisibilityCone) visible)
{
    float cosine = min(max(dot(lobe.axis, visible.axis), -1.0f), 1.0f);
    Half apart = acos(cosine);
    Half lobe_angle = acos(lobe.cos_half_angle);
    // angles from the lobe's axis towards the other axis
    Half low = max(-lobe_angle, apart - visible.aperture);
    Half high = min(lobe_angle, apart + visible.aperture);
    Half middle = 0.5f * (low + high);
    Half half_angle = max(0.5f * (high - low), 0.0f);
    Float3 towards = visible.axis - lobe.axis * cosine;
    float size = sqrt(max(dot(towards, towards), 1e-12f));
    LightCone cone;
    cone.axis = lobe.axis * cos(middle) + towards * (sin(middle) / size);
    cone.cos_half_angle = cos(half_angle);
    return cone;
}

HEARTH_SHARED_END

#endif

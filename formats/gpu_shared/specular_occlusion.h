// Specular occlusion: the fraction of a GGX lobe that a visibility cone lets through, by a fit without a
// texture, or by a lookup in the table of chunk SPOC. One source for C++ and GLSL. cook/specular/README.md
// has the derivation and measurements.
//
// Both methods return the fraction S of the horizon-clipped lobe (without Fresnel) that falls into the cone.
// A surface reflects S times the cone's scale times its usual image-based specular light.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_SPECULAR_OCCLUSION_H
#define HEARTH_SHARED_SPECULAR_OCCLUSION_H

#include "formats/gpu_shared/language.h"
#include "formats/gpu_shared/precision.h"

HEARTH_SHARED_BEGIN

/// Nodes of the table on each axis: aperture, roughness, cosine between reflection vector and cone axis.
HEARTH_CONSTANT uint kSpecularNodes = 16;

/// Roughness of the table's first node; a smaller roughness is clamped to it. The last node is 1.
HEARTH_CONSTANT float kMinSpecularRoughness = 0.089f;

/// Spacing of nodes on the axis of beta, the angle between reflection vector and cone axis.
HEARTH_CONSTANT uint kSpecularSpacingCosine = 0;   ///< uniform in cos(beta)
HEARTH_CONSTANT uint kSpecularSpacingHalfSine = 1; ///< uniform in 1 - sin(beta / 2): dense around the lobe

HEARTH_FUNCTION float specularClamp(float value, float low, float high)
{
    return min(max(value, low), high);
}

/// Return the coordinates of a table lookup, each in [0, 1], node i at i / 15. x is aperture, y roughness, z
/// beta; 1 is a full hemisphere, roughness 1, and the axis along the reflection vector. Texel x is next to
/// texel x + 1 in memory, y is 16 texels farther, z 256.
/// cos_aperture  cosine of the cone's half-angle, 0 to 1
/// spacing       kSpecularSpacing*, of the table
HEARTH_FUNCTION Float3 specularTableCoordinates(float cos_aperture, float roughness, float cos_beta,
                                                uint spacing)
{
    float aperture = acos(specularClamp(cos_aperture, 0.0f, 1.0f)) * 0.636619772f;
    float rough = (roughness - kMinSpecularRoughness) / (1.0f - kMinSpecularRoughness);
    float half_chord = specularClamp(0.5f - 0.5f * cos_beta, 0.0f, 1.0f);
    float beta = spacing == kSpecularSpacingCosine ? 1.0f - half_chord : 1.0f - sqrt(half_chord);
    return Float3(specularClamp(aperture, 0.0f, 1.0f), specularClamp(rough, 0.0f, 1.0f), beta);
}

/// Return texture coordinates of a lookup in 16 x 16 x 16 texels, filtered linearly and clamped: nodes are
/// texel centres.
HEARTH_FUNCTION Float3 specularTextureCoordinates(Float3 place)
{
    return Float3(place.x * 0.9375f + 0.03125f, place.y * 0.9375f + 0.03125f, place.z * 0.9375f + 0.03125f);
}

/// Return the fraction of a lobe that falls into a cone, exact at normal incidence without shadowing. Slopes
/// of half-vectors are the stereographic image of the directions, and GGX's slopes are the image of a
/// uniformly covered sphere, so a cone becomes a cap of this sphere. In angles: sin^2((u(beta + a) - u(beta -
/// a)) / 2), u(x) = atan2(sin(x / 2), width cos(x / 2)).
/// cos_beta  cosine between the middles of lobe and cone
/// width     GGX alpha of the lobe
HEARTH_FUNCTION float specularCap(float cos_half_angle, float cos_beta, float width)
{
    float square = width * width;
    float sines = sqrt(max((1.0f - cos_half_angle * cos_half_angle) * (1.0f - cos_beta * cos_beta), 0.0f));
    float middle = (1.0f + square) - (1.0f - square) * (cos_half_angle * cos_beta);
    float spread = (1.0f - square) * sines;
    float turned = square * (cos_half_angle + cos_beta) + (cos_half_angle - cos_beta);
    return 0.5f - 0.5f * turned / sqrt(max((middle - spread) * (middle + spread), 1e-12f));
}

/// Coefficients found by hearth-specular --fit. alpha is GGX's, grazing is 1 - n_dot_v.
struct SpecularFit
{
    Half width_alpha; ///< width of the lobe / alpha = 1 + ...
    Half width_grazing;
    Half width_both;
    /// Shift of the lobe's middle from the reflection vector to the normal, / alpha = turn + ...
    Half turn;
    Half turn_alpha;
    Half turn_grazing;
    Half turn_both;
    Half loss; ///< part of a cone that reaches below the horizon and is lost, / alpha
};

/// Fit to 20000 configurations with height-correlated masking. rms error .020 there; of the table, through
/// its three inputs, .073.
HEARTH_CONSTANT SpecularFit kSpecularFit =
    SpecularFit(-0.4416f, 0.1565f, -0.0127f, -0.5816f, 2.0072f, 2.1856f, -2.8820f, 0.3663f);

HEARTH_FUNCTION Half evaluateSpecularFit(HEARTH_IN(SpecularFit) fit, float cos_aperture, float roughness,
                                         float n_dot_v, float n_dot_axis, float r_dot_axis)
{
    float cosine = specularClamp(cos_aperture, 0.0f, 1.0f);
    Half facing = specularClamp(n_dot_v, 0.0f, 1.0f);
    Half grazing = 1.0f - facing;
    Half rough = specularClamp(roughness, kMinSpecularRoughness, 1.0f);
    Half alpha = rough * rough;
    Half width =
        alpha * (1.0f + fit.width_alpha * alpha + (fit.width_grazing + fit.width_both * alpha) * grazing);
    Half turn =
        alpha * (fit.turn + fit.turn_alpha * alpha + (fit.turn_grazing + fit.turn_both * alpha) * grazing);

    // the lobe's middle lies between R and N; its cosines with axis and normal follow
    Half to_normal = specularClamp(turn, 0.0f, 1.0f);
    Half to_mirror = 1.0f - to_normal;
    Half shrink =
        1.0f / sqrt(max(to_mirror * to_mirror + to_normal * to_normal + 2.0f * to_mirror * to_normal * facing,
                        0.0625f));
    float middle_axis =
        specularClamp((to_mirror * r_dot_axis + to_normal * n_dot_axis) * shrink, -1.0f, 1.0f);
    float middle_normal = specularClamp((to_mirror * facing + to_normal) * shrink, 0.0f, 1.0f);

    float above = specularCap(0.0f, middle_normal, width);
    float inside = specularCap(cosine, middle_axis, width);
    float below = max(sqrt(max(1.0f - cosine * cosine, 0.0f)) - n_dot_axis, 0.0f);
    return specularClamp(inside / above * (1.0f - fit.loss * alpha * below), 0.0f, 1.0f);
}

/// Return S for a cone of any direction, without a table, a texture or a transcendental function.
/// cos_aperture  cosine of the cone's half-angle, 0 to 1
/// roughness     0 to 1; GGX alpha is its square
/// n_dot_v, n_dot_axis, r_dot_axis  cosines between the normal, the view, the cone's axis and the reflection
///                                  vector
HEARTH_FUNCTION Half specularOcclusionFit(float cos_aperture, float roughness, float n_dot_v,
                                          float n_dot_axis, float r_dot_axis)
{
    return evaluateSpecularFit(kSpecularFit, cos_aperture, roughness, n_dot_v, n_dot_axis, r_dot_axis);
}

HEARTH_SHARED_END

#endif

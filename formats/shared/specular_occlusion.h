// How much of a GGX lobe a visibility cone lets through, written once for C++ and GLSL: by a fit without a texture, and
// where to look in the table of chunk SPOC. README.md of cook/specular has the derivation and what was measured.
//
// Both give the share S of the horizon-clipped lobe (Fresnel left out) that falls into the cone: what a surface
// reflects is S times the cone's scale times its usual image-based specular light.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_SPECULAR_OCCLUSION_H
#define HEARTH_SHARED_SPECULAR_OCCLUSION_H

#include "formats/shared/language.h"

HEARTH_SHARED_BEGIN

/// The table has so many nodes each way: aperture, roughness, cosine between reflection vector and cone axis.
HEARTH_CONSTANT uint kSpecularNodes = 16;

/// Roughness of the table's first node; below, the lobe is taken as wide as here. The last node is 1.
HEARTH_CONSTANT float kSpecularLeastRoughness = 0.089f;

/// How nodes lie on the axis of beta, the angle between reflection vector and cone axis.
HEARTH_CONSTANT uint kSpecularSpacingCosine = 0;   ///< uniform in cos(beta)
HEARTH_CONSTANT uint kSpecularSpacingHalfSine = 1; ///< uniform in 1 - sin(beta / 2): dense around the lobe

HEARTH_FUNCTION float specularClamp(float value, float low, float high)
{
    return min(max(value, low), high);
}

/// Where the table is looked up: each in [0, 1], node i at i / 15. x aperture, y roughness, z beta; 1 is a full
/// hemisphere, roughness 1, the axis along the reflection vector. Texel x is next to texel x + 1 in memory, y is 16
/// texels farther, z 256.
/// cos_aperture  of the cone's half-angle, 0 to 1
/// spacing       kSpecularSpacing*, of the table
HEARTH_FUNCTION Float3 specularTablePlace(float cos_aperture, float roughness, float cos_beta, uint spacing)
{
    float aperture = acos(specularClamp(cos_aperture, 0.0f, 1.0f)) * 0.636619772f;
    float rough = (roughness - kSpecularLeastRoughness) / (1.0f - kSpecularLeastRoughness);
    float half_chord = specularClamp(0.5f - 0.5f * cos_beta, 0.0f, 1.0f);
    float beta = spacing == kSpecularSpacingCosine ? 1.0f - half_chord : 1.0f - sqrt(half_chord);
    return Float3(specularClamp(aperture, 0.0f, 1.0f), specularClamp(rough, 0.0f, 1.0f), beta);
}

/// The same for a texture of 16 x 16 x 16 texels that is filtered linearly and clamped: its nodes are texel centres.
HEARTH_FUNCTION Float3 specularTableTexture(Float3 place)
{
    return Float3(place.x * 0.9375f + 0.03125f, place.y * 0.9375f + 0.03125f, place.z * 0.9375f + 0.03125f);
}

/// Share of a lobe inside a cone at normal incidence, exactly: the slopes of half-vectors are the stereographic image of
/// the sphere of directions, so that a cone is a disc of slopes, and GGX's slopes are the image of an evenly covered
/// sphere.
/// beta   angle between the middles of lobe and cone
/// width  GGX alpha of the lobe
HEARTH_FUNCTION float specularCap(float half_angle, float beta, float width)
{
    float outer = atan2(sin((beta + half_angle) * 0.5f), width * cos((beta + half_angle) * 0.5f));
    float inner = atan2(sin((beta - half_angle) * 0.5f), width * cos((beta - half_angle) * 0.5f));
    float share = sin((outer - inner) * 0.5f);
    return share * share;
}

/// S for a cone of any direction, without a table. rms .032 against quadrature.
/// cos_aperture  of the cone's half-angle, 0 to 1
/// roughness     0 to 1; GGX alpha is its square
/// n_dot_v, n_dot_axis, r_dot_axis  cosines between the normal, the view, the cone's axis and the reflection vector
HEARTH_FUNCTION float specularOcclusionFit(float cos_aperture, float roughness, float n_dot_v,
                                           float n_dot_axis, float r_dot_axis)
{
    float half_angle = acos(specularClamp(cos_aperture, 0.0f, 1.0f));
    float theta_o = acos(specularClamp(n_dot_v, 0.0f, 1.0f));
    float theta_c = acos(specularClamp(n_dot_axis, -1.0f, 1.0f));
    float beta = acos(specularClamp(r_dot_axis, -1.0f, 1.0f));
    float rough = specularClamp(roughness, kSpecularLeastRoughness, 1.0f);
    float alpha = rough * rough;
    float grazing = 1.0f - specularClamp(n_dot_v, 0.0f, 1.0f);
    float width = max(alpha * (1.0f - 0.1216f * alpha + (0.3584f - 0.1958f * alpha) * grazing), 0.0001f);
    float above = specularCap(1.57079633f, theta_o * (1.0f - 0.2228f * alpha), width);
    float cut =
        specularClamp((half_angle + theta_c - 1.57079633f) / max(2.0f * half_angle, 0.0001f), 0.0f, 1.0f);
    float inside = specularCap(half_angle, beta * (1.0f - 0.226f * alpha), width);
    return specularClamp(inside * (1.0f - (1.5542f * alpha - 0.0326f) * cut) / pow(above, 1.3511f), 0.0f,
                         1.0f);
}

HEARTH_SHARED_END

#endif

// Sheen of fabrics: light that upright fibres scatter, strongest at grazing angles. One source for C++ and
// GLSL.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_SHEEN_H
#define HEARTH_SHARED_SHEEN_H

#include "formats/gpu_shared/light_cone.h"

// KHR_materials_sheen: the distribution of A. C. Estevez, C. Kulla, "Production friendly microfacet sheen
// BRDF", 2017, with the visibility of D. Neubelt, M. Pettineo, "Crafting a next-gen material pipeline for The
// Order: 1886", 2013. Smooth sheen reflects more light than arrives at grazing angles, up to 6 times, so that
// a lobe whose albedo exceeds 1 is scaled to 1.
//
// The table has the columns and rows of the reflectance table, whose cosines are the same, and lies below it
// in one texture. Between nodes the albedo, up to 1, is within .005 of the integral
// (tests/formats/sheen_test.cpp).

HEARTH_SHARED_BEGIN

#ifdef __cplusplus
using std::pow;
#endif

/// Roughness of the first row; a smaller roughness is clamped to it. Smoother sheen is seen only within 6
/// degrees of the horizon.
HEARTH_CONSTANT Half kMinSheenRoughness = 0.07f;

/// Values of the table.
struct SheenTotal
{
    Half albedo;         ///< share of constant light that a white lobe reflects; may exceed 1
    Half lean;           ///< sine of the angle from the normal to the mean direction, towards the view
    Half cos_half_angle; ///< [0, 1], of the cone from which the lobe gets its light
};

HEARTH_FUNCTION Half clampSheenRoughness(Half roughness)
{
    return min(max(roughness, kMinSheenRoughness), 1.0f);
}

/// Return the coordinates of a lookup, as reflectanceCoordinates().
HEARTH_FUNCTION Half2 sheenCoordinates(Half roughness, Half n_dot_v)
{
    Half rough = (clampSheenRoughness(roughness) - kMinSheenRoughness) / (1.0f - kMinSheenRoughness);
    return Float2(sqrt(sqrt(min(max(n_dot_v, 0.0f), 1.0f))), sqrt(rough));
}

/// Return cosine (x) and roughness (y) of a node.
HEARTH_FUNCTION Float2 sheenNode(uint column, uint row)
{
    float x = float(column) / float(kReflectanceColumns - 1u);
    float y = float(row) / float(kReflectanceRows - 1u);
    return Float2(x * x * x * x, kMinSheenRoughness + (1.0f - kMinSheenRoughness) * y * y);
}

/// Return distribution times visibility of white sheen, before its limit.
/// roughness  perceptual, at least kMinSheenRoughness
HEARTH_FUNCTION float sheenLobe(float roughness, float n_dot_h, float n_dot_l, float n_dot_v)
{
    float exponent = 1.0f / (roughness * roughness);
    float sine2 = max(1.0f - n_dot_h * n_dot_h, 0.0f);
    float distribution = (2.0f + exponent) * pow(sine2, 0.5f * exponent) * 0.159154943f;
    return distribution * 0.25f / max(n_dot_l + n_dot_v - n_dot_l * n_dot_v, 1e-5f);
}

/// Return the factor that limits a lobe's albedo to 1.
HEARTH_FUNCTION Half sheenLimit(HEARTH_IN(SheenTotal) total)
{
    return 1.0f / max(total.albedo, 1.0f);
}

/// Return the share of light that sheen leaves to what is below.
HEARTH_FUNCTION Half belowSheen(Half3 color, HEARTH_IN(SheenTotal) total)
{
    return 1.0f - max(max(color.x, color.y), color.z) * min(total.albedo, 1.0f);
}

/// Return the cone of the lobe under an open sky.
/// to_eye, normal  unit
HEARTH_FUNCTION LightCone sheenCone(HEARTH_IN(SheenTotal) total, Float3 to_eye, Float3 normal)
{
    Float3 across = to_eye - normal * dot(normal, to_eye);
    float along = total.lean / sqrt(max(dot(across, across), 1e-8f));
    LightCone cone;
    cone.axis = normal * sqrt(max(1.0f - total.lean * total.lean, 0.0f)) + across * along;
    cone.cos_half_angle = total.cos_half_angle;
    return cone;
}

HEARTH_SHARED_END

#endif

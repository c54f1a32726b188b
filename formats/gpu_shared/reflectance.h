// Reflection of constant light by a GGX surface (directional albedo), with the light that microfacets scatter
// several times, and the cone that a lobe sees. One source for C++ and GLSL.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_REFLECTANCE_H
#define HEARTH_SHARED_REFLECTANCE_H

#include "formats/gpu_shared/language.h"
#include "formats/gpu_shared/precision.h"

// A lobe of height-correlated masking reflects f0 * scale + bias after one scattering, with Schlick's Fresnel
// term (B. Karis, "Real shading in Unreal Engine 4", 2013). A table has both for 64 cosines and 32
// roughnesses. They change most where cosine and GGX alpha are near 0; roots put the nodes there. Between
// nodes both are within .005 of the integral (tests/formats/reflectance_test.cpp).
//
// One scattering loses light: 69 % at roughness 1 and normal incidence. E. Turquin, "Practical multiple
// scattering compensation for microfacet models", 2019, scales a lobe by 1 + f0 (1 / E - 1), with E the
// reflectance of f0 = 1: a white metal reflects all light. The diffuse part gets what the specular part of
// the dielectric leaves, so that a white dielectric, and each mixture of both, reflects all light, too.
//
// The table also has the cone from which a lobe gets its light: how far its mean direction is turned from the
// mirror direction to the normal, and the cosine of the half-angle.

HEARTH_SHARED_BEGIN

/// Nodes of the table: cosines are columns, roughnesses rows.
HEARTH_CONSTANT uint kReflectanceColumns = 64;
HEARTH_CONSTANT uint kReflectanceRows = 32;

/// Image with the tables that shading samples, since a stage has few images: this one, beside it that of
/// sheen.h, below both that of sky.h. Its sides are powers of two, so that coordinates are exact.
HEARTH_CONSTANT uint kShadingTablesWidth = 128;
HEARTH_CONSTANT uint kShadingTablesHeight = 64;
HEARTH_CONSTANT uint kSheenTableColumn = 64;
HEARTH_CONSTANT uint kSkyTableRow = 32;

/// Roughness of the first row; a smaller roughness is clamped to it, as in shading.
HEARTH_CONSTANT Half kMinReflectanceRoughness = 0.045f;

/// Reflectance at normal incidence of dielectrics with an index of refraction of 1.5, and of clear coats.
HEARTH_CONSTANT Half kDielectricF0 = 0.04f;

/// Reflectance of a dielectric: at normal incidence, and at grazing angles.
struct DielectricReflectance
{
    Half3 f0;
    Half f90;
};

/// Values of the table.
struct LobeTotal
{
    Half scale;
    Half bias;
    Half turn;           ///< mean direction of the lobe: (1 - turn) mirror direction + turn normal
    Half cos_half_angle; ///< [0, 1]
};

/// Return the coordinates of a lookup, each in [0, 1], the first node at 0, the last at 1: x is the cosine, y
/// the roughness.
/// roughness  perceptual
/// n_dot_v    cosine between normal and view, [0, 1]
HEARTH_FUNCTION Half2 reflectanceCoordinates(Half roughness, Half n_dot_v)
{
    Half rough = (roughness - kMinReflectanceRoughness) / (1.0f - kMinReflectanceRoughness);
    return Float2(sqrt(sqrt(min(max(n_dot_v, 0.0f), 1.0f))), sqrt(min(max(rough, 0.0f), 1.0f)));
}

/// Return cosine (x) and roughness (y) of a node.
HEARTH_FUNCTION Float2 reflectanceNode(uint column, uint row)
{
    float x = float(column) / float(kReflectanceColumns - 1u);
    float y = float(row) / float(kReflectanceRows - 1u);
    return Float2(x * x * x * x, kMinReflectanceRoughness + (1.0f - kMinReflectanceRoughness) * y * y);
}

/// Return the reflectance of dielectrics without KHR_materials_ior and KHR_materials_specular.
HEARTH_FUNCTION DielectricReflectance defaultDielectric()
{
    DielectricReflectance found;
    found.f0 = Float3(kDielectricF0, kDielectricF0, kDielectricF0);
    found.f90 = 1.0f;
    return found;
}

/// Return the reflectance of a dielectric by KHR_materials_specular.
/// f0        reflectance of the index of refraction times the specular colour
/// specular  strength, [0, 1]
HEARTH_FUNCTION DielectricReflectance specularDielectric(Half3 f0, Half specular)
{
    DielectricReflectance found;
    found.f0 = Float3(min(f0.x, 1.0f), min(f0.y, 1.0f), min(f0.z, 1.0f)) * specular;
    found.f90 = specular;
    return found;
}

/// Return the share of constant light that a lobe reflects after one scattering.
/// f90  reflectance at grazing angles
HEARTH_FUNCTION Half3 onceScattered(Half3 f0, Half f90, HEARTH_IN(LobeTotal) lobe)
{
    Half bias = lobe.bias * f90;
    return f0 * lobe.scale + Float3(bias, bias, bias);
}

/// Return the share of constant light that a lobe reflects, with several scatterings.
HEARTH_FUNCTION Half3 lobeAlbedo(Half3 f0, Half f90, HEARTH_IN(LobeTotal) lobe)
{
    return onceScattered(f0, f90, lobe) *
           (Float3(1.0f, 1.0f, 1.0f) + f0 * (1.0f / (lobe.scale + lobe.bias) - 1.0f));
}

/// Return what a lobe of one scattering is multiplied by to reflect its albedo.
/// once  what it reflects after one scattering; 0 where a smooth black surface is seen along its normal
HEARTH_FUNCTION Half scatteringFactor(float albedo, float once)
{
    return albedo / max(once, 1e-7f);
}

/// Directional albedos of a surface.
struct SurfaceAlbedo
{
    Half3 diffuse;
    Half3 specular;
    Half3 scattering; ///< factor of the lobe that adds the light of several scatterings
    Half3 f0;
    Half f90;
};

/// Return the albedos of a mixture of dielectric and metal.
/// base  base colour
HEARTH_FUNCTION SurfaceAlbedo surfaceAlbedo(Half3 base, Half metallic,
                                            HEARTH_IN(DielectricReflectance) dielectric,
                                            HEARTH_IN(LobeTotal) lobe)
{
    Half3 reflected = lobeAlbedo(dielectric.f0, dielectric.f90, lobe);
    SurfaceAlbedo albedo;
    albedo.f0 = base * metallic + dielectric.f0 * (1.0f - metallic);
    // a constant of most pipelines: they leave the mixture out
    albedo.f90 = dielectric.f90 == 1.0f ? 1.0f : metallic + dielectric.f90 * (1.0f - metallic);
    albedo.specular = lobeAlbedo(base, 1.0f, lobe) * metallic + reflected * (1.0f - metallic);
    albedo.diffuse = base * ((1.0f - metallic) * (1.0f - max(max(reflected.x, reflected.y), reflected.z)));
    Half3 once = onceScattered(albedo.f0, albedo.f90, lobe);
    albedo.scattering =
        Float3(scatteringFactor(albedo.specular.x, once.x), scatteringFactor(albedo.specular.y, once.y),
               scatteringFactor(albedo.specular.z, once.z));
    return albedo;
}

HEARTH_SHARED_END

#endif

// Looks up the table of reflection on the CPU as shaders do on the GPU (C++ only).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/reflectance.h"
#include "formats/records/material_layers.h"
#include "formats/scene/reflectance_table.h"

namespace hearth::shared
{

static_assert(kReflectanceTable.size() == kReflectanceColumns * kReflectanceRows);

/// Interpolate between four nodes of the table.
/// roughness  perceptual
/// n_dot_v    cosine between normal and view, [0, 1]
LobeTotal lobeTotal(float roughness, float n_dot_v);

/// Return the reflectance at normal incidence of a material's dielectric part, by Fresnel's equations against
/// air, before `specular` and textures.
Float3 dielectricF0(const formats::MaterialLayersRecord& layers);

/// Return the share of the light from all sides that a surface reflects to all sides, by diffuse and specular
/// reflection together (bihemispherical reflectance): the mean of its albedo over views, weighted by the
/// cosine. Scattering between surfaces needs this one colour. A dielectric of roughness 1 and a base colour
/// of .2 reflects .216.
/// base       base colour, [0, 1]
/// roughness  perceptual
Float3 bihemisphericalReflectance(Float3 base, float metallic, const DielectricReflectance& dielectric,
                                  float roughness);

} // namespace hearth::shared

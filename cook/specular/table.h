// Table of specular occlusion: 16 x 16 x 16 nodes of aperture, roughness and angle to the reflection vector.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/specular/lobe.h"
#include "formats/records/specular.h"

#include <array>

namespace hearth::specular
{

using formats::SpecularSpacing;

/// Default direction of the normal that the table assumes: of 0, 0.1, ... 1 the value with the least rms
/// error on random configurations. The talk that the table comes from takes 0.78 (GDC 2023, "Practical mobile
/// rendering").
inline constexpr double kDefaultNormalLambda = 0.4;

struct TableSettings
{
    Masking masking = Masking::correlated;
    double normal_lambda = kDefaultNormalLambda; ///< 0 to 1; SpecularTableRecord has its definition
    SpecularSpacing spacing = SpecularSpacing::cosine;
};

/// Values of the nodes in the order of SpecularTableRecord::values.
using TableValues = std::array<float, formats::kSpecularTexels>;

/// Lobe and cone axis that the table assumes if reflection vector and axis are beta radians apart.
/// N = (0, 0, 1).
struct AssumedLobe
{
    Lobe lobe;
    Double3 axis;
};
AssumedLobe assumeLobe(double roughness, double beta, const TableSettings& settings);

/// Compute all nodes, exact to 1e-5, never falling along the aperture. The same for any number of threads.
TableValues cookTable(const TableSettings& settings);

/// Convert to and from the stored record, with values rounded to 8 bits.
formats::SpecularTableRecord packTable(const TableValues& values, const TableSettings& settings);
TableValues unpackTable(const formats::SpecularTableRecord& record);

/// Look up like a texture unit: linear between the nodes of shared::specularTableCoordinates.
float lookUp(const TableValues& values, SpecularSpacing spacing, float cos_aperture, float roughness,
             float cos_beta);

} // namespace hearth::specular

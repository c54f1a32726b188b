// The table of specular occlusion: 16 x 16 x 16 nodes of aperture, roughness and angle to the reflection vector.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/specular/lobe.h"
#include "formats/records/specular.h"

#include <array>

namespace hearth::specular
{

using formats::SpecularSpacing;

/// Where the table assumes the normal: of 0, 0.1, ... 1 the least rms error on random configurations. The talk that the table
/// is from takes 0.78 (GDC 2023, "Practical mobile rendering").
inline constexpr double kDefaultNormalLambda = 0.4;

struct TableSettings
{
    Masking masking = Masking::correlated;
    double normal_lambda = kDefaultNormalLambda; ///< 0 to 1; SpecularTableRecord says what it means
    SpecularSpacing spacing = SpecularSpacing::cosine;
};

/// In the order of SpecularTableRecord::values.
using TableValues = std::array<float, formats::kSpecularTexels>;

/// The lobe that the table assumes where reflection vector and cone axis are beta radians apart, with N = (0, 0, 1); and the
/// axis.
struct AssumedPlace
{
    Lobe lobe;
    Double3 axis;
};
AssumedPlace assumedPlace(double roughness, double beta, const TableSettings& settings);

/// All nodes, exact to 1e-5, never falling along the aperture. The same for any number of threads.
TableValues cookTable(const TableSettings& settings);

/// As stored.
formats::SpecularTableRecord packTable(const TableValues& values, const TableSettings& settings);
TableValues unpackTable(const formats::SpecularTableRecord& record);

/// What a texture unit finds: linear between the nodes of shared::specularTablePlace.
float lookUp(const TableValues& values, SpecularSpacing spacing, float cos_aperture, float roughness,
             float cos_beta);

} // namespace hearth::specular

// Density of texture coordinates on a cluster, by which the runtime knows which mips a view wants.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

#include <cstdint>
#include <span>

namespace hearth::clusters
{

/// Return the code of a density: the greatest c from 1 to 255 with 2^((c - 128) / 8) <= density, else 1.
/// density  UV units a metre, >= 0
uint8_t encodeUvDensity(double density);

/// Return the density that all but a twentieth of the area exceeds, in UV units a metre: on a triangle the
/// smaller singular value of the map from surface to UV, but an eighth of the greater at least, as samplers
/// of eightfold anisotropy choose mips. 0 if no triangle has an area.
///
/// places  three corners of each triangle
/// uvs     of the corners
double measureUvDensity(std::span<const Float3> places, std::span<const Float2> uvs);

} // namespace hearth::clusters

// Triangles on the zero of a signed distance, taken from a regular grid.
// S. F. F. Gibson, "Constrained Elastic Surface Nets", 1998, without the relaxation: vertices are moved onto the zero.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/shapes/document.h"

#include <functional>

namespace hearth::samples
{

/// Positions, normals (the distance's gradient) and indices. `distance` is negative inside, and is called from
/// several threads. The surface must lie inside `bounds`.
TriangleMesh surfaceOf(const std::function<float(Float3)>& distance, const Box3& bounds, float cell);

} // namespace hearth::samples

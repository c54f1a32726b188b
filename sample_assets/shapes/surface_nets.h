// Polygonises the zero of a signed distance function on a regular grid. S. F. F. Gibson, "Constrained Elastic
// Surface Nets", 1998, without the relaxation: vertices are moved to the zero instead.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/shapes/document.h"

#include <functional>

namespace hearth::samples
{

/// Return positions, normals (the gradient of the distance) and indices. `distance` is negative inside, and
/// is called from several threads. The surface must lie inside `bounds`.
TriangleMesh polygonise(const std::function<float(Float3)>& distance, const Box3& bounds, float cell);

} // namespace hearth::samples

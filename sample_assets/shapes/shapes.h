// Builds and edits simple meshes: grids, boxes, surfaces of revolution; transforms and normals.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/shapes/document.h"

#include <functional>

namespace hearth::samples
{

/// Make a grid of columns x rows quads over the unit square; `vertex` sets position and UV from (u, v) in [0,
/// 1]. Triangles are counter-clockwise seen from the side that u x v points to.
TriangleMesh makeGrid(uint32_t columns, uint32_t rows,
                      const std::function<void(Float2 uv, Float3& position, Float2& texture_uv)>& vertex);

/// Make a box with sides [center - half, center + half]; UVs in metres times uv_per_metre, one chart a side.
TriangleMesh makeBox(Float3 center, Float3 half, float uv_per_metre);

/// Make the same box from its lowest and highest corner.
TriangleMesh makeBlock(Float3 low, Float3 high, float uv_per_metre);

/// Make a surface of revolution about +Y through the (radius, height) points of `profile`, from top to bottom
/// outside.
TriangleMesh makeLathe(const std::vector<Float2>& profile, uint32_t segments);

/// Append `part` to `mesh`; both must have the same attributes unless `mesh` is empty.
void append(TriangleMesh& mesh, const TriangleMesh& part);

/// Return the mesh scaled, rotated and translated, normals included (scale must not be zero).
TriangleMesh transformed(TriangleMesh mesh, const Placement& placement);

/// Set area-weighted normals, smooth across vertices of the same position (UV seams stay invisible).
void setSmoothNormals(TriangleMesh& mesh);

/// Set flat normals: every vertex must be used by triangles of one plane only.
void setFlatNormals(TriangleMesh& mesh);

} // namespace hearth::samples

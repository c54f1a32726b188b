// Building blocks of meshes: grids, boxes, tubes, cards, and what is done to them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/shapes/document.h"

#include <functional>

namespace hearth::samples
{

/// Grid of columns x rows quads over the unit square; `vertex` sets position and UV from (u, v) in [0, 1].
/// Triangles are counter-clockwise seen from the side where u x v points to.
TriangleMesh makeGrid(uint32_t columns, uint32_t rows,
                      const std::function<void(Float2 uv, Float3& position, Float2& texture_uv)>& vertex);

/// Box with sides [center - half, center + half]; UVs in metres times uv_per_metre, a chart a side.
TriangleMesh makeBox(Float3 center, Float3 half, float uv_per_metre);

/// Surface of revolution about +Y through the (radius, height) points of `profile`, from top to bottom outside.
TriangleMesh makeLathe(const std::vector<Float2>& profile, uint32_t segments);

/// Append `part` to `mesh`; both must have the same attributes unless `mesh` is empty.
void append(TriangleMesh& mesh, const TriangleMesh& part);

/// The mesh scaled, turned and moved; normals follow (scale must not be zero).
TriangleMesh placed(TriangleMesh mesh, const Placement& placement);

/// Area-weighted normals, smooth across vertices of the same position (UV seams stay invisible).
void setSmoothNormals(TriangleMesh& mesh);

/// One normal for each triangle's corner: every vertex must be used by triangles of one plane only.
void setFlatNormals(TriangleMesh& mesh);

} // namespace hearth::samples

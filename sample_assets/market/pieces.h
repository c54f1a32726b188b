// Builds the simple closed shapes that the market's things are made of, and places copies of meshes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/shapes/document.h"

#include <functional>

namespace hearth::samples::market
{

/// Make a box from its lowest and highest corner; UVs in metres.
TriangleMesh makeBlock(Float3 low, Float3 high);

/// Make an ellipsoid about the origin.
/// half      half axes, metres
/// segments  around the Y axis; half as many rows
TriangleMesh makeBall(Float3 half, uint32_t segments);

/// Make a closed rod between two points.
TriangleMesh makeRod(Float3 from, Float3 to, float radius, uint32_t segments = 8);

/// Make a closed tube about +Y through the (radius, height) points of `profile`, from top to bottom; ends
/// with a radius above 0 get a cap.
TriangleMesh makeTurned(std::vector<Float2> profile, uint32_t segments);

/// Make a closed sheet, such as cloth: a surface over the unit square, and the same surface `thickness`
/// metres below it. Its front is the side that u x v points to.
/// surface  returns the position of (u, v)
TriangleMesh makeSheet(uint32_t columns, uint32_t rows, float thickness,
                       const std::function<Float3(Float2 uv)>& surface);

/// Return the mesh at another place.
TriangleMesh moved(TriangleMesh mesh, Float3 by);

/// Return the mesh with one linear colour at all vertices.
TriangleMesh tinted(TriangleMesh mesh, Float3 color);

/// Return a placement at `position`, turned about +Y so that +Z looks along (sin, 0, cos) of the heading.
Placement standing(Float3 position, float heading_rad, float scale = 1);

/// Return a point of a placement's own frame in the frame around it.
Float3 fromPlacement(const Placement& placement, Float3 point);

} // namespace hearth::samples::market

// Triangulates polygons by ear clipping.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::import
{

/// Append the corners.size() - 2 triangles of a polygon to `triangles`, three corner numbers each, with the
/// winding of the polygon. Concave polygons are filled exactly; a quad is split at the better diagonal.
/// Polygons that intersect themselves or have no area give the same number of triangles.
///
/// corners   3 or more, finite, in order
/// limits    above about 500 point tests per corner (huge polygons with many concave corners) the rest
///           becomes a fan
/// source    G. Meisters, "Polygons have ears", 1975: ears are cut off until a triangle is left, in the plane
///           of the polygon's mean normal (Newell)
void triangulatePolygon(std::span<const Float3> corners, std::vector<uint32_t>& triangles);

} // namespace hearth::import

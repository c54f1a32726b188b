// Polygons to triangles.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::import
{

/// Append the corners.size() - 2 triangles of a polygon to `triangles`, three corner numbers each, turning as the
/// polygon does. Concave polygons are filled exactly; of a quad the better diagonal is taken. Polygons that cross
/// themselves or have no area still give as many triangles.
///
/// corners   3 or more, finite, in order
/// limits    above about 500 point tests a corner (huge polygons with many concave corners) the rest becomes a fan
/// source    G. Meisters, "Polygons have ears", 1975: an ear is cut off until a triangle is left, in the plane of the
///           polygon's mean normal (Newell)
void triangulatePolygon(std::span<const Float3> corners, std::vector<uint32_t>& triangles);

} // namespace hearth::import

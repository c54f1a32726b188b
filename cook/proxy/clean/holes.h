// Fills small holes of a manifold surface.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/proxy/surface/surface.h"

#include <cstdint>

namespace hearth::proxy
{

struct HoleStatistics
{
    uint32_t filled = 0;
    uint32_t open = 0; ///< boundary loops that are left
};

/// Fill the holes whose boundary loops are at most `max_length` metres long, by the triangles of least
/// area (G. Barequet, M. Sharir, "Filling gaps in the boundary of a polyhedron", 1995), with the material
/// next to them. A loop is no hole if filling it would add more than a tenth to the area of its piece: it
/// is the outline of a sheet. Loops of more than 64 edges stay open, and those whose filling would join
/// vertices a second time.
/// surface  a manifold: each edge has one triangle or two, each vertex one fan
HoleStatistics fillHoles(Surface& surface, float max_length);

} // namespace hearth::proxy

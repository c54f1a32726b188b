// Interpolates visibility at the vertices of levels that are finer than the fitted one.
// See cook/visibility/README.md, "Finer levels".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/fit/level_fit.h"

#include <vector>

namespace hearth::visibility
{

/// Return the moments at a point whose normal is `to`, near one with the normal `from`: what both hemispheres
/// see, if the moments' visibility has the same density everywhere in its own. Exact above an open plane.
/// from, to  unit
Moments tiltHemisphere(const Moments& moments, Float3 from, Float3 to);

/// Interpolate the moments of finer levels from those of a fitted level: at the closest point that faces the
/// same way, and then for the vertex's own normal. Vertices that the next coarser level also has keep its
/// bits, so that mixed cuts have no jumps, and copies of a vertex have one value. The same bits for any
/// number of threads.
/// levels  finest first; the last one is the fitted one, the others have `first_copy`: vertices with the same
///         one have one value, even if their normals differ
/// fitted  moments of its vertices; copies have one value
/// returns moments of the vertices of all levels but the last
std::vector<std::vector<Moments>> interpolateFinerLevels(std::span<const LevelMesh> levels,
                                                         std::span<const Moments> fitted);

} // namespace hearth::visibility

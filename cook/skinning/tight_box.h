// A tighter box of a cluster where joints that move together make much of what they could do apart impossible.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/skinning/deformed_cluster.h"

namespace hearth::skinning
{

/// Whether a box is so much larger than what the cluster reaches in a few poses that tightening it may pay.
bool isLoose(const motion::Box3d& box, uint32_t main, const DeformedCluster& cluster,
             const Deformation& deformation, std::span<const MorphedVertex> vertices);

/// The box of the cluster in joint `main` over all regions of poses: those in which a vertex may get farther out than in
/// the poses that were looked at are cut in halves, the worst first, until none is left or the work is done. It holds in
/// any case.
///
/// box   that holds already
/// work  how much may be done: one for each influence of a vertex that is looked at, about 10 ns
/// returns  a box inside of it
motion::Box3d tightened(const motion::Box3d& box, uint32_t main, const DeformedCluster& cluster,
                        const Deformation& deformation, std::span<const MorphedVertex> vertices, size_t work);

} // namespace hearth::skinning

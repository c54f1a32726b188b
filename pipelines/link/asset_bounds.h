// Where a source stands: the box that chunk ASST states.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

namespace hearth::link
{

/// Returns the box, in world space and at rest, of all that the source draws, from the boxes of its meshes; of deformed meshes
/// from those of their finest clusters, where the joints that move these stand. Rounded outwards; empty where nothing is drawn.
/// The parts need not be checked: records that refer to nothing are passed over.
/// errors: those of formats::checkMotion where a mesh is deformed.
Result<Box3> boundsAtRest(const formats::PackView& import_part, const formats::PackView& clusters_part,
                          const formats::PackView& skinning_part);

} // namespace hearth::link

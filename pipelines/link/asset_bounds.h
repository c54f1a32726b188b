// Computes the bounding box of a source for chunk ASST.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

namespace hearth::link
{

/// Return the bounding box, in world space and at rest, of everything that the source draws: from the boxes
/// of its meshes, and for deformed meshes from the boxes of their finest clusters, transformed by the joints
/// that move them. Rounded outwards; empty if nothing is drawn. The parts need not be checked: records with
/// invalid references are skipped.
/// errors: those of formats::checkAnimationTables if a mesh is deformed.
Result<Box3> computeRestBounds(const formats::PackView& import_part, const formats::PackView& clusters_part,
                               const formats::PackView& skinning_part);

} // namespace hearth::link

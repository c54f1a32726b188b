// Bounds of instances over all times of a clip, proven: between samples no node moves farther than its keys
// let it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

namespace hearth::pack
{

/// Return a box in the world that contains the instances at every time of a clip that is played alone; empty
/// where there is nothing to draw. Deformed instances have the box of all poses of the clips, in the place of
/// their anchor. Rotations by splines count as whole turns. Time: linear in the clip's keys, at least its
/// thirtieths of a second, times the nodes above the instances.
/// pack       checked
/// animation  of the pack
/// instances  a range inside of the pack's
Box3 clipBounds(const formats::PackView& pack, uint32_t animation, formats::Range instances);

} // namespace hearth::pack

// Nesting of closed shells: rays decide which of them contain another.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/topology/shells.h"

namespace hearth::topology
{

/// Decide by rays for each closed shell that faces inwards whether solids are around it: then it is a
/// cavity, else it is flipped. A shell that contains it counts +1 where it faces outwards and -1 where
/// it faces inwards, so that an engine's hollow in a car's body is one, and a shell within a flipped
/// one is none.
/// shells  closed ones have their volume; `side` of those that face inwards is set
void judgeInwardShells(const Surface& surface, Shells& shells);

} // namespace hearth::topology

// From levels to what the file holds.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/levels/levels.h"

namespace hearth::clusters
{

/// Turn the levels into records and pages: coarse to fine. The levels give their geometry away.
void writeRecords(Build& build, Hierarchy& hierarchy);

} // namespace hearth::clusters

// Converts levels to the records and pages of the file.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/levels/levels.h"

namespace hearth::clusters
{

/// Turn the levels into records and pages, coarse to fine. Consumes the levels' geometry.
void writeRecords(Build& build, Hierarchy& hierarchy);

} // namespace hearth::clusters

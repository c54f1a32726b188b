// Stored errors of cuts beside their certified distances.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/levels/validate.h"
#include "tests/support/surfaces/certified_distance.h"

#include <cstdint>
#include <vector>

namespace hearth::cuts
{

/// Error of the cut at the error of a level.
struct CutError
{
    uint32_t level = 0;
    size_t triangles = 0;
    double stored = 0; ///< object space: largest position error of its clusters
    DistanceBounds distance;
};

/// Return the largest position error of the clusters that a cut draws: that of the group that each was made
/// from. 0 for a cut of the finest level.
double storedPositionError(const clusters::Hierarchy& hierarchy, std::span<const uint8_t> replaced);

/// Measure the cuts of all levels but the finest against the source, both ways.
std::vector<CutError> certifyLevels(const mesh::SourceMesh& source, const clusters::Hierarchy& hierarchy,
                                    const clusters::DecodedHierarchy& decoded, const DistanceSearch& search);

} // namespace hearth::cuts

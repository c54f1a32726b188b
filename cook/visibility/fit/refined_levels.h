// Refines the cones at the vertices of all levels, stored as moments. See cook/visibility/README.md, "Refined
// cones".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/fit/cone_refine.h"
#include "cook/visibility/fit/level_fit.h"
#include "cook/visibility/rays/rays.h"

namespace hearth::visibility
{

struct RefineGain
{
    uint64_t cones = 0;          ///< without duplicates
    RefineStatistics statistics; ///< distances from the fitted harmonics, over all cones
};

/// Fit second moments like first ones, and replace each vertex's moments by those of the cone whose nine
/// harmonics are nearest. Vertices with equal moments still have equal moments afterwards, and held vertices
/// have those of the next finer level. The same bits for any number of threads.
///
/// samples, second  samples that `fits` were made with, and their second moments
/// fits             result of fitLevels for the first moments, with the same settings; changed
RefineGain refineLevels(std::span<const LevelMesh> levels, std::span<const SurfaceSample> samples,
                        std::span<const SecondMoments> second, const LevelFitSettings& settings,
                        std::vector<LevelFit>& fits);

} // namespace hearth::visibility

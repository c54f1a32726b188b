// Cones refined at the vertices of all levels, stored as the moments that have them. See cook/visibility/README.md, "Refined cones".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/fit/cone_refine.h"
#include "cook/visibility/fit/level_fit.h"
#include "cook/visibility/rays/rays.h"

namespace hearth::visibility
{

struct RefineGain
{
    uint64_t cones = 0;          ///< different ones
    RefineStatistics statistics; ///< over them: distances to the harmonics that were fitted
};

/// Fit second moments like first ones, and give each vertex, instead of its moments, those of the cone whose nine harmonics
/// are nearest. Vertices that had the same moments have the same afterwards, and held ones have those of the level below.
/// The same bits for any number of threads.
///
/// samples, second  of the samples that `fits` were made with, and what they saw
/// fits             fitLevels' of the first moments, with the same settings; changed
RefineGain refineLevels(std::span<const LevelMesh> levels, std::span<const SurfaceSample> samples,
                        std::span<const SecondMoments> second, const LevelFitSettings& settings,
                        std::vector<LevelFit>& fits);

} // namespace hearth::visibility

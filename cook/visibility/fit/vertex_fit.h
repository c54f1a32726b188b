// Fits the values at vertices whose interpolation is nearest to the values of samples on the surface.
// See cook/visibility/README.md, "The fit".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/fit/conjugate_gradients.h"
#include "cook/visibility/fit/fit_settings.h"
#include "cook/visibility/mesh/fit_mesh.h"

#include <vector>

namespace hearth::visibility
{

struct FitStatistics
{
    uint32_t vertices = 0;     ///< of the fit mesh
    uint32_t held = 0;         ///< vertices with a given value
    uint32_t unseen = 0;       ///< vertices of connected components without samples: the open hemisphere
    uint32_t lost_samples = 0; ///< samples on no triangle
    uint32_t clamped = 0;      ///< vertices whose fit was no valid visibility
    uint64_t entries = 0;      ///< of the matrix
    SolveStatistics solve;
};

struct FitResult
{
    std::vector<Moments> moments; ///< for each vertex of the fit mesh
    FitStatistics statistics;
};

/// Known values: `moments` where `is_held`. Empty, or one for each vertex of the fit mesh.
struct HeldVertices
{
    std::span<const uint8_t> is_held;
    std::span<const Moments> moments;
};

/// Fit, and clamp each vertex's moments to what its normal allows (moment_clamp.h). Held vertices keep their
/// bits. Constants are reproduced exactly; all results are finite. The same bits for any number of threads.
/// samples  on the fit mesh: mapSamplesToFitMesh()
/// values   one for each sample
/// source   L. Kavan, A. W. Bargteil, P.-P. Sloan, "Least squares vertex baking", 2011
FitResult fitVertices(const FitMesh& fit_mesh, std::span<const SurfaceSample> samples,
                      std::span<const Moments> values, const FitSettings& settings = {},
                      const HeldVertices& held = {});

} // namespace hearth::visibility

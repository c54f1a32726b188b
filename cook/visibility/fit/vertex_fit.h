// Values at the vertices whose interpolation is nearest to what samples on the surface saw.
// See cook/visibility/README.md, "The fit".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/fit/conjugate_gradients.h"
#include "cook/visibility/fit/fit_settings.h"
#include "cook/visibility/mesh/proxy.h"

#include <vector>

namespace hearth::visibility
{

struct FitStatistics
{
    uint32_t vertices = 0;     ///< of the proxy
    uint32_t held = 0;         ///< of them, with a value given
    uint32_t unseen = 0;       ///< of them, on pieces of the surface without any sample: the open hemisphere
    uint32_t lost_samples = 0; ///< that lie on no triangle
    uint32_t clamped = 0;      ///< vertices whose fit was not the visibility of anything
    uint64_t entries = 0;      ///< of the matrix
    SolveStatistics solve;
};

struct FitResult
{
    std::vector<Moments> moments; ///< for each vertex of the proxy
    FitStatistics statistics;
};

/// Values that are known already: `moments` where `is_held`. Empty, or one for each vertex of the proxy.
struct HeldVertices
{
    std::span<const uint8_t> is_held;
    std::span<const Moments> moments;
};

/// Fit, and bring each vertex' moments back to what its normal allows (moment_clamp.h). Held vertices keep their
/// bits. Constants come back as they are; all results are finite. The same bits for any number of threads.
/// samples  on the proxy: samplesOnProxy()
/// values   one for each sample
/// source   L. Kavan, A. W. Bargteil, P.-P. Sloan, "Least squares vertex baking", 2011
FitResult fitVertices(const Proxy& proxy, std::span<const SurfaceSample> samples,
                      std::span<const Moments> values, const FitSettings& settings = {},
                      const HeldVertices& held = {});

} // namespace hearth::visibility

// The linear system of the vertex fit: sampled mass and the jumps of gradients across edges.
// See cook/visibility/README.md, "The fit".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/fit/conjugate_gradients.h"
#include "cook/visibility/fit/fit_settings.h"
#include "cook/visibility/mesh/proxy.h"

#include <array>

namespace hearth::visibility
{

/// The jump of the gradient across an edge times (A1 + A2), as a sum over its four corners: it is 0 for a function
/// that is linear over the two triangles unfolded into a plane. All 0 where a triangle has no area.
/// returns  factors of a, b, k, l; their unit is a length
std::array<double, 4> gradientJump(std::span<const Float3> positions, const InteriorEdge& edge);

struct NormalEquations
{
    SparseMatrix matrix;
    std::vector<Block4> right;
    std::vector<double> mass;     ///< of each vertex: sum over samples of weight times area
    std::vector<uint32_t> island; ///< of each vertex: the lowest vertex that triangles connect it with
};

/// sum_s area_s (u(s) - f_s)^2 + alpha sum_e jump_e(u)^2 -> min, as matrix u = right. Mass and right-hand side are
/// summed over the same samples, so that constants fit exactly whatever the samples are. Triangles that have too few
/// samples, or only in a row, get a little of a membrane, which constants do not feel either.
/// samples  triangles of the proxy, or kNowhere: not used
/// values   one for each sample
NormalEquations assemble(const Proxy& proxy, std::span<const SurfaceSample> samples,
                         std::span<const Moments> values, const FitSettings& settings);

} // namespace hearth::visibility

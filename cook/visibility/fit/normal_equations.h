// Linear system of the vertex fit: sampled mass, and jumps of the gradient across edges.
// See cook/visibility/README.md, "The fit".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/fit/conjugate_gradients.h"
#include "cook/visibility/fit/fit_settings.h"
#include "cook/visibility/mesh/fit_mesh.h"

#include <array>

namespace hearth::visibility
{

/// Compute the jump of the gradient across an edge times (A1 + A2), as a weighted sum over its four corners.
/// It is 0 for a function that is linear over the two triangles unfolded into a plane. All weights are 0 if a
/// triangle has no area.
/// returns  weights of a, b, k, l; their unit is a length
std::array<double, 4> gradientJump(std::span<const Float3> positions, const mesh::InteriorEdge& edge);

struct NormalEquations
{
    SparseMatrix matrix;
    std::vector<Block4> right;
    std::vector<double> mass;     ///< for each vertex, the sum over samples of weight times area
    std::vector<uint32_t> island; ///< for each vertex, the lowest vertex of its connected component
};

/// Assemble sum_s area_s (u(s) - f_s)^2 + alpha sum_e jump_e(u)^2 -> min as matrix u = right. Mass and
/// right-hand side are summed over the same samples, so that constants fit exactly for any samples. Triangles
/// with too few or collinear samples get a weak membrane, which does not affect constants either.
/// samples  on triangles of the fit mesh, or kInvalidIndex: not used
/// values   one for each sample
NormalEquations assemble(const FitMesh& fit_mesh, std::span<const SurfaceSample> samples,
                         std::span<const Moments> values, const FitSettings& settings);

} // namespace hearth::visibility

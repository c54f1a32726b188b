// Weights of the terms of the vertex fit, and settings of its solver.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>

namespace hearth::visibility
{

struct FitSettings
{
    /// Weight of the jumps of the gradient against the distances from the samples, without a unit. 0.1 lets
    /// through a quarter of the samples' variance that averaging around a vertex would; 0 lets through more
    /// than all of it, 1 blurs and takes three times the iterations.
    double alpha = 0.1;
    /// Maximum of a jump's squared coefficient by the vertex's own area; a jump above it is scaled down.
    /// Between triangles of equal size and shape it is 1 to 2. Where a small or flat triangle meets a large
    /// one it grows with the square of their ratio, and so do iterations: scans took hundreds, with any
    /// fit mesh. Infinity: the sum as published.
    double stiffness = 4;
    /// Membrane of triangles with few or collinear samples: they resist differences between their corners
    /// with up to this share of their area. 0.01 is a third of the resistance of samples everywhere. Without
    /// it, corners follow noise, and models of loose triangles take hundreds of iterations. It fades to 0 as
    /// samples become many: about five well-spread ones. 0: the sum as published.
    double membrane = 0.01;
    bool clamp = true;             ///< clamp results to valid moments; false: values are any four numbers
    double tolerance = 1e-8;       ///< of the solver; stored values have about eight bits
    uint32_t max_iterations = 500; ///< a mesh that needs 40 is already a bad one
};

} // namespace hearth::visibility

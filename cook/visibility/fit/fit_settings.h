// What the vertex fit weighs against what.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>

namespace hearth::visibility
{

struct FitSettings
{
    /// Of the jumps of the gradient, against the distances of the samples: without a unit. 0.1 lets a quarter of the
    /// samples' variance through that averages around a vertex would; 0 lets through more than all of it, 1 blurs and
    /// takes three times the iterations.
    double alpha = 0.1;
    /// The most that the square of a factor of a jump may be, by the area that is the vertex' own; jumps with more
    /// count as much less. Between triangles of one size and shape it is 1 to 2. Where a small or flat one meets a
    /// large one it grows with the square of their ratio, and so do iterations: scans took hundreds, with any proxy.
    /// Infinity: the sum as published.
    double stiffness = 4;
    /// Triangles with few samples, or with samples in a row, resist differences between their corners with up to this
    /// share of their area: 0.01 is a third of what samples all over would say. Else corners follow noise, and models
    /// of loose triangles take hundreds of iterations. It goes to 0 as samples become many: about five well-spread
    /// ones. 0: the sum as published.
    double membrane = 0.01;
    bool clamp = true;             ///< values are moments, and so are results; else any four numbers
    double tolerance = 1e-8;       ///< of the solver; what is stored has eight bits a value or so
    uint32_t max_iterations = 500; ///< a mesh that needs 40 is already a bad one
};

} // namespace hearth::visibility

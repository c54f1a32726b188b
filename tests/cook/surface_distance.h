// Exact distances from points to a triangle surface, by Embree's hierarchy: what the tests measure bounds with.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/math.h"

#include <cstdint>
#include <memory>
#include <span>

namespace hearth
{

class SurfaceDistance
{
public:
    /// triangles  three indices into `positions` for each
    SurfaceDistance(std::span<const Float3> positions, std::span<const uint32_t> triangles);
    ~SurfaceDistance();

    double to(Float3 point) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// The largest distance of `count` points, spread evenly by area over the triangles, and of all their corners, to the
/// surface. The same points in every run.
double largestDistance(std::span<const Float3> positions, std::span<const uint32_t> triangles, size_t count,
                       const SurfaceDistance& surface);

} // namespace hearth

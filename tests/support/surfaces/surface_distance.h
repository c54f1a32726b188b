// Exact distances from points to a triangle surface with Embree's bounding volume hierarchy: the reference
// for tests of error bounds.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace hearth
{

/// Point on a triangle: (1 - v - w) * corner 0 + v * corner 1 + w * corner 2.
struct SurfacePoint
{
    uint32_t triangle = 0;
    double v = 0, w = 0;
};

/// Interpolate values of the vertices at a point.
Float3 valueAt(const SurfacePoint& point, std::span<const Float3> of_vertices,
               std::span<const uint32_t> triangles);

class SurfaceDistance
{
public:
    /// triangles  three indices into `positions` for each
    SurfaceDistance(std::span<const Float3> positions, std::span<const uint32_t> triangles);
    ~SurfaceDistance();

    struct Nearest
    {
        double distance;
        SurfacePoint point;
    };
    /// Thread-safe.
    Nearest nearest(Float3 point) const;
    double to(Float3 point) const { return nearest(point).distance; }

    /// Return the distance to one triangle.
    double toTriangle(Float3 point, uint32_t triangle) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Return about `count` points, spread evenly by area over the triangles. The same points in every run.
std::vector<SurfacePoint> evenlySpread(std::span<const Float3> positions, std::span<const uint32_t> triangles,
                                       size_t count);

/// Return the largest distance to the surface of `count` points, spread evenly by area over the triangles,
/// and of all the triangles' corners. The same points in every run.
double largestDistance(std::span<const Float3> positions, std::span<const uint32_t> triangles, size_t count,
                       const SurfaceDistance& surface);

} // namespace hearth

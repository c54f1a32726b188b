// Traces rays against triangles, with Embree.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace hearth::ray_scene
{

struct TriangleHit
{
    uint32_t triangle;
    float distance; ///< in lengths of the ray's direction
    Float2 weights; ///< of the triangle's corners 1 and 2
};

/// Scene of opaque triangles, which block rays from both sides. Build once, then use from many threads. No
/// ray passes between two triangles with a common edge.
class TriangleRays
{
public:
    /// corners  three of each triangle, finite; kept
    explicit TriangleRays(std::vector<Float3> corners);
    TriangleRays(TriangleRays&&) noexcept;
    TriangleRays& operator=(TriangleRays&&) noexcept;
    ~TriangleRays();

    std::optional<TriangleHit> nearest(Float3 position, Float3 direction) const;
    /// far  in lengths of the direction
    bool occluded(Float3 position, Float3 direction, float far) const;

    /// Return the corners of all triangles.
    std::span<const Float3> corners() const;
    /// Return the three corners of a triangle.
    std::span<const Float3, 3> triangle(size_t triangle) const
    {
        return corners().subspan(3 * triangle).first<3>();
    }

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace hearth::ray_scene

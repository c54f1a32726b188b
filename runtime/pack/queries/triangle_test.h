// Intersects rays with triangles without gaps between neighbours. S. Woop, C. Benthin, I. Wald, "Watertight
// ray/triangle intersection", 2013; in doubles, whose edge functions are 0 for rays through an edge alone.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/pack/queries/box_tree.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace hearth::pack
{

struct TrianglePoint
{
    double t = 0;
    std::array<double, 2> weights{}; ///< barycentric, of the second and third corner
};

/// Ray in whose coordinates it goes along z from the origin.
class TriangleRay
{
public:
    explicit TriangleRay(const Ray& ray)
        : origin_{ray.origin.x, ray.origin.y, ray.origin.z}, begin_(ray.begin)
    {
        const std::array<double, 3> direction{ray.direction.x, ray.direction.y, ray.direction.z};
        for (size_t axis = 1; axis < 3; ++axis)
            z_ = std::abs(direction[axis]) > std::abs(direction[z_]) ? axis : z_;
        x_ = (z_ + 1) % 3;
        y_ = (z_ + 2) % 3;
        shear_x_ = direction[x_] / direction[z_];
        shear_y_ = direction[y_] / direction[z_];
        scale_ = 1 / direction[z_];
    }

    /// Convert a point: x and y are 0 on the ray, z is its t.
    Double3 convert(Double3 point) const
    {
        const std::array<double, 3> from{point.x - origin_[0], point.y - origin_[1], point.z - origin_[2]};
        return {from[x_] - shear_x_ * from[z_], from[y_] - shear_y_ * from[z_], scale_ * from[z_]};
    }

    /// Return true if the ray meets a triangle of converted corners, edges and corners included, at a t from
    /// the ray's begin on and below `end`.
    bool meets(Double3 a, Double3 b, Double3 c, double end, TrianglePoint& point) const
    {
        const double u = c.x * b.y - c.y * b.x, v = a.x * c.y - a.y * c.x, w = b.x * a.y - b.y * a.x;
        if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0))
            return false;
        const double sum = u + v + w;
        if (sum == 0)
            return false;
        point = {(u * a.z + v * b.z + w * c.z) / sum, {v / sum, w / sum}};
        return point.t >= begin_ && point.t < end;
    }

private:
    std::array<double, 3> origin_;
    double begin_;
    size_t x_ = 0, y_ = 0, z_ = 0;
    double shear_x_ = 0, shear_y_ = 0, scale_ = 0;
};

} // namespace hearth::pack

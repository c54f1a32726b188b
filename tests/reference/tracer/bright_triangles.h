// Picks points on the surfaces that shine, and on those that lamps light brightly, such as the inside of
// their shades, so that paths need not find small bright surfaces by chance.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/reference/tracer/shaded_scene.h"

#include <unordered_map>

namespace hearth::reference
{

class BrightTriangles
{
public:
    explicit BrightTriangles(const ShadedScene& scene);

    bool empty() const { return triangles_.empty(); }

    /// Direction to a point that was picked by area and estimated luminance.
    struct Pick
    {
        Double3 direction; ///< unit
        SurfaceHit hit;    ///< instance, cluster and triangle of the point

        /// True if a ray in this direction has met the triangle, and not something in the way.
        bool isMetAt(const ShadedPoint& point) const;
    };
    /// choice, u, v  in [0, 1)
    Pick pick(Double3 position, double choice, double u, double v) const;

    /// Density with which pick() returns the direction of a ray that meets a point, over solid angle.
    double density(const ShadedPoint& point, Double3 direction) const;

private:
    struct Triangle
    {
        SurfaceHit hit;
        Double3 corners[3];
        double cumulated; ///< weights up to this one
    };

    void add(const Triangle& triangle, double luminance);

    std::vector<Triangle> triangles_;
    std::unordered_map<uint64_t, double> luminances_; ///< of triangles_, by instance, cluster and number
    double weight_ = 0;                               ///< sum of area times luminance
};

} // namespace hearth::reference

// Sky of an image for the reference: radiance by direction, and directions picked by their light.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/environment/environment.h"
#include "tests/reference/double3.h"

#include <cstdint>
#include <vector>

namespace hearth::reference
{

class SkyMap
{
public:
    explicit SkyMap(environment::Environment image);

    /// Radiance of a direction, linear between the centres of texels. At the edge of a cube's panel it is
    /// that of the outermost texels.
    Double3 radiance(Double3 direction) const;

    /// Unit direction, picked by the mean luminance of its texel and the eight around it, none of which is
    /// dark where interpolated radiance is not.
    /// choice, u, v  in [0, 1)
    Double3 pick(double choice, double u, double v) const;

    /// Density of pick() over solid angle.
    double density(Double3 direction) const;

private:
    /// Point of a panel in texels, and what an area of the panel's unit square is in solid angle there.
    struct Place
    {
        size_t panel;
        double x, y, solid_angle;
    };
    Place find(Double3 direction) const;

    /// Radiance of a texel, which may lie one beyond the panel: around a lat-long image, else that of the
    /// edge.
    Double3 texel(size_t panel, int64_t x, int64_t y) const;

    environment::Environment image_;
    std::vector<double> cumulated_; ///< [texels]: weights up to each
};

} // namespace hearth::reference

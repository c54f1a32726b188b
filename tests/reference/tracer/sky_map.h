// Sky of an image for the reference: radiance by direction, and directions picked by their light.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/environment/environment.h"
#include "tests/reference/double3.h"

#include <vector>

namespace hearth::reference
{

class SkyMap
{
public:
    explicit SkyMap(environment::Environment image);

    /// Radiance of the texel that a direction is in.
    Double3 radiance(Double3 direction) const;

    /// Unit direction, picked by the luminance of its texel.
    /// choice, u, v  in [0, 1)
    Double3 pick(double choice, double u, double v) const;

    /// Density of pick() over solid angle.
    double density(Double3 direction) const;

private:
    /// Texel of a direction, and what an area of its panel's unit square is in solid angle there.
    struct Place
    {
        size_t texel;
        double solid_angle;
    };
    Place find(Double3 direction) const;

    environment::Environment image_;
    std::vector<double> cumulated_; ///< [texels]: weights up to each
};

} // namespace hearth::reference

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/proxy/convex/lattice.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hearth::proxy
{

Lattice::Lattice(const Surface& surface)
{
    Box3 box;
    for (const Float3 position : surface.positions)
        box.add(position);
    double side = 0, farthest = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
        side = std::max(side, double{box.max[axis]} - double{box.min[axis]});
        farthest = std::max({farthest, std::abs(double{box.max[axis]}), std::abs(double{box.min[axis]})});
    }
    const auto powerAbove = [](double value)
    {
        int exponent = 0;
        std::frexp(value, &exponent);
        return std::ldexp(1.0, exponent);
    };
    // floats have 24 bits; one is left for hulls that grow
    step_ = std::max({powerAbove(side) * 0x1p-18, powerAbove(farthest) * 0x1p-23,
                      double{std::numeric_limits<float>::min()}});
    const Float3 middle = (box.min + box.max) * 0.5f;
    const Double3 steps = widen(middle) * (1 / step_);
    origin_ = {std::round(steps.x), std::round(steps.y), std::round(steps.z)};
}

} // namespace hearth::proxy

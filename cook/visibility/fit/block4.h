// Block of four numbers: the solver processes the four right-hand sides of the fit together.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/mesh/moments.h"

#include <cstddef>

namespace hearth::visibility
{

/// Values of m0 and the three components of m1.
struct alignas(32) Block4
{
    double v[4] = {0, 0, 0, 0};

    void addScaled(const Block4& other, double factor)
    {
        for (size_t k = 0; k < 4; ++k)
            v[k] += other.v[k] * factor;
    }
    void addProduct(const Block4& a, const Block4& b, double factor)
    {
        for (size_t k = 0; k < 4; ++k)
            v[k] += a.v[k] * b.v[k] * factor;
    }
};

inline Block4 blockFromMoments(const Moments& m)
{
    return {{m.m0, m.m1.x, m.m1.y, m.m1.z}};
}

inline Moments momentsFromBlock(const Block4& b)
{
    return {static_cast<float>(b.v[0]),
            {static_cast<float>(b.v[1]), static_cast<float>(b.v[2]), static_cast<float>(b.v[3])}};
}

} // namespace hearth::visibility

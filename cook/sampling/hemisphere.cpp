// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/sampling/hemisphere.h"

#include "cook/sampling/owen_sobol.h"
#include "formats/base/assert.h"

namespace hearth::sampling
{

void hemisphereDirections(uint32_t first, uint64_t seed, const Frame& frame, std::span<float> x,
                          std::span<float> y, std::span<float> z)
{
    HEARTH_ASSERT(x.size() == y.size() && y.size() == z.size());
    const Frame f = frame; // a local copy, which stores cannot alias: compilers see that they can vectorize
    float *const xs = x.data(), *const ys = y.data(), *const zs = z.data();
    const auto count = static_cast<uint32_t>(x.size());
    for (uint32_t i = 0; i < count; ++i)
    {
        const Float3 direction = f.fromLocal(hemisphereDirection(unitPoint(owenSobol(first + i, seed))));
        xs[i] = direction.x;
        ys[i] = direction.y;
        zs[i] = direction.z;
    }
}

} // namespace hearth::sampling

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/cook/visibility/mesh_samples.h"

#include <random>

namespace hearth::test
{

using visibility::MeshView;
using visibility::SurfaceSample;

std::vector<SurfaceSample> makeSamples(const MeshView& mesh, uint32_t per_triangle, uint32_t seed)
{
    std::mt19937 random(seed);
    // std::uniform_real_distribution gives other numbers with each standard library
    const auto unit = [&] { return static_cast<float>(random() >> 8) * 0x1p-24f; };
    std::vector<SurfaceSample> samples;
    for (uint32_t t = 0; t < mesh.triangleCount(); ++t)
    {
        const Float3 a = mesh.positions[mesh.indices[t * 3]];
        const float area = length(cross(mesh.positions[mesh.indices[t * 3 + 1]] - a,
                                        mesh.positions[mesh.indices[t * 3 + 2]] - a)) /
                           2;
        for (uint32_t i = 0; i < per_triangle; ++i)
        {
            const float root = std::sqrt(unit()), along = unit();
            samples.push_back({t, root * (1 - along), root * along, area / static_cast<float>(per_triangle)});
        }
    }
    return samples;
}

Float3 getPoint(const MeshView& mesh, const SurfaceSample& sample)
{
    const uint32_t* corners = mesh.indices.data() + size_t{sample.triangle} * 3;
    const Float3 a = mesh.positions[corners[0]];
    return a + (mesh.positions[corners[1]] - a) * sample.u + (mesh.positions[corners[2]] - a) * sample.v;
}

} // namespace hearth::test

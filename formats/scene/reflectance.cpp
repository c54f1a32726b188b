// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/scene/reflectance.h"

#include "formats/base/half.h"
#include "formats/scene/table_corners.h"

#include <algorithm>
#include <cmath>

namespace hearth::shared
{

LobeTotal lobeTotal(float roughness, float n_dot_v)
{
    LobeTotal sum{};
    for (const TableCorner& corner :
         tableCorners(reflectanceCoordinates(roughness, n_dot_v), kReflectanceColumns, kReflectanceRows))
    {
        const auto value = [&](uint32_t index)
        {
            const uint64_t bits = kReflectanceTable[corner.node] >> (16 * index) & 0xFFFFu;
            return corner.weight * floatFromHalf(static_cast<uint16_t>(bits));
        };
        sum.scale += value(0);
        sum.bias += value(1);
        sum.turn += value(2);
        sum.cos_half_angle += value(3);
    }
    return sum;
}

Float3 dielectricF0(const formats::MaterialLayersRecord& layers)
{
    const float ratio = (layers.ior - 1) / (layers.ior + 1);
    return layers.specular_color * (ratio * ratio);
}

namespace
{

/// Means of lobeTotal over the views of a hemisphere, weighted by the cosine, for each row of the table. Only
/// scale and bias are set.
std::array<LobeTotal, kReflectanceRows> meanLobes()
{
    constexpr uint32_t kViews = 64;
    std::array<LobeTotal, kReflectanceRows> means{};
    for (uint32_t row = 0; row < kReflectanceRows; ++row)
        for (uint32_t i = 0; i < kViews; ++i)
        {
            // cosines whose squares are evenly spaced have the weight of the cosine
            const float n_dot_v = std::sqrt((static_cast<float>(i) + 0.5f) / kViews);
            const LobeTotal lobe = lobeTotal(reflectanceNode(0, row).y, n_dot_v);
            means[row].scale += lobe.scale / kViews;
            means[row].bias += lobe.bias / kViews;
        }
    return means;
}

} // namespace

Float3 bihemisphericalReflectance(Float3 base, float metallic, const DielectricReflectance& dielectric,
                                  float roughness)
{
    static const std::array<LobeTotal, kReflectanceRows> kMeans = meanLobes();
    const float at = reflectanceCoordinates(roughness, 1).y * (kReflectanceRows - 1);
    const auto row = std::min(static_cast<uint32_t>(at), kReflectanceRows - 2);
    const float part = at - static_cast<float>(row);
    LobeTotal mean{};
    mean.scale = kMeans[row].scale + (kMeans[row + 1].scale - kMeans[row].scale) * part;
    mean.bias = kMeans[row].bias + (kMeans[row + 1].bias - kMeans[row].bias) * part;
    const SurfaceAlbedo albedo = surfaceAlbedo(base, metallic, dielectric, mean);
    return albedo.diffuse + albedo.specular;
}

} // namespace hearth::shared

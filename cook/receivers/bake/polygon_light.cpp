// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/receivers/bake/polygon_light.h"

#include "formats/base/double3.h"

namespace hearth::receivers
{

float triangleIrradiance(Float3 point, Float3 normal, const std::array<Float3, 3>& corners)
{
    // the part above the horizon: a triangle or a quad
    const Double3 up = widen(normal);
    std::array<Double3, 4> polygon;
    size_t count = 0;
    for (size_t i = 0; i < 3; ++i)
    {
        const Double3 from = widen(corners[i] - point), to = widen(corners[(i + 1) % 3] - point);
        const double from_height = dot(from, up), to_height = dot(to, up);
        if (from_height >= 0)
            polygon[count++] = from;
        if ((from_height > 0 && to_height < 0) || (from_height < 0 && to_height > 0))
            polygon[count++] = from + (to - from) * (from_height / (from_height - to_height));
    }
    double sum = 0;
    for (size_t i = 0; i < count; ++i)
    {
        const Double3 from = polygon[i], to = polygon[(i + 1) % count];
        const Double3 across = cross(from, to);
        const double sine = length(across);
        if (sine > 0)
            sum += std::atan2(sine, dot(from, to)) * dot(across, up) / sine;
    }
    return static_cast<float>(0.5 * std::abs(sum));
}

} // namespace hearth::receivers

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/scene/reflectance.h"

#include "formats/base/half.h"

#include <algorithm>

namespace hearth::shared
{

LobeTotal lobeTotal(float roughness, float n_dot_v)
{
    const Float2 place = reflectanceCoordinates(roughness, n_dot_v);
    const float across = place.x * float{kReflectanceColumns - 1},
                down = place.y * float{kReflectanceRows - 1};
    const auto column = std::min(static_cast<uint32_t>(across), kReflectanceColumns - 2);
    const auto row = std::min(static_cast<uint32_t>(down), kReflectanceRows - 2);
    const float x = across - static_cast<float>(column), y = down - static_cast<float>(row);
    LobeTotal sum{};
    for (uint32_t corner = 0; corner < 4; ++corner)
    {
        const uint32_t right = corner & 1, below = corner >> 1;
        const uint64_t node = kReflectanceTable[(row + below) * kReflectanceColumns + column + right];
        const float weight = (right != 0 ? x : 1 - x) * (below != 0 ? y : 1 - y);
        const auto value = [&](uint32_t index)
        { return weight * floatFromHalf(static_cast<uint16_t>(node >> (16 * index) & 0xFFFFu)); };
        sum.scale += value(0);
        sum.bias += value(1);
        sum.turn += value(2);
        sum.cos_half_angle += value(3);
    }
    return sum;
}

} // namespace hearth::shared

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/scene/sheen.h"

#include "formats/base/half.h"
#include "formats/scene/table_corners.h"

namespace hearth::shared
{

SheenTotal sheenTotal(float roughness, float n_dot_v)
{
    SheenTotal sum{};
    for (const TableCorner& corner :
         tableCorners(sheenCoordinates(roughness, n_dot_v), kReflectanceColumns, kReflectanceRows))
    {
        const auto value = [&](uint32_t index)
        {
            const uint64_t bits = kSheenTable[corner.node] >> (16 * index) & 0xFFFFu;
            return corner.weight * floatFromHalf(static_cast<uint16_t>(bits));
        };
        sum.albedo += value(0);
        sum.lean += value(1);
        sum.cos_half_angle += value(2);
    }
    return sum;
}

} // namespace hearth::shared

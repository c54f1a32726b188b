// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/scene/sky_table.h"

#include "formats/base/half.h"
#include "formats/scene/table_corners.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

namespace hearth::shared
{

namespace
{

constexpr uint32_t kRings = 24, kTurns = 12;

/// Integrate over a cone: midpoints of equal solid angles. Both halves of a cone have the same heights.
/// turns  cosines of the angles about the axis
Float2 integrateCone(float height, float cos_half_angle, std::span<const float, kTurns> turns)
{
    const float level = std::sqrt(std::max(1 - height * height, 0.0f));
    Float2 sum{};
    for (uint32_t ring = 0; ring < kRings; ++ring)
    {
        const float along = 1 - (1 - cos_half_angle) * (static_cast<float>(ring) + 0.5f) / float{kRings};
        const float across = std::sqrt(std::max(1 - along * along, 0.0f)) * level;
        for (const float turn : turns)
        {
            const float at = along * height + across * turn;
            sum = sum + Float2{skyAbove(at), skyAbove(at) * skyHigh(at)};
        }
    }
    return sum * (1.0f / float{kRings * kTurns});
}

std::vector<uint32_t> makeTable()
{
    std::array<float, kTurns> turns;
    for (uint32_t turn = 0; turn < kTurns; ++turn)
        turns[turn] = std::cos(std::numbers::pi_v<float> * (static_cast<float>(turn) + 0.5f) / float{kTurns});
    std::vector<uint32_t> table;
    for (uint32_t row = 0; row < kSkyTableAngles; ++row)
        for (uint32_t column = 0; column < kSkyTableHeights; ++column)
        {
            const Float2 node = skyTableNode(column, row);
            const Float2 means = integrateCone(node.x, node.y, turns);
            table.push_back(uint32_t{halfFromFloat(means.x)} | uint32_t{halfFromFloat(means.y)} << 16);
        }
    return table;
}

} // namespace

const std::vector<uint32_t>& skyTable()
{
    static const std::vector<uint32_t> table = makeTable();
    return table;
}

Float3 skyConeRadiance(const Sky& sky, const LightCone& cone)
{
    const std::vector<uint32_t>& table = skyTable();
    Float2 means{};
    for (const TableCorner& corner : tableCorners(skyTableCoordinates(cone.axis.y, cone.cos_half_angle),
                                                  kSkyTableHeights, kSkyTableAngles))
    {
        const uint32_t node = table[corner.node];
        means.x += corner.weight * floatFromHalf(static_cast<uint16_t>(node & 0xFFFFu));
        means.y += corner.weight * floatFromHalf(static_cast<uint16_t>(node >> 16));
    }
    return skyMeanRadiance(sky, means);
}

} // namespace hearth::shared

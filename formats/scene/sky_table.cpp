// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/scene/sky_table.h"

#include "formats/base/half.h"

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
    const Float2 place = skyTableCoordinates(cone.axis.y, cone.cos_half_angle);
    const float across = place.x * float{kSkyTableHeights - 1}, down = place.y * float{kSkyTableAngles - 1};
    const auto column = std::min(static_cast<uint32_t>(across), kSkyTableHeights - 2);
    const auto row = std::min(static_cast<uint32_t>(down), kSkyTableAngles - 2);
    const float x = across - static_cast<float>(column), y = down - static_cast<float>(row);
    Float2 means{};
    for (uint32_t corner = 0; corner < 4; ++corner)
    {
        const uint32_t right = corner & 1, below = corner >> 1;
        const uint32_t node = table[(row + below) * kSkyTableHeights + column + right];
        const float weight = (right != 0 ? x : 1 - x) * (below != 0 ? y : 1 - y);
        means.x += weight * floatFromHalf(static_cast<uint16_t>(node & 0xFFFFu));
        means.y += weight * floatFromHalf(static_cast<uint16_t>(node >> 16));
    }
    return skyMeanRadiance(sky, means);
}

} // namespace hearth::shared

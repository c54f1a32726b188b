// Finds the nodes between which a table is interpolated, as a texture unit does.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace hearth::shared
{

/// Node of a table and its share of the interpolated value.
struct TableCorner
{
    uint32_t node; ///< row * columns + column
    float weight;
};

/// Return the four nodes around a place.
/// place          in [0, 1]: the first column and row at 0, the last at 1
/// columns, rows  at least 2
inline std::array<TableCorner, 4> tableCorners(Float2 place, uint32_t columns, uint32_t rows)
{
    const float across = place.x * static_cast<float>(columns - 1);
    const float down = place.y * static_cast<float>(rows - 1);
    const uint32_t column = std::min(static_cast<uint32_t>(across), columns - 2);
    const uint32_t row = std::min(static_cast<uint32_t>(down), rows - 2);
    const float x = across - static_cast<float>(column), y = down - static_cast<float>(row);
    const uint32_t node = row * columns + column;
    return {{{node, (1 - x) * (1 - y)},
             {node + 1, x * (1 - y)},
             {node + columns, (1 - x) * y},
             {node + columns + 1, x * y}}};
}

} // namespace hearth::shared

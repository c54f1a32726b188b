// Pairs the half-edges of a triangulated surface with their opposites.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hearth::clusters
{

/// Half-edge number s belongs to triangle s / 3 and runs from its corner s % 3 to the next one.
inline uint32_t nextSide(uint32_t side)
{
    return side % 3 == 2 ? side - 2 : side + 1;
}
inline uint32_t previousSide(uint32_t side)
{
    return side % 3 == 0 ? side + 2 : side - 1;
}

inline constexpr uint32_t kNoSide = 0xFFFFFFFFu;

/// Return the opposite half-edge of each half-edge: the one that runs the other way between the same
/// positions. kNoSide at a border, and where more than two half-edges lie between two positions.
///
/// positions  position ids, three for each triangle, below `position_count`
std::vector<uint32_t> sideTwins(std::span<const uint32_t> positions, size_t position_count);

} // namespace hearth::clusters

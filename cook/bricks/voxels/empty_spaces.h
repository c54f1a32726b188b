// Finds the connected spaces of empty voxels: the outside, rooms, and the interiors of walls and rocks.
// Connectivity is across common faces. Empty groups and bricks are joined as a whole.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/voxels/solid_grid.h"

#include <span>

namespace hearth::bricks
{

class EmptySpaces
{
public:
    static constexpr uint32_t kOutside = 0; ///< the space of everything beyond the grid

    explicit EmptySpaces(const SolidGrid& grid);

    /// Return the space of an empty cell; kOutside for a cell outside the grid.
    uint32_t at(const SolidGrid& grid, const Cell& cell) const;

    /// Return the number of spaces. They are numbered from kOutside on.
    uint32_t count() const { return count_; }

private:
    void joinGroups(const SolidGrid& grid, const Cell& group, uint32_t axis);
    void joinInside(const SolidGrid& grid, const Cell& group);
    void joinBricks(uint32_t first, uint32_t second, uint32_t axis);
    void joinOutside(const SolidGrid& grid);
    void number();
    uint32_t root(uint32_t node);
    void join(uint32_t a, uint32_t b);

    /// Connected empty parts of a brick, each a mask of its cells. A brick or group without solid voxels is
    /// one part.
    struct Parts
    {
        uint32_t first = 0; ///< index into parts_
        uint32_t count = 0;
    };
    const Parts& partsAt(uint32_t group, uint32_t bit) const
    {
        return parts_of_brick_[bricks_of_group_[group] == kInvalidIndex ? group_parts_[group]
                                                                        : bricks_of_group_[group] + bit];
    }

    /// first of 64 entries in parts_of_brick_; kInvalidIndex for an empty group
    std::vector<uint32_t> bricks_of_group_;
    std::vector<uint32_t> group_parts_; ///< entry of an empty group in parts_of_brick_
    std::vector<Parts> parts_of_brick_;
    std::vector<uint64_t> parts_;   ///< cell masks; part i is node i of the union-find, node 0 is the outside
    std::vector<uint32_t> parents_; ///< while joining the parent of each node, afterwards its space
    uint32_t count_ = 0;
};

/// Visibility of the spaces of a grid.
struct VisibleSpaces
{
    std::vector<bool> seen;    ///< by space
    uint32_t sealed = 0;       ///< number of spaces that are not visible
    uint64_t sealed_sides = 0; ///< sides of solid voxels towards sealed spaces; they are no faces
};

/// Find the visible spaces. A space is visible if it is outside, if a camera or seed is in it, or if at least
/// half of the voxel sides around it show front faces. Rooms show front faces; the interiors of walls and
/// rocks show back faces.
/// points  cameras and seeds, world space
VisibleSpaces findVisibleSpaces(const SolidGrid& grid, const EmptySpaces& spaces,
                                std::span<const Float3> points);

/// Separate spaces that are connected through partly opaque voxels. Each voxel that is not opaque belongs to
/// the space from which a path through such voxels reaches it. Voxels where two spaces meet become opaque.
/// Afterwards no path through empty and partly opaque voxels connects two spaces.
///
/// returns  the space of each solid voxel; kInvalidIndex for opaque voxels and for voxels that only opaque
///          ones surround
std::vector<uint32_t> separateSpaces(SolidGrid& grid, const EmptySpaces& spaces);

} // namespace hearth::bricks

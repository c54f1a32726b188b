// The empty voxels of a grid, as the spaces that they form: what is outside, rooms, the insides of walls and rocks.
// Cells are joined across common faces, whole groups and bricks at once where they are empty.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/voxels/solid_grid.h"

#include <span>

namespace hearth::bricks
{

class OpenSpace
{
public:
    static constexpr uint32_t kOutside = 0; ///< the space that everything beyond the grid belongs to

    explicit OpenSpace(const SolidGrid& grid);

    /// The space of an empty cell; kOutside for one that is not in the grid.
    uint32_t at(const SolidGrid& grid, const Cell& cell) const;

    /// Spaces are numbered from kOutside on.
    uint32_t count() const { return count_; }

private:
    void joinGroups(const SolidGrid& grid, const Cell& group, uint32_t axis);
    void joinInside(const SolidGrid& grid, const Cell& group);
    void joinBricks(uint32_t first, uint32_t second, uint32_t axis);
    void joinOutside(const SolidGrid& grid);
    void number();
    uint32_t root(uint32_t node);
    void join(uint32_t a, uint32_t b);

    /// Empty parts of a brick, each a mask of its cells. A brick or group without solid voxels is one part.
    struct Parts
    {
        uint32_t first = 0; ///< of parts_
        uint32_t count = 0;
    };
    const Parts& partsAt(uint32_t group, uint32_t bit) const
    {
        return parts_of_brick_[bricks_of_group_[group] == kNowhere ? group_parts_[group]
                                                                   : bricks_of_group_[group] + bit];
    }

    std::vector<uint32_t>
        bricks_of_group_;               ///< first of 64 in parts_of_brick_; kNowhere where the group is empty
    std::vector<uint32_t> group_parts_; ///< of an empty group, in parts_of_brick_
    std::vector<Parts> parts_of_brick_;
    std::vector<uint64_t> parts_;   ///< masks; part i is node i, the first of all stands for what is outside
    std::vector<uint32_t> parents_; ///< while joining: of each node; then its space
    uint32_t count_ = 0;
};

/// What of a grid can be seen from somewhere.
struct SeenSpaces
{
    std::vector<bool> seen;    ///< of each space
    uint32_t sealed = 0;       ///< spaces that are not
    uint64_t sealed_sides = 0; ///< sides of solid voxels towards them: no faces
};

/// A space is seen if it is outside, if a camera or seed is in it, or if at least half of the voxel sides around it show the
/// front of a surface: a room does, the inside of a wall or a rock shows backs.
/// points  world space
SeenSpaces seenSpaces(const SolidGrid& grid, const OpenSpace& spaces, std::span<const Float3> points);

/// Make opaque what else would let light from one space into another: of the voxels that are not opaque, each belongs to
/// the space that reaches it through such voxels, and those in which two meet become opaque. After it no way through empty
/// and partly opaque voxels leads from space to space.
///
/// returns  for each solid voxel its space; kNowhere for those that are opaque, or that only opaque ones surround
std::vector<uint32_t> separateSpaces(SolidGrid& grid, const OpenSpace& spaces);

} // namespace hearth::bricks

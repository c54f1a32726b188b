// Finds the voxels inside of a closed surface.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/grid/grid_frame.h"
#include "formats/base/csr_lists.h"

#include <span>
#include <vector>

namespace hearth::bricks
{

struct ClosedSurface
{
    std::vector<Double3> positions; ///< in voxels of a grid
    std::vector<uint32_t> indices;  ///< three a triangle
};

/// Voxels of a grid whose middle is inside of a closed surface: those around which it winds, whichever way it
/// faces. Shells may overlap; a shell that faces the other way within another one is a cavity.
///
/// Holds two numbers for each run of such voxels along z, so its memory grows with the surface alone.
class Interior
{
public:
    /// Consecutive voxels of a column along z.
    struct Run
    {
        uint32_t begin = 0;
        uint32_t end = 0; ///< excluded
    };

    /// Time O(triangles + columns that they cover, each with its logarithm). What lies outside of the grid is
    /// left out, and triangles without finite corners are.
    Interior(const ClosedSurface& surface, const GridFrame& frame);

    bool has(const Cell& cell) const;

    /// Return the runs of the column at (x, y), in order; none for a column outside of the grid.
    std::span<const Run> runs(uint32_t x, uint32_t y) const;

    /// Call visit(x, y, runs) for each column that has runs.
    template <typename Visit>
    void forEachColumn(const Visit& visit) const
    {
        for (uint32_t y = begin_[1]; y < end_[1]; ++y)
            for (uint32_t x = begin_[0]; x < end_[0]; ++x)
                if (const std::span<const Run> column = runs(x, y); !column.empty())
                    visit(x, y, column);
    }

private:
    std::array<uint32_t, 2> begin_{}, end_{}; ///< columns that the surface reaches, x and y
    CsrLists<Run> runs_;                      ///< by column, x fastest
};

} // namespace hearth::bricks

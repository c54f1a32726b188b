// Directions of many cells of a panel, without trigonometry for each.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/environment/environment.h"

#include <vector>

namespace hearth::probes
{

/// Panel of `columns` x `rows` cells of equal size in u and v.
class DirectionGrid
{
public:
    DirectionGrid(environment::Layout layout, uint32_t panel, uint32_t columns, uint32_t rows);

    /// Return the direction of a cell's centre; of length 1 for lat-long panels, but not of cubes.
    Double3 direction(uint32_t column, uint32_t row) const
    {
        if (layout_ == environment::Layout::lat_long)
        {
            const double sine = row_sines_[row];
            return {sine * column_sines_[column], row_cosines_[row], sine * column_cosines_[column]};
        }
        return corner_ + along_u_ * (column + 0.5) + along_v_ * (row + 0.5);
    }

    /// Return the solid angle of a cell: exact for lat-long panels, of cubes by the density at the centre.
    double solidAngle(uint32_t column, uint32_t row) const
    {
        if (layout_ == environment::Layout::lat_long)
            return row_solid_angles_[row];
        const Double3 at = direction(column, row);
        const double square = dot(at, at);
        return cell_area_ / (square * std::sqrt(square));
    }

private:
    environment::Layout layout_;
    std::vector<double> row_sines_, row_cosines_, row_solid_angles_, column_sines_, column_cosines_;
    Double3 corner_, along_u_, along_v_; ///< of the plane of a cube's face
    double cell_area_ = 0;               ///< in that plane
};

} // namespace hearth::probes

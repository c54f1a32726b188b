// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/probes/direction_grid.h"

#include <numbers>

namespace hearth::probes
{

using environment::Layout;

DirectionGrid::DirectionGrid(Layout layout, uint32_t panel, uint32_t columns, uint32_t rows) : layout_(layout)
{
    if (layout == Layout::cube)
    {
        // the face is a square of side 2 at distance 1: its middle and, each 1 from the middle, right and
        // down
        const Double3 middle = panelDirection(layout, panel, {0.5, 0.5});
        const auto edge = [&](environment::PanelPoint point)
        { return panelDirection(layout, panel, point) * std::numbers::sqrt2 - middle; };
        const Double3 right = edge({1, 0.5}), down = edge({0.5, 1});
        corner_ = middle - right - down;
        along_u_ = right * (2.0 / columns);
        along_v_ = down * (2.0 / rows);
        cell_area_ = 4.0 / columns / rows;
        return;
    }
    constexpr double kPi = std::numbers::pi;
    for (uint32_t row = 0; row < rows; ++row)
    {
        const double angle = kPi * (row + 0.5) / rows;
        row_sines_.push_back(std::sin(angle));
        row_cosines_.push_back(std::cos(angle));
        row_solid_angles_.push_back(
            panelSolidAngle(layout, {0, double(row) / rows, 1.0 / columns, double(row + 1) / rows}));
    }
    for (uint32_t column = 0; column < columns; ++column)
    {
        const double longitude = kPi * (1 - 2 * (column + 0.5) / columns);
        column_sines_.push_back(std::sin(longitude));
        column_cosines_.push_back(std::cos(longitude));
    }
}

} // namespace hearth::probes

// Radiance of distant surroundings in all directions, as an image that a cooker reads.
// cook/environment/README.md says which texel lies in which direction.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/double3.h"

#include <cstdint>
#include <vector>

namespace hearth::environment
{

enum class Layout : uint8_t
{
    lat_long, ///< one panel: columns are longitudes, rows are latitudes from the zenith to the nadir
    cube,     ///< six square panels: +X, -X, +Y, -Y, +Z, -Z, as a GPU samples them
};

/// Point of a panel: 0 is the left or upper edge, 1 the right or lower one.
struct PanelPoint
{
    double u, v;
};

/// Part of a panel, with u0 < u1 and v0 < v1.
struct PanelArea
{
    double u0, v0, u1, v1;
};

/// Linear radiance, finite and not negative. Each texel is an area of one radiance.
struct Environment
{
    Layout layout = Layout::lat_long;
    uint32_t width = 0;         ///< texels of a panel
    uint32_t height = 0;        ///< of a cube the same as width
    std::vector<Float3> texels; ///< panel after panel, rows from top to bottom

    uint32_t panelCount() const { return layout == Layout::cube ? 6 : 1; }

    /// Return the index of a texel.
    size_t index(uint32_t panel, uint32_t x, uint32_t y) const
    {
        return (size_t{panel} * height + y) * width + x;
    }

    /// Return the part of the panel that texel (x, y) covers.
    PanelArea area(uint32_t x, uint32_t y) const
    {
        return {double(x) / width, double(y) / height, double(x + 1) / width, double(y + 1) / height};
    }
};

/// Return the unit direction of a point of a panel. World space: +Y is up.
Double3 panelDirection(Layout layout, uint32_t panel, PanelPoint point);

/// Return the exact solid angle of a part of a panel, in steradians.
double panelSolidAngle(Layout layout, const PanelArea& area);

/// Return the index of the texel that a direction is in.
/// direction  of any length but 0
size_t findTexel(const Environment& environment, Double3 direction);

/// Place of a direction in a cube.
struct CubePlace
{
    uint32_t panel;
    PanelPoint point;
};

/// Return the place in a cube of a direction, which needs not be a unit vector but must not be 0.
CubePlace findCubePlace(Double3 direction);

} // namespace hearth::environment

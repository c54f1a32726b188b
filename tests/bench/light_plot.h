// Plots the error of light gathered from bricks over the voxel size.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/reference/tracer/light_error.h"

#include <string>

namespace hearth::bench
{

struct LightCurve
{
    std::string scene;
    struct Size
    {
        double voxel_size; ///< metres
        reference::LightError all, away;
    };
    std::vector<Size> sizes; ///< one for each voxel size, at least one
};

/// SVG document: one panel for each scene. Curves: whole light, indirect light, and whole light including
/// points near lamps.
std::string lightPlot(const std::vector<LightCurve>& curves);

} // namespace hearth::bench

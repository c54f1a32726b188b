// The error of gathered light over the size of voxels, as a picture.
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
    std::vector<Size> sizes; ///< of voxels, at least one
};

/// An SVG document: a panel for each scene. Whole light, indirect light, and whole light of points near lamps too.
std::string lightPlot(const std::vector<LightCurve>& curves);

} // namespace hearth::bench

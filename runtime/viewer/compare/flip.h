// FLIP image difference metric for low dynamic range: the visible difference to a viewer who flips between
// two images. P. Andersson et al., "FLIP: A Difference Evaluator for Alternating Images", HPG 2020.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/viewer/compare/image.h"

namespace hearth::viewer
{

struct FlipMap
{
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<float> error; ///< 0 (equal) .. 1, per pixel

    double mean() const;
};

/// Pixels per degree of the paper's monitor: 3840 pixels on 0.7 m, seen from 0.7 m.
inline constexpr double kFlipPixelsPerDegree = 67.0206;

/// Both images have the same size (asserted). Time: about 1 s per megapixel.
FlipMap flip(const Image& reference, const Image& test, double pixels_per_degree = kFlipPixelsPerDegree);

/// Map the errors to colours: black over violet and orange to pale yellow.
Image makeFlipImage(const FlipMap& map);

} // namespace hearth::viewer

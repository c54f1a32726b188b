// FLIP for pictures of low dynamic range: how large the difference between two pictures is to someone who flips
// between them. P. Andersson et al., "FLIP: A Difference Evaluator for Alternating Images", HPG 2020.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/viewer/compare/picture.h"

namespace hearth::viewer
{

struct FlipMap
{
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<float> error; ///< 0 (the same) .. 1, for each pixel

    double mean() const;
};

/// The paper's monitor: 3840 pixels on 0.7 m, seen from 0.7 m.
inline constexpr double kFlipPixelsPerDegree = 67.0206;

/// Both pictures have the same size (asserted). Time: about 1 s for a megapixel.
FlipMap flip(const Picture& reference, const Picture& test, double pixels_per_degree = kFlipPixelsPerDegree);

/// The map as a picture, black over violet and orange to pale yellow.
Picture showFlip(const FlipMap& map);

} // namespace hearth::viewer

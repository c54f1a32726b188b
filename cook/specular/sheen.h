// Makes the table of sheen that shading reads (formats/scene/sheen_table.h).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/double3.h"

#include <cstdint>
#include <vector>

namespace hearth::specular
{

/// A lobe of white sheen as a whole.
struct SheenMoments
{
    double albedo = 0; ///< share of constant light that it reflects; may exceed 1
    Double3 mean{};    ///< of the directions of light; the view has y = 0 and x >= 0
};

/// Integrate a lobe over all directions of light.
/// roughness  perceptual, at least shared::kMinSheenRoughness
/// cosine     between normal and view, [0, 1]
SheenMoments computeSheenMoments(double roughness, double cosine);

/// Compute the nodes of the table, cosines first: albedo, lean and cosine of half-angle
/// (formats/gpu_shared/sheen.h) as half floats, the first in the lowest bits.
std::vector<uint64_t> cookSheen();

} // namespace hearth::specular

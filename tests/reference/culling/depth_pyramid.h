// Depth pyramid of a depth buffer, and its occlusion test, by slow and simple code.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/occlusion.h"

#include <cstdint>
#include <vector>

namespace hearth::reference
{

struct Pyramid
{
    shared::OcclusionView view{};
    std::vector<float> texels;
};

/// Return the texels of a depth buffer's pyramid.
std::vector<float> makePyramid(const std::vector<float>& depth, uint32_t width, uint32_t height);

/// True if the depths hide all of a box of an instance.
bool isHidden(const Pyramid& pyramid, const shared::Instance& instance, Float3 box_min, Float3 box_max);

} // namespace hearth::reference

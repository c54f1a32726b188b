// Generates procedural images from a height or a colour for each texel.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/shapes/document.h"

#include <functional>
#include <string>

namespace hearth::samples
{

/// Function of the unit square, sampled at texel centres, (0, 0) top left.
using ColorFunction = std::function<Float4(Float2 uv)>;
using HeightField = std::function<float(Float2 uv)>;

/// Encode a linear value as sRGB (IEC 61966-2-1), as a byte.
uint8_t encodeSrgb(float linear);

/// Paint an image of linear colours, stored as sRGB; alpha is stored unchanged.
Image paintColor(std::string name, uint32_t width, uint32_t height, const ColorFunction& color_function);

/// Paint an image of plain data.
Image paintData(std::string name, uint32_t width, uint32_t height, const ColorFunction& color_function);

/// Paint the tangent-space normal map of a height field that tiles. `depth`: height 1 in units of the image's
/// width.
Image paintNormals(std::string name, uint32_t size, float depth, const HeightField& height);

} // namespace hearth::samples

// Procedural pictures: a height or a colour for each texel, and what is derived from them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/shapes/document.h"

#include <functional>
#include <string>

namespace hearth::samples
{

/// A function of the unit square, sampled at texel centres, (0, 0) top left.
using Picture = std::function<Float4(Float2 uv)>;
using HeightField = std::function<float(Float2 uv)>;

/// sRGB encoding (IEC 61966-2-1) of a linear value, as a byte.
uint8_t encodeSrgb(float linear);

/// Image of linear colours, stored as sRGB; alpha is stored as it is.
Image paintColor(std::string name, uint32_t width, uint32_t height, const Picture& picture);

/// Image of plain data.
Image paintData(std::string name, uint32_t width, uint32_t height, const Picture& picture);

/// Tangent-space normal map of a height field that repeats. `depth`: height 1 in units of the image's width.
Image paintNormals(std::string name, uint32_t size, float depth, const HeightField& height);

} // namespace hearth::samples

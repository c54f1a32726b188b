// Converts stored texels to working texels and back. A working texel is linear and can be averaged: the mean
// over an area represents the area.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"
#include "formats/records/scene.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace hearth::textures
{

/// Kind of texels, which decides how they are averaged.
enum class Content : uint8_t
{
    color,   ///< sRGB: linear light, weighted by alpha so that cut-away texels do not bleed in
    data,    ///< four independent channels
    normals, ///< directions; their mean is made unit again
    light,   ///< RGBA16F
};

Content classifyContent(const formats::ImageRecord& image);

/// Return the format of the mips of an imported image. Of 16 bits a channel colours keep 8, data and normals
/// `max_bits`: 8 or 16.
uint32_t mipFormat(uint32_t imported_format, uint32_t max_bits);

/// Decode one row of stored texels to working texels. `stored` has out.size() texels of the format.
void decodeRow(Content content, uint32_t format, std::span<const std::byte> stored, std::span<Float4> out);

/// Encode one row in a format of mips, rounded to nearest. `alpha_scale` multiplies alpha.
void encodeRow(Content content, uint32_t format, std::span<const Float4> texels, float alpha_scale,
               std::span<std::byte> out);

} // namespace hearth::textures

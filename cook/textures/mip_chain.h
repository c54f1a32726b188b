// Builds the mip chain of one image.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/textures/roughness_filter.h"
#include "formats/records/scene.h"

#include <cstddef>
#include <span>
#include <vector>

namespace hearth::textures
{

/// Return the number of mips of an image down to one texel.
uint32_t fullMipCount(uint32_t width, uint32_t height);

/// Build all mips in mipFormat(), finest first, tightly packed. The finest is `texels`, unchanged or with its
/// channels rounded to 8 bits; normals are made unit, with z from 0 on. Every other mip represents `texels`:
/// nothing is rounded in between. Same bytes for any number of threads.
///
/// image     width, height, format, flags and alpha_cutoff are read; mip_count is not
/// texels    width * height texels of that format (asserted)
/// max_bits  of a channel: see mipFormat()
/// filter    null: none; else it widens the roughness of all mips but the finest
/// limits    scratch 16 bytes for each texel of the second and third mip; twice that with a filter
std::vector<std::byte> buildMipChain(const formats::ImageRecord& image, std::vector<std::byte> texels,
                                     uint32_t max_bits = 16, RoughnessFilter* filter = nullptr);

} // namespace hearth::textures

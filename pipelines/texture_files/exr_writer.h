// Writes images of floats as OpenEXR, for other programs, without its library.
// Source: "OpenEXR File Layout", openexr.com.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hearth::texture_files
{

/// Return the bytes of a file: channels R, G, B of 32 bits, scanlines from top to bottom, no compression.
/// width, height  1 or more
/// texels         width * height (asserted), rows from top to bottom
std::vector<std::byte> writeExr(uint32_t width, uint32_t height, std::span<const Float3> texels);

} // namespace hearth::texture_files

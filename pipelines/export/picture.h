// Encodes an image of a pack as a PNG file that glTF's materials can read.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/scene.h"

#include <cstddef>
#include <span>
#include <vector>

namespace hearth::gltf_export
{

/// Encode the finest mip as shaders read it: 8 bits a channel, 16 where the image has them, without
/// alpha where all texels are opaque. Normals get the z that shaders make of x and y; light is
/// clamped to 1 and coded as sRGB.
/// mips  all of the image, as PackView::imageData returns them
std::vector<std::byte> encodeImage(const formats::ImageRecord& image, std::span<const std::byte> mips);

} // namespace hearth::gltf_export

// Texels of formats that a device lacks, decoded into formats that all devices have.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/texture_pieces.h"
#include "formats/records/texel_format.h"

#include <cstddef>
#include <span>
#include <vector>

namespace hearth::pack
{

/// Return the format for the texels of one that the device lacks: R8, RG8 or RGBA8, of light RGBA16F. All
/// devices have it.
formats::TexelFormat decodedFormat(const formats::TexelFormatTraits& traits);

/// Return the bytes of a piece of an image that is decoded.
size_t decodedBytes(const formats::ImageRecord& image, const formats::TexturePiece& piece);

/// Decode a piece of an image, mip by mip.
/// stored  piece.size bytes
/// texels  decodedBytes of them
void decodeTexels(const formats::ImageRecord& image, const formats::TexturePiece& piece,
                  std::span<const std::byte> stored, std::span<std::byte> texels);

/// Decode all mips of an image.
/// stored  of all mips, as PackView::imageData returns them
std::vector<std::byte> decodeTexels(const formats::ImageRecord& image, std::span<const std::byte> stored);

} // namespace hearth::pack

// Decodes images of any supported format.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/part/import_options.h"
#include "pipelines/import/part/part_builder.h"

#include <cstddef>
#include <span>
#include <string>

namespace hearth::import
{

/// Decode PNG, JPEG, WebP, TGA, BMP, HDR, EXR, KTX2 or DDS, chosen by content; with a program in `artist`
/// TIFF, PSD, JPEG 2000 and any part of an EXR, too. `name` is used in messages.
/// errors: image_malformed, image_unsupported, input_too_large, image_reader.
Result<DecodedImage> decodeImage(std::span<const std::byte> bytes, const std::string& name,
                                 const ImportLimits& limits, const ArtistImages& artist = {});

/// True if the bytes start as an image format that decodeImage knows, even if the image is damaged.
bool looksLikeImage(const std::string& path, std::span<const std::byte> bytes);

} // namespace hearth::import

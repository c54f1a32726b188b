// Reads TIFF, EXR of several parts and JPEG 2000 from memory, through OpenImageIO.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/images/samples.h"

#include <span>
#include <string_view>

namespace hearth::images
{

/// Have OpenImageIO load its readers, which looks for files. It starts no threads from here on.
void prepareReaders();

/// Read the first image of the file in full size; of an EXR a part or a layer.
/// layer  name of a part, or of a layer in a part; empty: the first part with colours
/// errors: image_malformed, image_unsupported, input_too_large
Result<Samples> readByOiio(const Request& request, std::string_view layer, std::span<const std::byte> bytes);

} // namespace hearth::images

// Reads images of an import part.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/container/container_reader.h"
#include "formats/records/scene.h"

#include <cstddef>
#include <vector>

namespace hearth::textures
{

/// Read the texels of the finest mip of image `index`.
/// errors: meaning_value (size or format), chunk_missing, chunk_size, and those of ContainerReader::read
Result<std::vector<std::byte>> readTexels(const formats::ContainerReader& part,
                                          const formats::ImageRecord& image, uint32_t index);

} // namespace hearth::textures

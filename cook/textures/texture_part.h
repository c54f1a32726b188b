// The textures part: the images of an import part with all their mips.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/textures/texture_statistics.h"
#include "formats/result.h"

#include <string>

namespace hearth::textures
{

/// Read the images of the import part at `import_path` and write them with mips to `output_path`: IMGR, whose names
/// refer to the import part's string table, and an IMGD for each image. One image is in memory at a time.
/// statistics  null: none; else filled with one for each image
/// errors: those of ContainerReader, meaning_value and chunk_size (damaged image records), cannot_write.
Status cookTextures(const std::string& import_path, const std::string& output_path,
                    std::vector<ImageStatistics>* statistics = nullptr);

} // namespace hearth::textures

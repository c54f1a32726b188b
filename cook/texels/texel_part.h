// Writes the texels part: the images of a textures part in the formats of a target.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/search.h"
#include "formats/base/result.h"

#include <string>
#include <vector>

namespace hearth::texels
{

struct TexelOptions
{
    Families families{};
    Effort quality = Effort::normal; ///< target of error and effort of the encoders
    bool strict = false;             ///< an image that misses its target is not compressed
};

/// Result of encoding an image, for people and scripts.
struct ImageResult
{
    std::string name;
    formats::ImageRecord record{};
    double target = 0; ///< in the unit of combineMips
    bool holds_target = true;
    uint64_t bytes = 0;        ///< of all mips
    uint64_t stored_bytes = 0; ///< in the file
};

/// Read the materials of the import part and the plain mips of the textures part, and write images of the
/// same numbers and names in the formats of the target. One image is in memory at a time. Same bytes for any
/// number of threads.
///
/// results  one for each image
/// errors: those of ContainerReader; meaning_reference where the parts are not of one source; cannot_write
Status cookTexels(const std::string& import_path, const std::string& textures_path,
                  const std::string& output_path, const TexelOptions& options,
                  std::vector<ImageResult>& results);

/// Return JSON text with the schema "hearth.texels/1". `source` is the name of the input.
std::string statisticsJson(const std::string& source, std::span<const ImageResult> results);

} // namespace hearth::texels

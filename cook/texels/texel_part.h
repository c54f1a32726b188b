// Writes the texels part: the images of a textures part in the formats of a target.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/picture.h"
#include "cook/texels/texel_request.h"
#include "formats/base/result.h"

#include <string>
#include <vector>

namespace hearth::texels
{

/// Number of images of a source that have pictures in a report: as many as a page shows without weight.
inline constexpr size_t kMaxPictures = 64;

/// Result of encoding an image, for people and scripts.
struct ImageResult
{
    std::string name;
    formats::ImageRecord record{};
    Target target{};          ///< as Request::target
    bool holds_target = true; ///< as holdsTargets: a rule or a budget that names a format misses none
    FormatReason reason = FormatReason::target;
    std::vector<CandidateError> estimates{}; ///< as Encoding::estimates
    std::optional<size_t> picture{};         ///< its number among the pictures
    uint64_t bytes = 0;                      ///< of all mips
    uint64_t stored_bytes = 0;               ///< in the file
};

/// Results of encoding the images of a source.
struct TexelResults
{
    std::vector<ImageResult> images{};
    std::vector<PicturePair> pictures{};
};

/// Read the materials of the import part and the plain mips of the textures part, and write images of the
/// same numbers and names in the formats of the target, with the materials that the textures part has. Up
/// to four images are in memory at a time. Same bytes for any number of threads.
///
/// results  of each image
/// errors: those of ContainerReader; meaning_reference where the parts are not of one source; texture_rule
/// where a rule does not suit an image; cannot_write
Status cookTexels(const std::string& import_path, const std::string& textures_path,
                  const std::string& output_path, const TexelOptions& options, TexelResults& results);

/// Return JSON text with the schema "hearth.texels/1". `source` is the name of the input.
std::string statisticsJson(const std::string& source, const TexelResults& results);

} // namespace hearth::texels

// Writes the textures part: the images of an import part with all their mips.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/textures/texture_statistics.h"
#include "formats/base/result.h"

#include <cstdint>
#include <string>

namespace hearth::textures
{

/// Maximum texels of a side: the limit of Vulkan devices on phones; larger sizes could also overflow data
/// sizes.
inline constexpr uint32_t kMaxTextureSize = 16384;

/// Bounds of the textures that are written, and what is done to them.
struct TextureOptions
{
    uint32_t max_size = 0;   ///< texels: mips with a longer side are left out; 0: none
    uint32_t max_bits = 16;  ///< of a channel of data and normals: 8 or 16
    bool specular_aa = true; ///< roughness is widened by the normals that mips of normal maps lose
};

/// Read the images of the import part at `import_path` and write them with mips to `output_path`: IMGR, whose
/// names refer to the import part's string table, and an IMGD for each image. One image is in memory at a
/// time, with its variants for several normal maps. Images of roughness that several normal maps need, or
/// that a material without one gets, follow those of the import part; images that factors or another image
/// replace are left out. Then the part has materials and layers, too (MATL, MLAY), which replace those of the
/// import part.
///
/// options     mips that are left out make the image smaller; the others equal those of the whole chain
/// statistics  null: none; else filled with one for each image
/// errors: those of ContainerReader, meaning_value and chunk_size (damaged image records), cannot_write.
Status cookTextures(const std::string& import_path, const std::string& output_path,
                    const TextureOptions& options = {}, std::vector<ImageStatistics>* statistics = nullptr);

} // namespace hearth::textures

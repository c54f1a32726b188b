// hearth extract --texture: writes a texture of a pack as KTX2.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "formats/records/scene.h"

#include <string>

namespace hearth::command
{

struct TextureExtraction
{
    std::string texture;        ///< its name, or its index if no texture has that name
    bool is_decoded = false;    ///< write RGBA8, as shaders read it; else the blocks as they are
    bool is_compressed = false; ///< each mip is a zstd frame
};

/// Return the swizzle as KTX2 writes it: each of "rgba01".
std::string swizzleText(const formats::ImageRecord& image);

/// Write the texture with all mips.
/// errors: usage where no texture has the name, with the nearest one; those of openContainer and
/// PackView::imageData; cannot_write.
Status extractTexture(const std::string& path, const TextureExtraction& extraction,
                      const std::string& output);

} // namespace hearth::command

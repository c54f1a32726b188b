// Writes textures as KTX2, for other programs.
// Source: Khronos KTX File Format Specification 2.0.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/texel_format.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace hearth::texture_files
{

/// Two-dimensional texture.
struct Texture
{
    const formats::TexelFormatTraits* traits; ///< of a format that Vulkan has
    uint32_t width, height;
    uint32_t mip_count;
    std::span<const std::byte> mips; ///< finest first, one behind the other
    std::string swizzle = "rgba";    ///< source of red, green, blue, alpha: each of "rgba01"
};

/// Return the bytes of a file: rows from top to bottom, the same for the same texture.
/// writer      program and version, for the file
/// compressed  each mip is a zstd frame
/// texture.mips must have the size of the mips (asserted)
std::vector<std::byte> writeKtx2(const Texture& texture, const std::string& writer, bool compressed);

} // namespace hearth::texture_files

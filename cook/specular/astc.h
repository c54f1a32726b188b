// Encodes the table as an ASTC texture, for renderers that support no other: 256 x 16 texels, with the slices
// of beta side by side.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/specular/table.h"

#include <cstddef>
#include <span>
#include <vector>

namespace hearth::specular
{

/// Texels of a block along both axes. All blocks are 16 bytes: 8, 3.56 and 2 bits a texel.
inline constexpr std::array<uint32_t, 3> kAstcBlocks{4, 6, 8};

struct AstcTable
{
    uint32_t block = 0;
    std::vector<std::byte> blocks; ///< row by row
    TableValues decoded{};         ///< as texture units read it, in the order of SpecularTableRecord::values
};

/// Encode an image with texel (16 beta + aperture, roughness). It has one channel, which red, green and blue
/// read as; linear, not sRGB. The same bytes for any number of threads.
/// block  one of kAstcBlocks (asserted)
AstcTable encodeAstc(const TableValues& values, uint32_t block);

/// Return the contents of an .astc file: header of 16 bytes, and the blocks.
/// source  ARM, "The .astc file format" (astc-encoder, Docs/FileFormat.md)
std::vector<std::byte> astcFile(const AstcTable& table);

} // namespace hearth::specular

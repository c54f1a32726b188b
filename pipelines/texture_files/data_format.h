// Describes texels for other programs: the basic data format descriptor of KTX2 files.
// Source: Khronos Data Format Specification 1.4, chapter "Khronos Basic Data Format Descriptor".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/texel_format.h"

#include <cstdint>
#include <vector>

namespace hearth::texture_files
{

/// Return the descriptor of a format, with its total size first: words in the order of the file.
/// Colours have the primaries of BT.709, and straight alpha.
std::vector<uint32_t> describeTexels(const formats::TexelFormatTraits& traits);

/// Return the size in bytes of the numbers that a texel is made of, as typeSize of KTX2: 1 if the order of
/// bytes does not matter.
uint32_t typeBytes(const formats::TexelFormatTraits& traits);

} // namespace hearth::texture_files

// Decodes the texels of texture files: the one way for KTX2 and DDS.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"
#include "pipelines/import/images/codecs.h"
#include "pipelines/import/images/stored_format.h"

#include <string_view>

namespace hearth::import
{

/// Level of a texture as it is stored, rows from top to bottom.
struct StoredImage
{
    StoredFormat format;
    uint32_t width;
    uint32_t height;
    std::span<const std::byte> bytes; ///< format.levelBytes(width, height)
    /// Sources of red, green, blue, alpha, each of "rgba01"; empty: the stored channels, and a texel that has
    /// nothing but red is grey.
    std::string_view swizzle = {};
};

/// Decode a level. Numbers of at most 8 bits stay 8 bits, others become 16; floats become finite halves;
/// signed numbers from -1 to 1 become 0 to 1, as normal maps have them.
/// errors: those of allocateImage
Result<DecodedImage> decodeStored(const EncodedImage& source, const StoredImage& stored);

/// Decode the colours of a level of floats without loss. The format has floats (asserted).
/// errors: those of allocateImage
Result<std::vector<Float3>> decodeStoredFloats(const EncodedImage& source, const StoredImage& stored);

} // namespace hearth::import

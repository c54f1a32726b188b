// Images decoded to floats of 32 bits: environments, whose suns are brighter than half floats can be.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"
#include "pipelines/import/images/codecs.h"

#include <vector>

namespace hearth::import
{

struct FloatImage
{
    uint32_t width = 0;
    uint32_t height = 0;
    uint32_t faces = 1;         ///< 6: a cube
    std::vector<Float3> texels; ///< as stored, face after face, rows from top to bottom
};

// Errors are those of the decoders in codecs.h. Values may be negative, infinite or NaN, as in the file.

Result<FloatImage> decodeHdrFloats(const EncodedImage& source);
/// Images with chroma have the precision of half floats.
Result<FloatImage> decodeExrFloats(const EncodedImage& source);
/// Decode an image or a cube. errors also: image_unsupported for numbers that are no floats
Result<FloatImage> decodeKtx2Floats(const EncodedImage& source);

} // namespace hearth::import

// Writes light as a picture that people look at, or that other programs read.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"
#include "formats/base/result.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace hearth::light_pictures
{

struct LightPicture
{
    uint32_t width = 0, height = 0;
    std::vector<Float3> texels; ///< linear Rec.709, row by row
};

/// Encode PNG: of a light x, x / (1 + x) of white, so that suns keep their colours.
/// factor  of texels
std::vector<std::byte> encodePng(const LightPicture& picture, double factor);

/// Return the picture with each `factor` x `factor` texels as one, their mean; at the right and the bottom of
/// those that are there.
LightPicture shrink(const LightPicture& picture, uint32_t factor);

/// True if the name ends in .png or .exr.
bool isPictureName(const std::string& output);

/// Write EXR with the texels as they are, or PNG, by the name of the output.
/// factor  of texels in PNG
/// errors: cannot_write
Status writePicture(const std::string& output, const LightPicture& picture, double factor);

} // namespace hearth::light_pictures

// Makes RGBA of an image's channels.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/images/samples.h"

namespace hearth::images
{

struct Assembled
{
    uint32_t width = 0; ///< of the turned image
    uint32_t height = 0;
    std::vector<std::byte> texels; ///< RGBA of 8 or 16 bits or halves
};

/// Make RGBA: grey becomes three channels, CMYK becomes RGB by its profile or else by the plain formula with
/// a note, colours are divided by alpha where it multiplies them, and rows are turned as the orientation
/// says. Floats become halves.
/// convert_icc  colours with a profile are converted to sRGB; else only CMYK is. Floats never are
Assembled assemble(Samples& samples, bool convert_icc);

} // namespace hearth::images

// Images of linear radiance, their files, and how a camera with Hearth's tone curve shows them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "tests/reference/double3.h"
#include "tests/reference/png_image.h"

#include <vector>

namespace hearth::picture
{

struct RadianceImage
{
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<reference::Double3> pixels; ///< width * height, rows from top to bottom
};

/// Read a colour PFM file, little-endian. errors: input_missing, image_malformed.
Result<RadianceImage> readPfm(const std::string& path);

/// errors: cannot_write.
Status writePfm(const std::string& path, const RadianceImage& image);

/// Return the mean of two images of one size.
RadianceImage average(const RadianceImage& a, const RadianceImage& b);

/// Apply the tone curve to each pixel, then average blocks of `oversampling` times `oversampling` pixels.
reference::Image develop(const RadianceImage& image, uint32_t oversampling);

} // namespace hearth::picture

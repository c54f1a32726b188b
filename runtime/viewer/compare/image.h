// Images of 8 bits per channel, read from and written to PNG files.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"
#include "formats/base/result.h"

#include <string>
#include <vector>

namespace hearth::viewer
{

/// sRGB-encoded image, rows from top to bottom.
struct Image
{
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint8_t> rgb; ///< width * height * 3

    Image() = default;
    Image(uint32_t w, uint32_t h) : width(w), height(h), rgb(size_t{w} * h * 3) {}
    uint8_t* at(size_t x, size_t y) { return &rgb[(y * width + x) * 3]; }
    const uint8_t* at(size_t x, size_t y) const { return &rgb[(y * width + x) * 3]; }
};

/// Read a PNG file. Alpha is dropped. errors: input_missing, image_malformed.
Result<Image> readPng(const std::string& path);

/// Write a PNG file. errors: cannot_write.
Status writePng(const std::string& path, const Image& image);

/// Decode one channel in 0..1 by IEC 61966-2-1.
double linearFromSrgb(double encoded);
double srgbFromLinear(double linear);

} // namespace hearth::viewer

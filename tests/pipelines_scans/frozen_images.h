// Tiny images, stored as the encoders wrote them: libpng 1.6.39, libjpeg-turbo 2.1.5, libwebp 1.2.4, OpenEXR
// 3.1.5; PNGs with true 16 bits by Python with zlib 1.2.13.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>
#include <vector>

namespace hearth::test
{

// 5 x 3 texels; texel (x, y) of colour images is (50 x, 100 y, 200 - 30 x, 255 - 20 x)
extern const std::vector<uint8_t> kPngRgba8;
extern const std::vector<uint8_t> kPngRgb16Interlaced; ///< each 8-bit value twice, no alpha
extern const std::vector<uint8_t> kPngRgba16; ///< (1000 x + 1, 2000 y + 2, 30000 + x + 3 y, 65535 - 7 x)
extern const std::vector<uint8_t> kPngGrey16; ///< 4000 x + y, no alpha
extern const std::vector<uint8_t> kPngGrey8;  ///< 100 y
extern const std::vector<uint8_t>
    kPngPalette2; ///< indices 0 1 2 3 y, colours (10 20 30 0) (40 50 60 128) (70 80 90) (100 110 120)
extern const std::vector<uint8_t> kJpegBaseline;    ///< all (180, 90, 40)
extern const std::vector<uint8_t> kJpegProgressive; ///< the same
extern const std::vector<uint8_t> kJpegGrey;        ///< all 77
extern const std::vector<uint8_t> kJpegCmyk;        ///< all (200, 100, 50, 128), stored as Adobe does
extern const std::vector<uint8_t> kWebpLossless;
extern const std::vector<uint8_t> kWebpLossy;
extern const std::vector<uint8_t> kExrZip;       ///< (x / 2, y, 2, x / 4)
extern const std::vector<uint8_t> kExrPizWindow; ///< data window (1, -1) to (5, 1), no alpha
extern const std::vector<uint8_t> kExrDwaa;
extern const std::vector<uint8_t> kExrChroma; ///< 4 x 2 texels, all (0.5, 0.25, 0.125), luminance and chroma

} // namespace hearth::test

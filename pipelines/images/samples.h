// Channels of an image as its file has them, and what they mean.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "pipelines/images/protocol.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace hearth::images
{

enum class Number : uint32_t
{
    unorm8,
    unorm16,
    float32,
};

inline size_t numberBytes(Number number)
{
    return number == Number::unorm8 ? 1 : number == Number::unorm16 ? 2 : 4;
}

/// Relation of colours to alpha.
enum class Alpha : uint8_t
{
    none,       ///< no alpha
    straight,   ///< colours are not multiplied by alpha
    multiplied, ///< colours are multiplied by alpha
    on_white,   ///< colours lie on white: multiplied by alpha, plus 1 - alpha
};

struct Samples
{
    uint32_t width = 0;
    uint32_t height = 0;
    Number number = Number::unorm8;
    uint32_t channel_count = 0;    ///< of `values`, some of which may be of no use
    std::vector<std::byte> values; ///< rows top to bottom, channels interleaved
    /// Channels of the colour; 1: grey, 3: RGB, 4: CMYK as ink, 0 is none.
    uint32_t color_count = 0;
    std::array<uint32_t, 4> colors{0, 1, 2, 3};
    Alpha alpha = Alpha::none;
    uint32_t alpha_channel = 0;
    uint32_t orientation = 1;       ///< as in TIFF and Exif, 1 to 8
    std::vector<std::byte> profile; ///< ICC; empty: none
    std::string notes;              ///< lines, as in the text of an Answer

    void addNote(Issue issue, const std::string& text)
    {
        notes += std::to_string(static_cast<unsigned>(issue)) + " " + text + "\n";
    }
};

/// Check the size of an image against the limits of the request.
/// errors: image_malformed, input_too_large
inline Status checkSize(const Request& request, uint64_t width, uint64_t height)
{
    const std::string size = std::to_string(width) + " x " + std::to_string(height) + " texels";
    if (width == 0 || height == 0)
        return Error{Issue::image_malformed, "", "", "the image is " + size};
    if (width > request.max_side || height > request.max_side || width * height > request.max_texels)
        return Error{Issue::input_too_large, "", "",
                     "the image is " + size + "; at most " + std::to_string(request.max_texels) +
                         " in all and " + std::to_string(request.max_side) + " on a side are read"};
    return success();
}

} // namespace hearth::images

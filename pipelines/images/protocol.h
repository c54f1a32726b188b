// Messages between hearth-import and hearth-images: a request with the bytes of an image, and its answer with
// texels. Both go through one stream socket, in the byte order of the machine.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>

namespace hearth::images
{

/// Format of the bytes, known from their signature: the program never guesses it.
enum class Format : uint32_t
{
    tiff,
    psd,
    exr,
    jpeg2000,
};

inline constexpr uint32_t kRequestMagic = 0x51494548; ///< "HEIQ"
inline constexpr uint32_t kAnswerMagic = 0x41494548;  ///< "HEIA"

/// Maximum length of a layer's name in a request.
inline constexpr uint32_t kMaxLayerSize = 1024;
/// Maximum length of an answer's text.
inline constexpr uint32_t kMaxTextSize = 4096;

/// Followed by layer_size bytes of a layer's name and byte_count bytes of the image.
struct Request
{
    uint32_t magic = kRequestMagic;
    Format format = Format::tiff;
    uint64_t byte_count = 0;
    uint64_t max_texels = 0;
    uint32_t max_side = 0;
    uint32_t convert_icc = 0; ///< 1: colours are converted from the image's ICC profile to sRGB
    uint32_t layer_size = 0;  ///< 0: the first part with colours
    uint32_t zero = 0;
};
static_assert(sizeof(Request) == 40);

/// Followed by text_size bytes of text and texel_bytes bytes of texels: rows top to bottom, four channels.
/// The text is why there is no image, or else one line for each loss: the number of an issue, a blank, words.
struct Answer
{
    uint32_t magic = kAnswerMagic;
    uint32_t issue = 0; ///< 0: an image follows; else a number of formats/base/issues.h
    uint32_t width = 0;
    uint32_t height = 0;
    uint32_t type = 0; ///< 0: 8 bits a channel, 1: 16 bits, 2: halves
    uint32_t text_size = 0;
    uint64_t texel_bytes = 0;
};
static_assert(sizeof(Answer) == 32);

} // namespace hearth::images

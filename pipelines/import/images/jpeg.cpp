// Decodes JPEG through libjpeg-turbo: baseline and progressive, grey, YCbCr, RGB, CMYK and YCCK. libjpeg
// continues after damage and fills in grey; here damaged or missing data is an error.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/images/codecs.h"

#include <array>
#include <csetjmp>
#include <cstdio>

#include <jpeglib.h>

#include <jerror.h>

namespace hearth::import
{

namespace
{

// Limit of scans. Encoders write about ten. Each scan of a progressive file covers the whole image, so a
// small file with thousands of them would take minutes.
constexpr int kMaxScans = 200;

/// State of a decoder. libjpeg reports errors by longjmp: the functions that call it own nothing.
struct JpegState
{
    jpeg_decompress_struct decoder{};
    jpeg_error_mgr errors{};
    jpeg_progress_mgr progress{};
    std::jmp_buf on_error{};
    std::array<char, JMSG_LENGTH_MAX> message{};

    JpegState() = default;
    JpegState(const JpegState&) = delete;
    JpegState& operator=(const JpegState&) = delete;
    ~JpegState() { jpeg_destroy_decompress(&decoder); }
};

[[noreturn]] void onError(j_common_ptr info)
{
    auto* state = static_cast<JpegState*>(info->client_data);
    info->err->format_message(info, state->message.data());
    std::longjmp(state->on_error, 1);
}

/// Handle a message of libjpeg. Warnings have a negative level. Bytes between segments do no harm; any other
/// damage is in the image itself.
void onMessage(j_common_ptr info, int level)
{
    const int code = info->err->msg_code;
    if (level < 0 && code != JWRN_EXTRANEOUS_DATA && code != JWRN_JFIF_MAJOR && code != JWRN_ADOBE_XFORM)
        onError(info);
}

void onProgress(j_common_ptr info)
{
    if (info->is_decompressor && reinterpret_cast<j_decompress_ptr>(info)->input_scan_number > kMaxScans)
    {
        auto* state = static_cast<JpegState*>(info->client_data);
        std::snprintf(state->message.data(), state->message.size(), "more than %d scans", kMaxScans);
        std::longjmp(state->on_error, 1);
    }
}

bool readHeader(JpegState& state, std::span<const std::byte> bytes)
{
    state.decoder.err = jpeg_std_error(&state.errors);
    state.decoder.client_data = &state;
    state.errors.error_exit = onError;
    state.errors.emit_message = onMessage;
    if (setjmp(state.on_error) != 0)
        return false;
    jpeg_create_decompress(&state.decoder);
    state.decoder.client_data = &state;
    state.progress.progress_monitor = onProgress;
    state.decoder.progress = &state.progress;
    jpeg_mem_src(&state.decoder, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    jpeg_read_header(&state.decoder, TRUE);
    return true;
}

/// Return the size of the shortest file with the image of the header: a Huffman code has one bit or more for
/// each block. Arithmetic coding has no such minimum.
uint64_t minFileBytes(const jpeg_decompress_struct& decoder)
{
    if (decoder.arith_code != FALSE)
        return 0;
    uint64_t blocks = 0;
    for (int i = 0; i < decoder.num_components; ++i)
        blocks += uint64_t{decoder.comp_info[i].width_in_blocks} * decoder.comp_info[i].height_in_blocks;
    return blocks / 8;
}

/// Decode into RGBA8 rows; CMYK arrives as four channels as well.
bool readTexels(JpegState& state, uint8_t* texels)
{
    if (setjmp(state.on_error) != 0)
        return false;
    jpeg_decompress_struct& decoder = state.decoder;
    const bool cmyk = decoder.jpeg_color_space == JCS_CMYK || decoder.jpeg_color_space == JCS_YCCK;
    decoder.out_color_space = cmyk ? JCS_CMYK : JCS_EXT_RGBA;
    decoder.dct_method = JDCT_ISLOW; // the same result with and without vector instructions
    jpeg_start_decompress(&decoder);
    while (decoder.output_scanline < decoder.output_height)
    {
        JSAMPROW row = texels + size_t{4} * decoder.output_width * decoder.output_scanline;
        jpeg_read_scanlines(&decoder, &row, 1);
    }
    jpeg_finish_decompress(&decoder);
    return true;
}

/// Convert CMYK to RGB. Adobe's programs store ink inverted (255 is no ink) and write a marker that says so;
/// all known CMYK files have it.
void rgbFromCmyk(DecodedImage& image, bool inverted)
{
    uint8_t* texel = imageBytes(image);
    const size_t count = size_t{image.width} * image.height;
    for (size_t i = 0; i < count; ++i, texel += 4)
    {
        const unsigned light = inverted ? texel[3] : 255u - texel[3];
        for (int c = 0; c < 3; ++c)
        {
            const unsigned value = inverted ? texel[c] : 255u - texel[c];
            texel[c] = static_cast<uint8_t>((value * light + 127u) / 255u);
        }
        texel[3] = 255;
    }
}

} // namespace

Result<DecodedImage> decodeJpeg(const EncodedImage& source)
{
    JpegState state;
    const auto failed = [&] { return source.malformed(std::string("JPEG: ") + state.message.data()); };
    if (!readHeader(state, source.bytes))
        return failed();
    HEARTH_TRY(checkImageSize(source, state.decoder.image_width, state.decoder.image_height));
    HEARTH_TRY(checkFileSize(source, "JPEG", minFileBytes(state.decoder)));
    HEARTH_ASSIGN_OR_RETURN(
        DecodedImage image,
        allocateImage(source, state.decoder.image_width, state.decoder.image_height, ChannelType::unorm8));
    if (!readTexels(state, imageBytes(image)))
        return failed();
    if (state.decoder.out_color_space == JCS_CMYK)
        rgbFromCmyk(image, state.decoder.saw_Adobe_marker != FALSE);
    return image;
}

} // namespace hearth::import

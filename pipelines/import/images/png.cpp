// Decodes PNG through libpng: damaged checksums, missing rows and a missing end are errors.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/byte_reader.h"
#include "pipelines/import/images/codecs.h"

#include <png.h>

#include <array>
#include <bit>
#include <cstdio>
#include <cstring>

namespace hearth::import
{

namespace
{

constexpr size_t kSignatureBytes = 8;
constexpr uint64_t kChunkFrameBytes = 12; ///< length, type and checksum

/// True if every chunk up to IEND lies inside the file. libpng allocates and clears what a chunk claims
/// before it reads it. Chunks that are cut off in their frame are left to libpng.
bool chunksFit(std::span<const std::byte> bytes)
{
    ByteReader reader(bytes);
    reader.seek(kSignatureBytes);
    while (reader.remaining() >= kChunkFrameBytes)
    {
        const auto length = *reader.read<std::array<uint8_t, 4>>(); // big-endian
        const auto type = *reader.read<std::array<char, 4>>();
        const uint64_t content = uint64_t{length[0]} << 24 | uint64_t{length[1]} << 16 |
                                 uint64_t{length[2]} << 8 | uint64_t{length[3]};
        if (!reader.skip(content) || !reader.skip(4))
            return false;
        if (type == std::array{'I', 'E', 'N', 'D'})
            return true;
    }
    return true;
}

/// State for libpng's callbacks. libpng reports errors by longjmp: no function between setjmp and libpng may
/// own anything, so decodePng holds the memory.
struct PngState
{
    png_structp png = nullptr;
    png_infop info = nullptr;
    std::span<const std::byte> rest;
    std::array<char, 160> message{};

    PngState() = default;
    PngState(const PngState&) = delete;
    PngState& operator=(const PngState&) = delete;
    ~PngState() { png_destroy_read_struct(&png, &info, nullptr); }
};

[[noreturn]] void onError(png_structp png, png_const_charp text)
{
    auto* state = static_cast<PngState*>(png_get_error_ptr(png));
    std::snprintf(state->message.data(), state->message.size(), "%s", text);
    png_longjmp(png, 1);
}

void onWarning(png_structp, png_const_charp) {}

void onRead(png_structp png, png_bytep out, size_t count)
{
    auto* state = static_cast<PngState*>(png_get_io_ptr(png));
    if (count > state->rest.size())
        png_error(png, "the file ends too early");
    std::memcpy(out, state->rest.data(), count);
    state->rest = state->rest.subspan(count);
}

bool readHeader(PngState& state)
{
    if (setjmp(png_jmpbuf(state.png)) != 0)
        return false;
    png_set_read_fn(state.png, &state, onRead);
    png_set_user_limits(state.png, PNG_UINT_31_MAX, PNG_UINT_31_MAX); // checkImageSize sets the limits
    // of the chunks beside the image only tRNS is used; profiles and texts are not even decompressed
    png_set_keep_unknown_chunks(state.png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
    png_read_info(state.png, state.info);
    return true;
}

/// Return the size of the shortest file with the image of the header: compressed as well as Deflate can.
uint64_t minFileBytes(const PngState& state)
{
    const uint64_t texel_bits =
        uint64_t{png_get_bit_depth(state.png, state.info)} * png_get_channels(state.png, state.info);
    const uint64_t row_bytes = (png_get_image_width(state.png, state.info) * texel_bits + 7) / 8;
    return row_bytes * png_get_image_height(state.png, state.info) / kMaxDeflateRatio;
}

/// Read the image, with every kind of PNG converted by libpng to RGBA with channels of 8 bits, or of 16 where
/// the file has 16.
bool readTexels(PngState& state, png_bytepp rows, size_t texel_bytes)
{
    static_assert(std::endian::native == std::endian::little); // PNG is big-endian
    if (setjmp(png_jmpbuf(state.png)) != 0)
        return false;
    png_set_swap(state.png);
    png_set_expand(state.png);
    png_set_gray_to_rgb(state.png);
    png_set_add_alpha(state.png, 0xFFFF, PNG_FILLER_AFTER);
    png_set_interlace_handling(state.png);
    png_read_update_info(state.png, state.info);
    if (png_get_rowbytes(state.png, state.info) != texel_bytes * png_get_image_width(state.png, state.info))
        png_error(state.png, "unexpected size of a row");
    png_read_image(state.png, rows);
    png_read_end(state.png, nullptr);
    return true;
}

} // namespace

Result<DecodedImage> decodePng(const EncodedImage& source)
{
    if (!chunksFit(source.bytes))
        return source.malformed("PNG: the file ends too early");
    PngState state;
    state.rest = source.bytes;
    state.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &state, onError, onWarning);
    state.info = state.png == nullptr ? nullptr : png_create_info_struct(state.png);
    if (state.info == nullptr)
        return source.malformed("libpng cannot be set up");
    const auto failed = [&] { return source.malformed(std::string("PNG: ") + state.message.data()); };

    if (!readHeader(state))
        return failed();
    HEARTH_TRY(checkImageSize(source, png_get_image_width(state.png, state.info),
                              png_get_image_height(state.png, state.info)));
    HEARTH_TRY(checkFileSize(source, "PNG", minFileBytes(state)));
    const ChannelType type =
        png_get_bit_depth(state.png, state.info) == 16 ? ChannelType::unorm16 : ChannelType::unorm8;
    HEARTH_ASSIGN_OR_RETURN(DecodedImage image,
                            allocateImage(source, png_get_image_width(state.png, state.info),
                                          png_get_image_height(state.png, state.info), type));
    std::vector<png_bytep> rows(image.height);
    for (size_t y = 0; y < rows.size(); ++y)
        rows[y] = imageBytes(image) + y * image.width * image.texelBytes();
    if (!readTexels(state, rows.data(), image.texelBytes()))
        return failed();
    return image;
}

} // namespace hearth::import

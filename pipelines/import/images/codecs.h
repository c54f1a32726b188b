// Decoders behind decodeImage, one file for each image format, and their shared helpers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/part/import_options.h"
#include "pipelines/import/part/part_builder.h"

namespace hearth::import
{

/// Encoded image with its name in messages.
struct EncodedImage
{
    std::span<const std::byte> bytes;
    const std::string& name;
    const ImportLimits& limits;

    Error malformed(std::string detail) const
    {
        return {Issue::image_malformed, name, "", std::move(detail)};
    }
    Error unsupported(std::string detail) const
    {
        return {Issue::image_unsupported, name, "", std::move(detail)};
    }
    const uint8_t* data() const { return reinterpret_cast<const uint8_t*>(bytes.data()); }
};

/// Return an image of this size with zero texels; the size is checked before anything is allocated.
/// errors: image_malformed (no texels), input_too_large.
Result<DecodedImage> allocateImage(const EncodedImage& source, uint64_t width, uint64_t height,
                                   ChannelType type);

/// Check the size as allocateImage does, without allocating an image.
Status checkImageSize(const EncodedImage& source, uint64_t width, uint64_t height);

/// Check that the file can hold the image that its header claims, before memory is allocated for it.
/// min_bytes  size of the shortest file with an image of this size, or less
/// errors: image_malformed
Status checkFileSize(const EncodedImage& source, const std::string& format, uint64_t min_bytes);

/// Maximum number of bytes that one byte of Deflate data decodes to.
inline constexpr uint64_t kMaxDeflateRatio = 1032;

inline uint8_t* imageBytes(DecodedImage& image)
{
    return reinterpret_cast<uint8_t*>(image.texels.data());
}

Result<DecodedImage> decodePng(const EncodedImage& source);
Result<DecodedImage> decodeJpeg(const EncodedImage& source);
Result<DecodedImage> decodeWebp(const EncodedImage& source);
Result<DecodedImage> decodeTga(const EncodedImage& source);
Result<DecodedImage> decodeBmp(const EncodedImage& source);
Result<DecodedImage> decodeHdr(const EncodedImage& source);
Result<DecodedImage> decodeExr(const EncodedImage& source);
Result<DecodedImage> decodeKtx2(const EncodedImage& source);
Result<DecodedImage> decodeDds(const EncodedImage& source);

} // namespace hearth::import

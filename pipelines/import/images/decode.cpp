// Chooses the decoder of an image by its first bytes, never by its name, except for TGA, which has no
// signature.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/images/decode.h"

#include "pipelines/import/images/channels.h"
#include "pipelines/import/images/codecs.h"
#include "pipelines/import/images/images_program.h"
#include "pipelines/import/part/import_options.h"
#include "pipelines/import/part/part_builder.h"

#include <algorithm>
#include <array>
#include <optional>

namespace hearth::import
{

namespace
{

using Decoder = Result<DecodedImage> (*)(const EncodedImage&);

struct Signature
{
    std::string_view bytes;
    Decoder decode; ///< null: a known format that this process does not read
    std::string_view format;
    size_t offset = 0;
    std::optional<images::Format> by_program{}; ///< hearth-images reads it; nullopt: it does not
};

using namespace std::string_view_literals;

constexpr std::array kSignatures = {
    Signature{"\x89PNG\r\n\x1A\n"sv, decodePng, "PNG"},
    Signature{"\xFF\xD8"sv, decodeJpeg, "JPEG"},
    Signature{"WEBP"sv, decodeWebp, "WebP", 8},
    Signature{"BM"sv, decodeBmp, "BMP"},
    Signature{"#?RADIANCE"sv, decodeHdr, "HDR"},
    Signature{"#?RGBE"sv, decodeHdr, "HDR"},
    Signature{"\x76\x2F\x31\x01"sv, decodeExr, "EXR", 0, images::Format::exr},
    Signature{"\xABKTX 20\xBB\r\n\x1A\n"sv, decodeKtx2, "KTX2"},
    Signature{"\xABKTX 11\xBB\r\n\x1A\n"sv, nullptr, "KTX1"},
    Signature{"sB\x13\x00"sv, nullptr, "Basis (.basis)"},
    Signature{"GIF8"sv, nullptr, "GIF"},
    Signature{"DDS "sv, decodeDds, "DDS"},
    Signature{"II*\0"sv, nullptr, "TIFF", 0, images::Format::tiff},
    Signature{"MM\0*"sv, nullptr, "TIFF", 0, images::Format::tiff},
    Signature{"II+\0"sv, nullptr, "TIFF", 0, images::Format::tiff}, // BigTIFF
    Signature{"MM\0+"sv, nullptr, "TIFF", 0, images::Format::tiff},
    Signature{"8BPS"sv, nullptr, "PSD", 0, images::Format::psd},
    Signature{"\0\0\0\x0CjP  \r\n\x87\n"sv, nullptr, "JPEG 2000", 0, images::Format::jpeg2000},
    Signature{"\xFF\x4F\xFF\x51"sv, nullptr, "JPEG 2000", 0, images::Format::jpeg2000},
    Signature{"ftypavif"sv, nullptr, "AVIF", 4},
    Signature{"\0\0\0\x0CJXL \r\n\x87\n"sv, nullptr, "JPEG XL"},
    Signature{"\xFF\x0A"sv, nullptr, "JPEG XL"},
};

constexpr std::array kExtensions = {".png"sv, ".jpg"sv, ".jpeg"sv, ".webp"sv, ".tga"sv,
                                    ".bmp"sv, ".hdr"sv, ".exr"sv,  ".ktx2"sv, ".dds"sv};

const Signature* findSignature(std::span<const std::byte> bytes)
{
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const auto* found =
        std::find_if(kSignatures.begin(), kSignatures.end(),
                     [&](const Signature& s)
                     { return text.size() >= s.offset && text.substr(s.offset).starts_with(s.bytes); });
    return found == kSignatures.end() ? nullptr : found;
}

/// True if the fields of the header are consistent with TGA, which has no signature.
bool looksLikeTga(std::span<const std::byte> bytes)
{
    if (bytes.size() < 18)
        return false;
    const auto at = [&](size_t i) { return static_cast<uint8_t>(bytes[i]); };
    const uint8_t type = at(2) & 0xF7u;
    const uint8_t depth = at(16);
    const bool known_depth = depth == 8 || depth == 15 || depth == 16 || depth == 24 || depth == 32;
    return at(1) <= 1 && type >= 1 && type <= 3 && (at(2) & 0xF0u) == 0 && (type == 1) == (at(1) == 1) &&
           known_depth;
}

/// True if an EXR may have an image that decodeExr does not find.
bool mayHaveOtherImages(const EncodedImage& source, const ArtistImages& artist, const Error& error)
{
    constexpr size_t kFlagsOffset = 5;
    constexpr std::byte kMultiPartFlag{0x10};
    const bool has_parts =
        source.bytes.size() > kFlagsOffset && (source.bytes[kFlagsOffset] & kMultiPartFlag) != std::byte{0};
    return artist.program != nullptr && has_parts && error.issue == Issue::image_unsupported;
}

Result<DecodedImage> decodeKnown(const EncodedImage& source, const Signature& signature,
                                 const ArtistImages& artist)
{
    const auto decodeByProgram = [&]
    { return artist.program->decode(*signature.by_program, source, artist.layer, artist.convert_icc); };
    if (signature.decode == nullptr)
        return signature.by_program && artist.program != nullptr
                   ? decodeByProgram()
                   : source.unsupported(std::string(signature.format) + " images are not read");
    const bool asks_for_layer = signature.by_program && artist.program != nullptr && !artist.layer.empty();
    Result<DecodedImage> image = asks_for_layer ? decodeByProgram() : signature.decode(source);
    if (signature.by_program && !image.ok() && mayHaveOtherImages(source, artist, image.error()))
        return decodeByProgram();
    return image;
}

bool hasExtension(std::string_view path, std::string_view extension)
{
    const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
    return path.size() >= extension.size() && std::equal(extension.rbegin(), extension.rend(), path.rbegin(),
                                                         [&](char a, char b) { return a == lower(b); });
}

} // namespace

Status checkImageSize(const EncodedImage& source, uint64_t width, uint64_t height)
{
    const std::string size = std::to_string(width) + " x " + std::to_string(height) + " texels";
    if (width == 0 || height == 0)
        return source.malformed("the image is " + size);
    if (width > source.limits.max_image_size || height > source.limits.max_image_size ||
        width * height > source.limits.max_image_texels)
        return Error{Issue::input_too_large, source.name, "",
                     "the image is " + size + "; at most " + std::to_string(source.limits.max_image_texels) +
                         " in all and " + std::to_string(source.limits.max_image_size) +
                         " on a side are read"};
    return success();
}

Status checkFileSize(const EncodedImage& source, const std::string& format, uint64_t min_bytes)
{
    if (source.bytes.size() >= min_bytes)
        return success();
    return source.malformed(format + ": the file ends too early");
}

Result<DecodedImage> allocateImage(const EncodedImage& source, uint64_t width, uint64_t height,
                                   ChannelType type)
{
    HEARTH_TRY(checkImageSize(source, width, height));
    DecodedImage image;
    image.width = static_cast<uint32_t>(width);
    image.height = static_cast<uint32_t>(height);
    image.type = type;
    image.texels.resize(static_cast<size_t>(width * height) * image.texelBytes());
    return image;
}

Result<DecodedImage> decodeImage(std::span<const std::byte> bytes, const std::string& name,
                                 const ImportLimits& limits, const ArtistImages& artist)
{
    const EncodedImage source{bytes, name, limits};
    if (const Signature* signature = findSignature(bytes))
    {
        HEARTH_ASSIGN_OR_RETURN(DecodedImage image, decodeKnown(source, *signature, artist));
        return dropEmptyBits(std::move(image));
    }
    if (looksLikeTga(bytes))
        return decodeTga(source);
    return source.malformed("the content is that of no image format that is read");
}

bool looksLikeImage(const std::string& path, std::span<const std::byte> bytes)
{
    const Signature* signature = findSignature(bytes);
    // two letters are not enough to identify a BMP: a text may start with them
    const bool certain = signature != nullptr && signature->bytes.size() > 2;
    return certain || std::any_of(kExtensions.begin(), kExtensions.end(),
                                  [&](std::string_view extension) { return hasExtension(path, extension); });
}

} // namespace hearth::import

// Implementation of PNG and JPEG encoding; the only file that includes stb_image_write.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/file_output.h"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace hearth::viewer
{

namespace
{

/// Append a piece of a file; stb's write callback. `context` is the std::vector<std::byte> of the file.
void append(void* context, void* data, int size)
{
    const auto* bytes = static_cast<const std::byte*>(data);
    auto& out = *static_cast<std::vector<std::byte>*>(context);
    out.insert(out.end(), bytes, bytes + size);
}

// Lowest quality at which stb keeps the full resolution of colours; the views of clusters and levels need it.
constexpr int kJpegQuality = 91;

} // namespace

Result<std::vector<std::byte>> encodePng(std::span<const std::byte> rgba, uint32_t width, uint32_t height)
{
    std::vector<std::byte> file;
    const int stride = static_cast<int>(width) * 4;
    if (stbi_write_png_to_func(append, &file, static_cast<int>(width), static_cast<int>(height), 4,
                               rgba.data(), stride) == 0)
        return Error{Issue::internal, "", "", "the PNG encoder failed"};
    return file;
}

Result<std::vector<std::byte>> encodeJpeg(std::span<const std::byte> rgba, uint32_t width, uint32_t height)
{
    std::vector<std::byte> file;
    if (stbi_write_jpg_to_func(append, &file, static_cast<int>(width), static_cast<int>(height), 4,
                               rgba.data(), kJpegQuality) == 0)
        return Error{Issue::internal, "", "", "the JPEG encoder failed"};
    return file;
}

} // namespace hearth::viewer

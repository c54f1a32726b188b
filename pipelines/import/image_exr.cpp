// OpenEXR: scanlines and tiles, every lossless and lossy compression, RGB(A), grey, and luminance with chroma.
// The image is the display window: what the data window leaves open is black.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/image_codecs.h"

#include <OpenEXR/IexBaseExc.h>
#include <OpenEXR/ImfArray.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfRgbaFile.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>

namespace hearth::import
{

namespace
{

class MemoryStream final : public Imf::IStream
{
public:
    MemoryStream(std::span<const std::byte> bytes, const char* name) : IStream(name), bytes_(bytes) {}

    bool isMemoryMapped() const override { return false; }

    bool read(char out[], int count) override
    {
        if (count < 0 || static_cast<uint64_t>(count) > bytes_.size() - position_)
            throw Iex::InputExc("the file ends too early");
        std::memcpy(out, bytes_.data() + position_, static_cast<size_t>(count));
        position_ += static_cast<uint64_t>(count);
        return position_ < bytes_.size();
    }

    uint64_t tellg() override { return position_; }

    void seekg(uint64_t position) override
    {
        if (position > bytes_.size())
            throw Iex::InputExc("an offset lies outside the file");
        position_ = position;
    }

private:
    std::span<const std::byte> bytes_;
    uint64_t position_ = 0;
};

struct Window
{
    int64_t left, top, right, bottom; ///< inclusive, as OpenEXR has it

    explicit Window(const Imath::Box2i& box)
        : left(box.min.x), top(box.min.y), right(box.max.x), bottom(box.max.y)
    {
    }
    uint64_t width() const { return static_cast<uint64_t>(std::max<int64_t>(0, right - left + 1)); }
    uint64_t height() const { return static_cast<uint64_t>(std::max<int64_t>(0, bottom - top + 1)); }
};

/// OpenEXR keeps infinities and NaN; a stored image is finite.
uint16_t finiteBits(half value)
{
    if (value.isNan())
        return 0;
    if (value.isInfinity())
        return value.isNegative() ? uint16_t{0xFBFF} : uint16_t{0x7BFF};
    return value.bits();
}

/// Copy one row of the data window to where it lies in the display window.
void copyRow(const Imf::Rgba* row, int64_t y, const Window& data, const Window& display, DecodedImage& image)
{
    if (y < display.top || y > display.bottom)
        return;
    const int64_t first = std::max(data.left, display.left);
    const int64_t last = std::min(data.right, display.right);
    for (int64_t x = first; x <= last; ++x)
    {
        const Imf::Rgba& texel = row[x - data.left];
        const uint16_t bits[4] = {finiteBits(texel.r), finiteBits(texel.g), finiteBits(texel.b),
                                  finiteBits(texel.a)};
        const auto index =
            static_cast<size_t>(y - display.top) * image.width + static_cast<size_t>(x - display.left);
        std::memcpy(image.texels.data() + index * sizeof(bits), bits, sizeof(bits));
    }
}

// OpenEXR holds a row of whole tiles, and tiles may be larger than the image. Programs write 64 to 512.
constexpr int kMaxTileSide = 4096;

/// OpenEXR checks these before it allocates anything by the header.
void setLibraryLimits(const ImportLimits& limits)
{
    const int side = static_cast<int>(limits.max_image_size);
    Imf::Header::setMaxImageSize(side, side);
    Imf::Header::setMaxTileSize(kMaxTileSide, kMaxTileSide);
}

Result<DecodedImage> decode(const EncodedImage& source)
{
    setLibraryLimits(source.limits);
    MemoryStream stream(source.bytes, source.name.c_str());
    Imf::RgbaInputFile file(stream, 0);
    const Window data(file.dataWindow());
    const Window display(file.displayWindow());
    HEARTH_TRY(checkImageSize(source, data.width(), data.height()));
    if (!file.isComplete())
        return source.malformed("EXR: parts of the image are missing");
    if ((file.channels() & (Imf::WRITE_RGB | Imf::WRITE_YC)) == 0)
        return source.unsupported("EXR images without a channel R, G, B or Y are not read");
    HEARTH_ASSIGN_OR_RETURN(DecodedImage image,
                            allocateImage(source, display.width(), display.height(), true));
    if ((file.channels() & Imf::WRITE_A) == 0)
    {
        const uint16_t opaque[4] = {0, 0, 0, half(1.0f).bits()};
        for (size_t at = 0; at < image.texels.size(); at += sizeof(opaque))
            std::memcpy(image.texels.data() + at, opaque, sizeof(opaque));
    }

    // one row at a time: OpenEXR addresses the frame buffer by absolute coordinates, with a row stride of 0 here
    std::vector<Imf::Rgba> row(static_cast<size_t>(data.width()));
    file.setFrameBuffer(row.data() - data.left, 1, 0);
    for (int64_t y = data.top; y <= data.bottom; ++y)
    {
        file.readPixels(static_cast<int>(y));
        copyRow(row.data(), y, data, display, image);
    }
    return image;
}

} // namespace

Result<DecodedImage> decodeExr(const EncodedImage& source)
{
    try
    {
        return decode(source);
    }
    catch (const std::exception& problem)
    {
        return source.malformed(std::string("EXR: ") + problem.what());
    }
    catch (...)
    {
        return source.malformed("EXR: the file cannot be read");
    }
}

} // namespace hearth::import

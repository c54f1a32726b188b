// Decodes OpenEXR: scanlines and tiles, every lossless and lossy compression, RGB(A), grey, and luminance
// with chroma. The image is the data window, as in other texture tools: a texture has no display window.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/byte_reader.h"
#include "pipelines/import/images/codecs.h"
#include "pipelines/import/images/float_image.h"

#include <OpenEXR/IexBaseExc.h>
#include <OpenEXR/ImfArray.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <OpenEXR/ImfTileDescription.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <optional>
#include <set>
#include <string_view>

namespace hearth::import
{

namespace
{

// OpenEXR puts the name of its stream into its messages. Ours name the file already: this name is removed.
constexpr const char* kStreamName = "(memory)";

/// Return a message of OpenEXR without the name of its stream.
std::string removeStreamName(std::string message)
{
    const std::string quoted = " \"" + std::string(kStreamName) + "\"";
    for (size_t at = message.find(quoted); at != message.npos; at = message.find(quoted))
        message.erase(at, quoted.size());
    return message;
}

class MemoryStream final : public Imf::IStream
{
public:
    explicit MemoryStream(std::span<const std::byte> bytes) : IStream(kStreamName), bytes_(bytes) {}

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
    int64_t left, top, right, bottom; ///< inclusive, as in OpenEXR

    explicit Window(const Imath::Box2i& box)
        : left(box.min.x), top(box.min.y), right(box.max.x), bottom(box.max.y)
    {
    }
    uint64_t width() const { return static_cast<uint64_t>(std::max<int64_t>(0, right - left + 1)); }
    uint64_t height() const { return static_cast<uint64_t>(std::max<int64_t>(0, bottom - top + 1)); }
};

/// Return the bits of a finite half: OpenEXR allows infinities and NaN, stored images do not.
uint16_t finiteBits(half value)
{
    if (value.isNan())
        return 0;
    if (value.isInfinity())
        return value.isNegative() ? uint16_t{0xFBFF} : uint16_t{0x7BFF};
    return value.bits();
}

/// Store row `y` of the image.
void storeRow(std::span<const Imf::Rgba> row, size_t y, DecodedImage& image)
{
    for (size_t x = 0; x < row.size(); ++x)
    {
        const uint16_t bits[4] = {finiteBits(row[x].r), finiteBits(row[x].g), finiteBits(row[x].b),
                                  finiteBits(row[x].a)};
        std::memcpy(image.texels.data() + (y * row.size() + x) * sizeof(bits), bits, sizeof(bits));
    }
}

// Largest tile: OpenEXR holds a row of whole tiles, and tiles may be larger than the image. Programs write 64
// to 512.
constexpr int kMaxTileSide = 4096;

constexpr size_t kVersionOffset = 4; ///< after the magic number
constexpr size_t kHeaderOffset = 8;
constexpr uint32_t kMultiPartFlag = 0x1000;

/// Read a text up to its zero; nullopt if there is none.
std::optional<std::string_view> readName(ByteReader& reader, std::span<const std::byte> bytes)
{
    const std::string_view rest(reinterpret_cast<const char*>(bytes.data()) + reader.position(),
                                reader.remaining());
    const size_t end = rest.find('\0');
    if (end == rest.npos)
        return std::nullopt;
    reader.skip(end + 1);
    return rest.substr(0, end);
}

/// True if every attribute lies inside the file. OpenEXR allocates what an attribute claims before it reads.
bool attributesFit(std::span<const std::byte> bytes)
{
    ByteReader reader(bytes);
    reader.seek(std::min(kVersionOffset, bytes.size()));
    const auto version = reader.read<uint32_t>();
    if (!version)
        return false;
    // the headers of a file of several parts end with an empty one
    const bool is_multi_part = (*version & kMultiPartFlag) != 0;
    bool is_header_empty = true;
    for (;;)
    {
        const auto name = readName(reader, bytes);
        if (!name)
            return false;
        if (name->empty())
        {
            if (!is_multi_part || is_header_empty)
                return true;
            is_header_empty = true;
            continue;
        }
        is_header_empty = false;
        const auto type = readName(reader, bytes);
        const auto size = type ? reader.read<uint32_t>() : std::nullopt;
        if (!size || !reader.skip(*size))
            return false;
    }
}

// Maximum ratios of compression, rounded up. Deflate packs best; PXR24 drops a byte of four before. DWA
// packs a block of 64 texels of up to four bytes into two coefficients of two bytes, or runs, before.
constexpr uint64_t kMaxRatio = 2 * kMaxDeflateRatio;
constexpr uint64_t kMaxDwaRatio = 128 * kMaxDeflateRatio;

// Minimum size of a tile that can be too large. OpenEXR allocates a whole tile, however small the image.
constexpr uint64_t kMinLargeTileBytes = uint64_t{64} << 20;

/// Return the bytes of a texel, in all channels.
double texelBytes(const Imf::Header& header)
{
    double bytes = 0;
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel)
        bytes += (channel.channel().type == Imf::HALF ? 2.0 : 4.0) /
                 (std::max(1.0, double(channel.channel().xSampling)) *
                  std::max(1.0, double(channel.channel().ySampling)));
    return bytes;
}

/// Read the header of the first part; the stream is behind it then.
/// version  set to the file's version and flags
Imf::Header readFirstHeader(const EncodedImage& source, MemoryStream& stream, int& version)
{
    stream.seekg(kHeaderOffset);
    std::memcpy(&version, source.bytes.data() + kVersionOffset, sizeof(version));
    Imf::Header header;
    header.readFrom(stream, version);
    return header;
}

/// Check that the file can hold what the header of its first part claims, before OpenEXR allocates it.
Status checkHeader(const EncodedImage& source)
{
    if (!attributesFit(source.bytes))
        return source.malformed("EXR: the file ends too early");
    MemoryStream stream(source.bytes);
    int version = 0;
    const Imf::Header header = readFirstHeader(source, stream, version);
    const Window data(header.dataWindow());
    HEARTH_TRY(checkImageSize(source, data.width(), data.height()));
    const double texel_bytes = texelBytes(header);
    const auto image_bytes =
        static_cast<uint64_t>(texel_bytes * static_cast<double>(data.width() * data.height()));
    const bool is_dwa =
        header.compression() == Imf::DWAA_COMPRESSION || header.compression() == Imf::DWAB_COMPRESSION;
    HEARTH_TRY(checkFileSize(source, "EXR", image_bytes / (is_dwa ? kMaxDwaRatio : kMaxRatio)));
    if (!header.hasTileDescription())
        return success();
    const Imf::TileDescription& tile = header.tileDescription();
    if (texel_bytes * tile.xSize * tile.ySize >
        static_cast<double>(std::max(kMinLargeTileBytes, 4 * image_bytes)))
        return source.unsupported("EXR: tiles of " + std::to_string(tile.xSize) + " x " +
                                  std::to_string(tile.ySize) + " texels are not read");
    return success();
}

/// True if OpenEXR's reader of RGBA takes the channel.
bool isImageChannel(std::string_view name)
{
    constexpr std::string_view kNames[] = {"R", "G", "B", "A", "Y", "RY", "BY"};
    return std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
}

/// Add the layers of a part to `layers`: "diffuse" for a channel "diffuse.R", "Z" for a channel "Z".
void addLayers(const Imf::Header& header, std::set<std::string>& layers)
{
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel)
    {
        const std::string name = channel.name();
        if (!isImageChannel(name))
            layers.insert(name.substr(0, name.rfind('.')));
    }
}

/// Return what the file holds beside the image: layers of its first part, and other parts.
std::vector<std::string> listOtherLayers(const EncodedImage& source)
{
    // more are not named, and no file needs them
    constexpr size_t kMaxParts = 256;
    MemoryStream stream(source.bytes);
    int version = 0;
    const Imf::Header header = readFirstHeader(source, stream, version);
    std::set<std::string> layers;
    addLayers(header, layers);
    std::vector<std::string> names(layers.begin(), layers.end());
    for (size_t part = 1; part < kMaxParts && (static_cast<uint32_t>(version) & kMultiPartFlag) != 0; ++part)
    {
        Imf::Header other;
        other.readFrom(stream, version);
        if (other.readsNothing())
            break;
        names.push_back(other.hasName() ? "part " + other.name() : "part " + std::to_string(part));
    }
    return names;
}

/// Return "diffuse, specular, Z and 4 more".
std::string joinNames(const std::vector<std::string>& names)
{
    constexpr size_t kMaxNames = 4;
    std::string text;
    for (size_t i = 0; i < std::min(names.size(), kMaxNames); ++i)
        text += (i == 0 ? "" : ", ") + names[i].substr(0, 40);
    return names.size() <= kMaxNames ? text
                                     : text + " and " + std::to_string(names.size() - kMaxNames) + " more";
}

/// Add notes of what of the file is not in the image.
void noteLosses(const EncodedImage& source, const Imf::ChannelList& channels, DecodedImage& image)
{
    const std::vector<std::string> layers = listOtherLayers(source);
    if (!layers.empty())
        image.notes.push_back(
            {Issue::image_layers, "layers beside the image are not kept: " + joinNames(layers)});
    for (auto channel = channels.begin(); channel != channels.end(); ++channel)
        if (isImageChannel(channel.name()) && channel.channel().type != Imf::HALF)
        {
            image.notes.push_back({Issue::image_depth, "its channels have 32 bits, 16 are kept, as floats"});
            break;
        }
}

/// Set the limits that OpenEXR checks before it allocates anything by the header.
void setLibraryLimits(const ImportLimits& limits)
{
    const int side = static_cast<int>(limits.max_image_size);
    Imf::Header::setMaxImageSize(side, side);
    Imf::Header::setMaxTileSize(kMaxTileSide, kMaxTileSide);
}

Result<DecodedImage> decode(const EncodedImage& source)
{
    setLibraryLimits(source.limits);
    HEARTH_TRY(checkHeader(source));
    MemoryStream stream(source.bytes);
    Imf::RgbaInputFile file(stream, 0);
    const Window data(file.dataWindow());
    HEARTH_TRY(checkImageSize(source, data.width(), data.height()));
    if (!file.isComplete())
        return source.malformed("EXR: parts of the image are missing");
    if ((file.channels() & (Imf::WRITE_RGB | Imf::WRITE_YC)) == 0)
        return source.unsupported("EXR images without a channel R, G, B or Y are not read");
    HEARTH_ASSIGN_OR_RETURN(DecodedImage image,
                            allocateImage(source, data.width(), data.height(), ChannelType::float16));

    // one row at a time: OpenEXR addresses the frame buffer by absolute coordinates; its row stride is 0 here
    std::vector<Imf::Rgba> row(static_cast<size_t>(data.width()));
    file.setFrameBuffer(row.data() - data.left, 1, 0);
    for (int64_t y = data.top; y <= data.bottom; ++y)
    {
        file.readPixels(static_cast<int>(y));
        storeRow(row, static_cast<size_t>(y - data.top), image);
    }
    noteLosses(source, file.header().channels(), image);
    return image;
}

/// Return an image whose rows readRow(y, row) fills, from top to bottom.
template <typename ReadRow>
Result<FloatImage> readRows(const EncodedImage& source, const Window& data, ReadRow&& readRow)
{
    HEARTH_TRY(checkImageSize(source, data.width(), data.height()));
    FloatImage image{static_cast<uint32_t>(data.width()), static_cast<uint32_t>(data.height()), 1, {}};
    image.texels.resize(size_t{image.width} * image.height);
    for (uint32_t y = 0; y < image.height; ++y)
        readRow(data.top + y, std::span(image.texels).subspan(size_t{y} * image.width, image.width));
    return image;
}

/// Read an image with chroma, which OpenEXR converts in half floats.
Result<FloatImage> readChroma(const EncodedImage& source)
{
    MemoryStream stream(source.bytes);
    Imf::RgbaInputFile file(stream, 0);
    const Window data(file.dataWindow());
    std::vector<Imf::Rgba> texels(static_cast<size_t>(data.width()));
    file.setFrameBuffer(texels.data() - data.left, 1, 0);
    return readRows(source, data,
                    [&](int64_t y, std::span<Float3> row)
                    {
                        file.readPixels(static_cast<int>(y));
                        for (size_t x = 0; x < row.size(); ++x)
                            row[x] = {texels[x].r, texels[x].g, texels[x].b};
                    });
}

/// Read R, G and B, or Y as grey. Channels that the file lacks are 0.
Result<FloatImage> readColors(const EncodedImage& source, Imf::InputFile& file, bool is_grey)
{
    const Window data(file.header().dataWindow());
    std::vector<Float3> texels(static_cast<size_t>(data.width()));
    Imf::FrameBuffer buffer;
    const auto addSlice = [&](const char* name, float& first)
    {
        auto* const base = reinterpret_cast<char*>(&first) - data.left * static_cast<int64_t>(sizeof(Float3));
        buffer.insert(name, Imf::Slice(Imf::FLOAT, base, sizeof(Float3), 0));
    };
    if (is_grey)
        addSlice("Y", texels[0].x);
    else
    {
        addSlice("R", texels[0].x);
        addSlice("G", texels[0].y);
        addSlice("B", texels[0].z);
    }
    file.setFrameBuffer(buffer);
    return readRows(source, data,
                    [&](int64_t y, std::span<Float3> row)
                    {
                        file.readPixels(static_cast<int>(y));
                        for (size_t x = 0; x < row.size(); ++x)
                            row[x] = is_grey ? Float3{texels[x].x, texels[x].x, texels[x].x} : texels[x];
                    });
}

Result<FloatImage> decodeFloats(const EncodedImage& source)
{
    setLibraryLimits(source.limits);
    HEARTH_TRY(checkHeader(source));
    MemoryStream stream(source.bytes);
    Imf::InputFile file(stream, 0);
    if (!file.isComplete())
        return source.malformed("EXR: parts of the image are missing");
    const Imf::ChannelList& channels = file.header().channels();
    const auto has = [&](const char* name) { return channels.findChannel(name) != nullptr; };
    if (has("RY") || has("BY"))
        return readChroma(source);
    const bool has_colors = has("R") || has("G") || has("B");
    if (!has_colors && !has("Y"))
        return source.unsupported("EXR images without a channel R, G, B or Y are not read");
    return readColors(source, file, !has_colors);
}

/// Return the result of decoding, or the exception that OpenEXR threw as an error.
template <typename Decode>
auto catchProblems(const EncodedImage& source, Decode&& decodeSource) -> decltype(decodeSource(source))
{
    try
    {
        return decodeSource(source);
    }
    catch (const std::exception& problem)
    {
        return source.malformed("EXR: " + removeStreamName(problem.what()));
    }
    catch (...)
    {
        return source.malformed("EXR: the file cannot be read");
    }
}

} // namespace

Result<DecodedImage> decodeExr(const EncodedImage& source)
{
    return catchProblems(source, decode);
}

Result<FloatImage> decodeExrFloats(const EncodedImage& source)
{
    return catchProblems(source, decodeFloats);
}

} // namespace hearth::import

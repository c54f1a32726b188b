// Decodes Radiance images (.hdr): RGBE, flat, with old or new run-length coding, all eight orientations.
// Source: G. Ward, "Real Pixels", Graphics Gems II, 1991, and the Radiance file formats document.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/byte_reader.h"
#include "formats/base/half.h"
#include "pipelines/import/images/codecs.h"
#include "pipelines/import/images/float_image.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstring>

namespace hearth::import
{

namespace
{

using Rgbe = std::array<uint8_t, 4>;

/// Longest header line of a Radiance file; longer ones mean that the file is of another format.
constexpr size_t kMaxLine = 4096;

struct HdrHeader
{
    double exposure = 1; ///< product of all EXPOSURE lines; the stored values are radiance times this
    bool xyze = false;
    bool rows_are_columns = false; ///< the resolution line names X first: scanlines are columns
    bool x_descends = false;
    bool y_descends = true; ///< -Y: from top to bottom
    uint64_t width = 0;
    uint64_t height = 0;
};

std::optional<std::string_view> readLine(ByteReader& reader, std::span<const std::byte> bytes)
{
    const size_t start = reader.position();
    const size_t length = std::min(kMaxLine, reader.remaining());
    const auto* text = reinterpret_cast<const char*>(bytes.data()) + start;
    const auto* end = static_cast<const char*>(std::memchr(text, '\n', length));
    if (end == nullptr || !reader.skip(static_cast<uint64_t>(end - text) + 1))
        return std::nullopt;
    std::string_view line(text, static_cast<size_t>(end - text));
    if (line.ends_with('\r'))
        line.remove_suffix(1);
    return line;
}

bool readNumber(std::string_view& text, uint64_t& number)
{
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc())
        return false;
    text.remove_prefix(static_cast<size_t>(end - text.data()));
    return true;
}

/// Parse "-Y 512 +X 1024": sign, axis, size, twice.
bool readResolution(std::string_view line, HdrHeader& header)
{
    bool seen[2] = {false, false};
    for (int i = 0; i < 2; ++i)
    {
        if (line.size() < 4 || (line[0] != '-' && line[0] != '+') || (line[1] != 'X' && line[1] != 'Y') ||
            line[2] != ' ')
            return false;
        const bool is_x = line[1] == 'X';
        (is_x ? header.x_descends : header.y_descends) = line[0] == '-';
        seen[is_x ? 0 : 1] = true;
        header.rows_are_columns = i == 0 ? is_x : header.rows_are_columns;
        line.remove_prefix(3);
        if (!readNumber(line, is_x ? header.width : header.height))
            return false;
        if (i == 0 && !line.starts_with(' '))
            return false;
        if (i == 0)
            line.remove_prefix(1);
    }
    return seen[0] && seen[1] && line.find_first_not_of(' ') == std::string_view::npos;
}

std::optional<HdrHeader> readHeader(ByteReader& reader, std::span<const std::byte> bytes)
{
    HdrHeader header;
    for (;;)
    {
        const auto line = readLine(reader, bytes);
        if (!line)
            return std::nullopt;
        if (line->empty())
            break;
        if (line->starts_with("FORMAT=32-bit_rle_xyze"))
            header.xyze = true;
        if (line->starts_with("EXPOSURE="))
        {
            double exposure = 0;
            const size_t digits = std::min(line->find_first_not_of(' ', 9), line->size());
            const auto result = std::from_chars(line->data() + digits, line->data() + line->size(), exposure);
            if (result.ec != std::errc() || !std::isfinite(exposure) || exposure <= 0)
                return std::nullopt;
            header.exposure *= exposure;
        }
    }
    const auto resolution = readLine(reader, bytes);
    if (!resolution || !readResolution(*resolution, header))
        return std::nullopt;
    return header;
}

/// Read the new coding: each of the four components separately; a count above 128 repeats one value.
bool readComponents(ByteReader& reader, std::vector<Rgbe>& scanline)
{
    for (size_t component = 0; component < 4; ++component)
        for (size_t x = 0; x < scanline.size();)
        {
            const auto head = reader.read<uint8_t>();
            const bool repeated = head && *head > 128;
            const size_t count = !head ? 0 : repeated ? *head - 128u : *head;
            const auto values = reader.readBytes(repeated ? 1 : count);
            if (count == 0 || !values || count > scanline.size() - x)
                return false;
            for (size_t k = 0; k < count; ++k)
                scanline[x++][component] = static_cast<uint8_t>((*values)[repeated ? 0 : k]);
        }
    return true;
}

/// Read flat texels or the old coding: the texel (1, 1, 1, n) repeats the previous one n times, shifted by 8
/// bits for each such texel in a row.
bool readFlat(ByteReader& reader, Rgbe first, std::vector<Rgbe>& scanline)
{
    uint32_t shift = 0;
    size_t x = 0;
    std::optional<Rgbe> texel = first;
    for (;;)
    {
        if (!texel)
            return false;
        const Rgbe& t = *texel;
        if (t[0] == 1 && t[1] == 1 && t[2] == 1)
        {
            const uint64_t count = shift < 32 ? uint64_t{t[3]} << shift : scanline.size() + 1;
            if (x == 0 || count > scanline.size() - x)
                return false;
            std::fill_n(scanline.begin() + static_cast<std::ptrdiff_t>(x), count, scanline[x - 1]);
            x += static_cast<size_t>(count);
            shift += 8;
        }
        else
        {
            scanline[x++] = t;
            shift = 0;
        }
        if (x == scanline.size())
            return true;
        texel = reader.read<Rgbe>();
    }
}

/// Return the size of the texels of the shortest file: each scanline has a texel and old runs of at most 255
/// and 65280 texels, four bytes each. The new coding is longer.
uint64_t minTexelBytes(const HdrHeader& header)
{
    const uint64_t length = header.rows_are_columns ? header.height : header.width;
    const uint64_t count = header.rows_are_columns ? header.width : header.height;
    return count * sizeof(Rgbe) * (1u + (length > 1 ? 1u : 0u) + (length > 256 ? 1u : 0u));
}

bool readScanline(ByteReader& reader, std::vector<Rgbe>& scanline)
{
    const auto first = reader.read<Rgbe>();
    if (!first)
        return false;
    const bool coded = (*first)[0] == 2 && (*first)[1] == 2 && (*first)[2] < 128 &&
                       ((*first)[2] * size_t{256} + (*first)[3]) == scanline.size();
    return coded ? readComponents(reader, scanline) : readFlat(reader, *first, scanline);
}

/// File whose header is read and checked.
struct OpenHdr
{
    ByteReader reader; ///< at the first scanline
    HdrHeader header;
};

Result<OpenHdr> openHdr(const EncodedImage& source)
{
    ByteReader reader(source.bytes);
    const auto header = readHeader(reader, source.bytes);
    if (!header)
        return source.malformed("HDR: the header is damaged, or has a line of more than " +
                                std::to_string(kMaxLine) + " bytes");
    if (header->xyze)
        return source.unsupported("HDR images in XYZ are not read");
    HEARTH_TRY(checkImageSize(source, header->width, header->height));
    HEARTH_TRY(checkFileSize(source, "HDR", reader.position() + minTexelBytes(*header)));
    return OpenHdr{reader, *header};
}

/// Read all texels: calls store(index in the upright image, colour) for each.
template <typename Store>
Status readTexels(const EncodedImage& source, OpenHdr& file, Store&& store)
{
    const HdrHeader& header = file.header;
    const auto width = static_cast<size_t>(header.width), height = static_cast<size_t>(header.height);
    const bool columns = header.rows_are_columns;
    std::vector<Rgbe> scanline(columns ? height : width);
    const size_t scanline_count = columns ? width : height;
    for (size_t i = 0; i < scanline_count; ++i)
    {
        if (!readScanline(file.reader, scanline))
            return source.malformed("HDR: scanline " + std::to_string(i) +
                                    " is damaged or the file ends too early");
        for (size_t k = 0; k < scanline.size(); ++k)
        {
            const size_t along_x = columns ? i : k;
            const size_t along_y = columns ? k : i;
            const size_t x = header.x_descends ? width - 1 - along_x : along_x;
            const size_t y = header.y_descends ? along_y : height - 1 - along_y;
            const Rgbe& t = scanline[k];
            const double scale = t[3] == 0 ? 0.0 : std::ldexp(1.0 / header.exposure, t[3] - (128 + 8));
            store(y * width + x, Float3{static_cast<float>(t[0] * scale), static_cast<float>(t[1] * scale),
                                        static_cast<float>(t[2] * scale)});
        }
    }
    return success();
}

} // namespace

Result<DecodedImage> decodeHdr(const EncodedImage& source)
{
    HEARTH_ASSIGN_OR_RETURN(OpenHdr file, openHdr(source));
    HEARTH_ASSIGN_OR_RETURN(DecodedImage image, allocateImage(source, file.header.width, file.header.height,
                                                              ChannelType::float16));
    HEARTH_TRY(readTexels(source, file,
                          [&](size_t at, Float3 color)
                          {
                              const std::array<uint16_t, 4> half = {halfFromFloat(color.x),
                                                                    halfFromFloat(color.y),
                                                                    halfFromFloat(color.z), halfFromFloat(1)};
                              std::memcpy(image.texels.data() + at * sizeof(half), half.data(), sizeof(half));
                          }));
    return image;
}

Result<FloatImage> decodeHdrFloats(const EncodedImage& source)
{
    HEARTH_ASSIGN_OR_RETURN(OpenHdr file, openHdr(source));
    FloatImage image{
        static_cast<uint32_t>(file.header.width), static_cast<uint32_t>(file.header.height), 1, {}};
    image.texels.resize(size_t{image.width} * image.height);
    HEARTH_TRY(readTexels(source, file, [&](size_t at, Float3 color) { image.texels[at] = color; }));
    return image;
}

} // namespace hearth::import

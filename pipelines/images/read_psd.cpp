// Source: Adobe Photoshop File Formats Specification, November 2019. OpenImageIO 2.4 is not used: it takes
// the black of CMYK for alpha, drops the alpha of CMYK, and rounds colours down where it takes white away.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/images/read_psd.h"

#include <algorithm>
#include <cstring>
#include <optional>

namespace hearth::images
{

namespace
{

enum class Mode : uint16_t
{
    bitmap = 0,
    grey = 1,
    indexed = 2,
    rgb = 3,
    cmyk = 4,
    duotone = 8,
};

Error malformed(const std::string& detail)
{
    return {Issue::image_malformed, "", "", "PSD: " + detail};
}

Error unsupported(const std::string& detail)
{
    return {Issue::image_unsupported, "", "", "PSD: " + detail};
}

/// Reader of big-endian numbers. It fails for good at the end of its bytes, and reads zeros then.
class BigEndianReader
{
public:
    explicit BigEndianReader(std::span<const std::byte> bytes) : rest_(bytes) {}

    bool failed() const { return failed_; }
    bool atEnd() const { return rest_.empty(); }

    std::span<const std::byte> take(uint64_t size)
    {
        failed_ = failed_ || size > rest_.size();
        if (failed_)
            return {};
        const auto taken = rest_.first(static_cast<size_t>(size));
        rest_ = rest_.subspan(taken.size());
        return taken;
    }

    uint64_t read(size_t size)
    {
        uint64_t number = 0;
        for (const std::byte byte : take(size))
            number = number << 8 | static_cast<uint8_t>(byte);
        return number;
    }

private:
    std::span<const std::byte> rest_;
    bool failed_ = false;
};

struct Psd
{
    bool is_big = false; ///< PSB: some sizes have twice the bytes
    uint32_t channel_count = 0;
    uint32_t width = 0;
    uint32_t height = 0;
    uint32_t depth = 8;
    Mode mode = Mode::rgb;
    std::span<const std::byte> palette;
    std::span<const std::byte> profile;
    bool has_composite = true;
    bool first_alpha_is_transparency = false;
};

/// Read the image resources that matter: 1057 says whether the composite is real, 1039 is the ICC profile.
void readResources(std::span<const std::byte> bytes, Psd& psd)
{
    constexpr uint64_t kVersionInfo = 1057, kProfile = 1039;
    BigEndianReader reader(bytes);
    while (!reader.atEnd() && !reader.failed())
    {
        reader.take(4); // "8BIM"
        const uint64_t id = reader.read(2);
        reader.take(reader.read(1) | 1u); // a name and its size fill an even number of bytes
        const uint64_t size = reader.read(4);
        const std::span<const std::byte> content = reader.take(size);
        reader.take(reader.atEnd() ? 0 : size & 1u);
        if (id == kVersionInfo && content.size() > 4) // after a version
            psd.has_composite = content[4] != std::byte{0};
        if (id == kProfile)
            psd.profile = content;
    }
}

/// Read the number of layers, whose sign says what the first channel after the colours is.
void readLayerCount(std::span<const std::byte> bytes, Psd& psd)
{
    BigEndianReader reader(bytes);
    if (reader.read(psd.is_big ? 8 : 4) > 0)
        psd.first_alpha_is_transparency = (reader.read(2) & 0x8000u) != 0;
}

Result<Psd> readSections(BigEndianReader& reader)
{
    Psd psd;
    reader.take(4); // signature
    const uint64_t version = reader.read(2);
    psd.is_big = version == 2;
    reader.take(6);
    psd.channel_count = static_cast<uint32_t>(reader.read(2));
    psd.height = static_cast<uint32_t>(reader.read(4));
    psd.width = static_cast<uint32_t>(reader.read(4));
    psd.depth = static_cast<uint32_t>(reader.read(2));
    psd.mode = static_cast<Mode>(reader.read(2));
    psd.palette = reader.take(reader.read(4));
    readResources(reader.take(reader.read(4)), psd);
    readLayerCount(reader.take(reader.read(psd.is_big ? 8 : 4)), psd);
    if (reader.failed())
        return malformed("the file ends too early");
    if (version != 1 && version != 2)
        return unsupported("version " + std::to_string(version) + " is not read");
    return psd;
}

/// Return the channels of the mode's colour; 0: it is not read.
uint32_t countColors(Mode mode)
{
    switch (mode)
    {
    case Mode::bitmap:
    case Mode::grey:
    case Mode::indexed:
    case Mode::duotone:
        return 1;
    case Mode::rgb:
        return 3;
    case Mode::cmyk:
        return 4;
    }
    return 0;
}

Status checkHeader(const Request& request, const Psd& psd)
{
    HEARTH_TRY(checkSize(request, psd.width, psd.height));
    const uint32_t colors = countColors(psd.mode);
    if (colors == 0)
        return unsupported("only bitmap, grey, indexed, RGB and CMYK images are read: convert it to RGB");
    if (!psd.has_composite)
        return unsupported("it has no composite image: save it with 'Maximise compatibility'");
    const bool is_bitmap = psd.mode == Mode::bitmap, is_indexed = psd.mode == Mode::indexed;
    const bool fits = is_bitmap    ? psd.depth == 1
                      : is_indexed ? psd.depth == 8
                                   : psd.depth == 8 || psd.depth == 16 || psd.depth == 32;
    if (!fits || (psd.mode == Mode::cmyk && psd.depth == 32))
        return unsupported("its channels of " + std::to_string(psd.depth) + " bits are not read");
    if (psd.channel_count < colors || (is_indexed && psd.palette.size() < 768))
        return malformed("channels or the palette are missing");
    return success();
}

/// Unpack a row of PackBits; false unless it has as many bytes as `row`.
bool unpackRow(std::span<const std::byte> packed, std::span<std::byte> row)
{
    size_t from = 0, to = 0;
    while (from < packed.size())
    {
        const auto head = static_cast<int8_t>(packed[from++]);
        if (head == -128)
            continue;
        const size_t count = head >= 0 ? static_cast<size_t>(head) + 1 : static_cast<size_t>(1 - head);
        const size_t used = head >= 0 ? count : 1;
        if (used > packed.size() - from || count > row.size() - to)
            return false;
        if (head >= 0)
            std::memcpy(row.data() + to, packed.data() + from, count);
        else
            std::fill_n(row.data() + to, count, packed[from]);
        from += used;
        to += count;
    }
    return to == row.size();
}

/// Put a row of big-endian numbers into channel `channel` of interleaved ones.
void scatterRow(std::span<const std::byte> row, size_t bytes, size_t channel, size_t channel_count,
                std::byte* to)
{
    for (size_t x = 0; x < row.size() / bytes; ++x)
        for (size_t b = 0; b < bytes; ++b)
            to[(x * channel_count + channel) * bytes + b] = row[x * bytes + bytes - 1 - b];
}

/// Put a row of bits, of which 1 is black, into bytes.
void scatterBits(std::span<const std::byte> row, uint32_t width, std::byte* to)
{
    for (uint32_t x = 0; x < width; ++x)
        to[x] = (row[x / 8] >> (7 - x % 8) & std::byte{1}) != std::byte{0} ? std::byte{0} : std::byte{255};
}

/// Read the first channels of the image, as many as samples.channel_count.
Status readRows(const Psd& psd, BigEndianReader& reader, Samples& samples)
{
    const uint64_t compression = reader.read(2);
    if (compression > 1)
        return unsupported("a composite that is compressed by Deflate is not read");
    const bool is_packed = compression == 1;
    BigEndianReader sizes(
        reader.take(is_packed ? uint64_t{psd.height} * psd.channel_count * (psd.is_big ? 4 : 2) : 0));
    if (reader.failed())
        return malformed("the file ends too early");
    const size_t bytes = numberBytes(samples.number);
    const size_t row_bytes = psd.depth == 1 ? (psd.width + 7) / 8 : psd.width * bytes;
    const size_t stride = size_t{samples.channel_count} * psd.width * bytes;
    samples.values.resize(stride * psd.height);
    std::vector<std::byte> unpacked(is_packed ? row_bytes : 0);
    for (uint32_t channel = 0; channel < samples.channel_count; ++channel)
        for (uint32_t y = 0; y < psd.height; ++y)
        {
            const std::span<const std::byte> stored =
                reader.take(is_packed ? sizes.read(psd.is_big ? 4 : 2) : row_bytes);
            if (reader.failed())
                return malformed("the file ends too early");
            if (is_packed && !unpackRow(stored, unpacked))
                return malformed("a row is damaged");
            const std::span<const std::byte> row = is_packed ? unpacked : stored;
            std::byte* to = samples.values.data() + stride * y;
            if (psd.depth == 1)
                scatterBits(row, psd.width, to);
            else
                scatterRow(row, bytes, channel, samples.channel_count, to);
        }
    return success();
}

/// Replace numbers of palette entries by their colours. The palette has all reds first.
void expandPalette(std::span<const std::byte> palette, Samples& samples)
{
    std::vector<std::byte> colors(samples.values.size() * 3);
    for (size_t i = 0; i < samples.values.size(); ++i)
        for (size_t c = 0; c < 3; ++c)
            colors[i * 3 + c] = palette[c * 256 + static_cast<size_t>(samples.values[i])];
    samples.values = std::move(colors);
    samples.channel_count = samples.color_count = 3;
}

/// Turn CMYK as Photoshop stores it, 0 for full ink, into ink.
void invertInk(Samples& samples)
{
    const size_t bytes = numberBytes(samples.number);
    for (size_t i = 0; i < samples.values.size(); ++i)
        if (i / bytes % samples.channel_count < samples.color_count)
            samples.values[i] = ~samples.values[i];
}

} // namespace

Result<Samples> readPsd(const Request& request, std::span<const std::byte> bytes)
{
    BigEndianReader reader(bytes);
    HEARTH_ASSIGN_OR_RETURN(const Psd psd, readSections(reader));
    HEARTH_TRY(checkHeader(request, psd));
    Samples samples;
    samples.width = psd.width;
    samples.height = psd.height;
    samples.number = psd.depth == 16 ? Number::unorm16 : psd.depth == 32 ? Number::float32 : Number::unorm8;
    samples.color_count = countColors(psd.mode);
    const bool has_more = psd.channel_count > samples.color_count;
    const bool has_alpha =
        has_more && psd.first_alpha_is_transparency && psd.depth != 1 && psd.mode != Mode::indexed;
    samples.alpha = has_alpha ? Alpha::on_white : Alpha::none;
    samples.alpha_channel = samples.color_count;
    samples.channel_count = samples.color_count + (has_alpha ? 1 : 0);
    if (psd.channel_count > samples.channel_count)
        samples.addNote(Issue::image_layers, "channels beside the image are not kept: " +
                                                 std::to_string(psd.channel_count - samples.channel_count));
    if (psd.depth == 32)
        samples.addNote(Issue::image_depth, "its channels have 32 bits, 16 are kept, as floats");
    HEARTH_TRY(readRows(psd, reader, samples));
    if (psd.mode == Mode::indexed)
        expandPalette(psd.palette, samples);
    if (psd.mode == Mode::cmyk)
        invertInk(samples);
    samples.profile.assign(psd.profile.begin(), psd.profile.end());
    return samples;
}

} // namespace hearth::images

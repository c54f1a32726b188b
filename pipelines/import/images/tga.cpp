// Decodes Truevision TGA: colour-mapped, true-colour and grey, run-length coded or not, with any of the four
// origins. Written from the TGA 2.0 specification, because common readers accept truncated files and mirror
// two of the origins.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/byte_reader.h"
#include "pipelines/import/images/codecs.h"

#include <array>
#include <cstring>

namespace hearth::import
{

namespace
{

using Texel = std::array<uint8_t, 4>;

enum TgaType : uint8_t
{
    kTgaMapped = 1,
    kTgaColor = 2,
    kTgaGrey = 3,
    kTgaRunLength = 8, ///< flag that is added to the other types
};

struct TgaHeader
{
    uint8_t id_length;
    uint8_t map_type;
    uint8_t type;
    uint8_t map_first[2];
    uint8_t map_length[2];
    uint8_t map_depth;
    uint8_t origin[4];
    uint8_t width[2];
    uint8_t height[2];
    uint8_t depth;
    uint8_t descriptor;
};
static_assert(sizeof(TgaHeader) == 18);

uint32_t number(const uint8_t (&bytes)[2])
{
    return bytes[0] | static_cast<uint32_t>(bytes[1]) << 8;
}

uint8_t from5Bits(uint32_t value)
{
    return static_cast<uint8_t>((value & 31u) << 3 | (value & 31u) >> 2);
}

/// Return a colour of 15, 16, 24 or 32 bits, blue first. Without alpha bits in the descriptor the fourth byte
/// is ignored.
Texel decodeColor(const uint8_t* bytes, uint32_t depth, bool has_alpha)
{
    if (depth <= 16)
    {
        const uint32_t bits = bytes[0] | static_cast<uint32_t>(bytes[1]) << 8;
        const uint8_t alpha = has_alpha && depth == 16 && (bits & 0x8000u) == 0 ? 0 : 255;
        return {from5Bits(bits >> 10), from5Bits(bits >> 5), from5Bits(bits), alpha};
    }
    return {bytes[2], bytes[1], bytes[0], has_alpha && depth == 32 ? bytes[3] : uint8_t{255}};
}

/// Turns stored values (map indices, grey or colours) into texels.
struct TexelReader
{
    TgaHeader header;
    bool has_alpha;
    std::vector<Texel> map;
    uint32_t map_first;

    uint32_t valueBytes() const { return (header.depth + 7u) / 8u; }

    std::optional<Texel> read(const uint8_t* bytes) const
    {
        switch (header.type & ~kTgaRunLength)
        {
        case kTgaMapped:
        {
            const uint32_t value =
                bytes[0] | (header.depth == 16 ? static_cast<uint32_t>(bytes[1]) << 8 : 0u);
            if (value < map_first || value - map_first >= map.size())
                return std::nullopt;
            return map[value - map_first];
        }
        case kTgaGrey:
            return Texel{bytes[0], bytes[0], bytes[0], header.depth == 16 ? bytes[1] : uint8_t{255}};
        default:
            return decodeColor(bytes, header.depth, has_alpha);
        }
    }
};

bool knownDepths(const TgaHeader& header)
{
    const uint32_t depth = header.depth;
    const uint32_t map_depth = header.map_depth;
    const auto is_color = [](uint32_t d) { return d == 15 || d == 16 || d == 24 || d == 32; };
    if (header.map_type > 1 || (header.map_type == 1 && !is_color(map_depth)))
        return false;
    switch (header.type & ~kTgaRunLength)
    {
    case kTgaMapped:
        return header.map_type == 1 && (depth == 8 || depth == 16);
    case kTgaGrey:
        return depth == 8 || depth == 16;
    case kTgaColor:
        return is_color(depth);
    default:
        return false;
    }
}

std::optional<std::vector<Texel>> readMap(ByteReader& reader, const TgaHeader& header, bool has_alpha)
{
    std::vector<Texel> map;
    if (header.map_type == 0)
        return map;
    const uint32_t entry_bytes = (header.map_depth + 7u) / 8u;
    const auto bytes = reader.readBytes(uint64_t{number(header.map_length)} * entry_bytes);
    if (!bytes)
        return std::nullopt;
    for (size_t at = 0; at < bytes->size(); at += entry_bytes)
        map.push_back(
            decodeColor(reinterpret_cast<const uint8_t*>(bytes->data()) + at, header.map_depth, has_alpha));
    return map;
}

/// Return the size of the texels of the shortest file: runs of 128 texels, or every texel.
uint64_t minTexelBytes(const TgaHeader& header)
{
    const uint64_t count = uint64_t{number(header.width)} * number(header.height);
    const uint64_t texel_bytes = (header.depth + 7u) / 8u;
    return (header.type & kTgaRunLength) != 0 ? (count + 127) / 128 * (1 + texel_bytes) : count * texel_bytes;
}

/// Call put(texel) for every texel in the order of the file. Return a description of the damage; empty on
/// success.
template <typename Put>
std::string_view readTexels(ByteReader& reader, const TexelReader& texels, uint64_t count, Put put)
{
    constexpr std::string_view kShort = "the file ends too early";
    constexpr std::string_view kMap = "an index lies outside the colour map";
    const uint32_t size = texels.valueBytes();
    const bool run_length = (texels.header.type & kTgaRunLength) != 0;
    for (uint64_t i = 0; i < count;)
    {
        uint64_t packet = count;
        bool repeated = false;
        if (run_length)
        {
            const auto head = reader.read<uint8_t>();
            if (!head)
                return kShort;
            packet = std::min<uint64_t>((*head & 0x7Fu) + 1u,
                                        count - i); // some writers let the last packet exceed the image
            repeated = (*head & 0x80u) != 0;
        }
        const auto bytes = reader.readBytes(repeated ? size : packet * size);
        if (!bytes)
            return kShort;
        const auto* value = reinterpret_cast<const uint8_t*>(bytes->data());
        for (uint64_t k = 0; k < packet; ++k, ++i, value += repeated ? 0 : size)
        {
            const auto texel = texels.read(value);
            if (!texel)
                return kMap;
            put(*texel);
        }
    }
    return {};
}

/// Return the attributes type of the extension area at the end of the file, which says what alpha means.
std::optional<uint8_t> readAttributesType(std::span<const std::byte> bytes)
{
    constexpr size_t kFooterBytes = 26;
    constexpr std::string_view kSignature("TRUEVISION-XFILE.\0", 18);
    constexpr size_t kAreaBytes = 495; // the attributes type is the last byte
    if (bytes.size() < kFooterBytes)
        return std::nullopt;
    const std::span<const std::byte> footer = bytes.last(kFooterBytes);
    const auto area_offset = ByteReader(footer).read<uint32_t>();
    if (std::memcmp(footer.data() + kFooterBytes - kSignature.size(), kSignature.data(), kSignature.size()) !=
            0 ||
        *area_offset == 0)
        return std::nullopt;
    const auto area = checkedPart(bytes, *area_offset, kAreaBytes);
    return area ? std::optional(static_cast<uint8_t>(area->back())) : std::nullopt;
}

/// Make texels opaque whose alpha is no opacity, as the extension area says: types 0 (no alpha), 1 and 2
/// (undefined data). Says so only if alpha would have been seen.
void dropUndefinedAlpha(std::span<const std::byte> bytes, DecodedImage& image)
{
    constexpr uint8_t kMaxUndefinedType = 2;
    const std::optional<uint8_t> type = readAttributesType(bytes);
    if (!type || *type > kMaxUndefinedType)
        return;
    bool was_seen = false;
    for (size_t at = 3; at < image.texels.size(); at += 4)
        if (image.texels[at] != std::byte{255})
        {
            image.texels[at] = std::byte{255};
            was_seen = true;
        }
    if (was_seen)
        image.notes.push_back({Issue::image_alpha, "alpha is not opacity, as attributes type " +
                                                       std::to_string(*type) +
                                                       " of the TGA's extension area says: it is not kept"});
}

} // namespace

Result<DecodedImage> decodeTga(const EncodedImage& source)
{
    ByteReader reader(source.bytes);
    const auto header = reader.read<TgaHeader>();
    if (!header || !knownDepths(*header))
        return source.malformed("TGA: the header is damaged");
    if ((header->descriptor & 0xC0u) != 0)
        return source.unsupported("interleaved TGA images are not read");
    const bool has_alpha = (header->descriptor & 15u) != 0;
    HEARTH_TRY(checkImageSize(source, number(header->width), number(header->height)));
    auto map = reader.skip(header->id_length) ? readMap(reader, *header, has_alpha) : std::nullopt;
    if (!map)
        return source.malformed("TGA: the file ends too early");

    HEARTH_TRY(checkFileSize(source, "TGA", reader.position() + minTexelBytes(*header)));
    HEARTH_ASSIGN_OR_RETURN(DecodedImage image, allocateImage(source, number(header->width),
                                                              number(header->height), ChannelType::unorm8));
    const TexelReader texels{*header, has_alpha, std::move(*map), number(header->map_first)};
    const bool from_right = (header->descriptor & 0x10u) != 0;
    const bool from_top = (header->descriptor & 0x20u) != 0;
    uint32_t x = 0;
    uint32_t y = 0;
    const auto put = [&](const Texel& texel)
    {
        const size_t column = from_right ? image.width - 1 - x : x;
        const size_t row = from_top ? y : image.height - 1 - y;
        std::copy(texel.begin(), texel.end(), imageBytes(image) + (row * image.width + column) * 4);
        if (++x == image.width)
        {
            x = 0;
            ++y;
        }
    };
    const std::string_view problem = readTexels(reader, texels, uint64_t{image.width} * image.height, put);
    if (!problem.empty())
        return source.malformed("TGA: " + std::string(problem));
    dropUndefinedAlpha(source.bytes, image);
    return image;
}

} // namespace hearth::import

// Decodes ETC1S: every 4 x 4 block has one entry of the endpoint codebook (a colour of 5 bits per channel and
// an intensity table) and one of the selector codebook (two bits per texel). BasisLZ codes the indices of
// both.
// Source: Khronos KTX File Format Specification 2.0, "BasisLZ Global Data" and "ETC1S"; Khronos Data Format
// Specification 1.3, "ETC1".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/images/basis_etc1s.h"

#include "formats/base/byte_reader.h"
#include "pipelines/import/images/basis_bits.h"

#include <algorithm>
#include <array>

namespace hearth::import
{

namespace
{

constexpr std::string_view kDamaged = "the data is damaged";

struct GlobalHeader
{
    uint16_t endpoint_count;
    uint16_t selector_count;
    uint32_t endpoints_size;
    uint32_t selectors_size;
    uint32_t tables_size;
    uint32_t extended_size;
};
static_assert(sizeof(GlobalHeader) == 20);

struct ImageDescription
{
    uint32_t flags;
    uint32_t color_offset;
    uint32_t color_size;
    uint32_t alpha_offset;
    uint32_t alpha_size;
};

constexpr uint32_t kFlagPredictedFrame = 2; ///< frame of a video that is predicted from the previous one

constexpr uint32_t kChannelRed = 3;
constexpr uint32_t kChannelGreen = 4;
constexpr uint32_t kChannelAlpha = 15;

struct Endpoint
{
    std::array<uint8_t, 3> color5;
    uint8_t intensity;
};

using Selector = std::array<uint8_t, 4>; ///< a byte per row, two bits per texel, the leftmost texel lowest

struct Codebooks
{
    std::vector<Endpoint> endpoints;
    std::vector<Selector> selectors;
    BasisPrefixCode endpoint_prediction;
    BasisPrefixCode endpoint_delta;
    BasisPrefixCode selector;
    BasisPrefixCode selector_run;
    uint32_t history_size = 0;
};

constexpr std::array<std::array<int, 4>, 8> kIntensities = {{{-8, -2, 2, 8},
                                                             {-17, -5, 5, 17},
                                                             {-29, -9, 9, 29},
                                                             {-42, -13, 13, 42},
                                                             {-60, -18, 18, 60},
                                                             {-80, -24, 24, 80},
                                                             {-106, -33, 33, 106},
                                                             {-183, -47, 47, 183}}};

/// Read endpoints: each is a difference to the previous one, in one of three codes chosen by the previous
/// value.
bool readEndpoints(std::span<const std::byte> bytes, std::vector<Endpoint>& endpoints)
{
    BasisBitReader reader(bytes);
    std::array<BasisPrefixCode, 3> color_codes;
    BasisPrefixCode intensity_code;
    for (BasisPrefixCode& code : color_codes)
        if (!code.read(reader))
            return false;
    if (!intensity_code.read(reader))
        return false;
    const bool grey = reader.bits(1) != 0;
    Endpoint previous{{16, 16, 16}, 0};
    for (Endpoint& endpoint : endpoints)
    {
        endpoint.intensity = static_cast<uint8_t>((previous.intensity + intensity_code.decode(reader)) & 7u);
        for (size_t c = 0; c < (grey ? 1u : 3u); ++c)
        {
            const uint32_t before = previous.color5[c];
            const size_t code = before <= 9 ? 0 : before <= 21 ? 1 : 2;
            endpoint.color5[c] = static_cast<uint8_t>((before + color_codes[code].decode(reader)) & 31u);
        }
        if (grey)
            endpoint.color5[1] = endpoint.color5[2] = endpoint.color5[0];
        previous = endpoint;
        if (reader.failed())
            return false;
    }
    return true;
}

bool readSelectors(std::span<const std::byte> bytes, std::vector<Selector>& selectors)
{
    BasisBitReader reader(bytes);
    const bool global_codebook = reader.bits(1) != 0;
    const bool hybrid_codebook = reader.bits(1) != 0;
    const bool raw = reader.bits(1) != 0;
    if (global_codebook || hybrid_codebook)
        return false; // not allowed in KTX2
    BasisPrefixCode delta_code;
    if (!raw && !delta_code.read(reader))
        return false;
    Selector previous{};
    for (size_t i = 0; i < selectors.size() && !reader.failed(); ++i)
    {
        for (size_t row = 0; row < 4; ++row)
        {
            const bool plain = raw || i == 0;
            const uint32_t bits = plain ? reader.bits(8) : delta_code.decode(reader) ^ previous[row];
            selectors[i][row] = static_cast<uint8_t>(bits);
        }
        previous = selectors[i];
    }
    return !reader.failed();
}

bool readTables(std::span<const std::byte> bytes, Codebooks& books)
{
    BasisBitReader reader(bytes);
    const bool read = books.endpoint_prediction.read(reader) && books.endpoint_delta.read(reader) &&
                      books.selector.read(reader) && books.selector_run.read(reader);
    books.history_size = reader.bits(13);
    return read && !reader.failed();
}

/// Recently used selectors. Using one swaps it with the selector at half its index.
class SelectorHistory
{
public:
    explicit SelectorHistory(uint32_t size) : values_(size), next_(size / 2) {}

    size_t size() const { return values_.size(); }

    void add(uint32_t value)
    {
        if (values_.empty())
            return;
        values_[next_++] = value;
        if (next_ == values_.size())
            next_ = values_.size() / 2;
    }

    uint32_t use(size_t index)
    {
        const uint32_t value = values_[index];
        std::swap(values_[index], values_[index / 2]);
        return value;
    }

private:
    std::vector<uint32_t> values_;
    size_t next_;
};

/// Decodes the endpoint indices of a slice in block order: predicted from the left, upper or upper left
/// block, or a difference to the previous block. One symbol holds the predictions of 2 x 2 blocks.
class EndpointIndices
{
public:
    EndpointIndices(const Codebooks& books, uint32_t columns)
        : books_(books), lower_predictions_((columns + 1) / 2), above_(columns), row_(columns)
    {
    }

    void startRow()
    {
        std::swap(above_, row_);
        ++rows_;
    }

    /// Return the next index; nullopt if the data is damaged.
    std::optional<uint32_t> next(BasisBitReader& reader, uint32_t x)
    {
        if (x % 2 == 0)
            predictions_ = (rows_ % 2 == 1) ? readPredictions(reader, x) : lower_predictions_[x / 2];
        const uint32_t prediction = predictions_ & 3u;
        predictions_ >>= 2;
        const bool has_left = x > 0;
        const bool has_above = rows_ > 1;
        uint32_t index = previous_;
        if (prediction == 0 && !has_left)
            return std::nullopt;
        if ((prediction == 1 && !has_above) || (prediction == 2 && (!has_above || !has_left)))
            return std::nullopt;
        if (prediction == 1)
            index = above_[x];
        if (prediction == 2)
            index = above_[x - 1];
        if (prediction == 3)
        {
            index += books_.endpoint_delta.decode(reader);
            index -= index >= books_.endpoints.size() ? static_cast<uint32_t>(books_.endpoints.size()) : 0u;
        }
        if (index >= books_.endpoints.size())
            return std::nullopt;
        row_[x] = previous_ = index;
        return index;
    }

private:
    uint32_t readPredictions(BasisBitReader& reader, uint32_t x)
    {
        constexpr uint32_t kRepeat = 256;
        if (repeats_ > 0)
            --repeats_;
        else
        {
            const uint32_t symbol = books_.endpoint_prediction.decode(reader);
            if (symbol == kRepeat)
                repeats_ = reader.readVariableLength(4) + 3 - 1;
            else
                last_symbol_ = symbol;
        }
        lower_predictions_[x / 2] = last_symbol_ >> 4;
        return last_symbol_;
    }

    const Codebooks& books_;
    std::vector<uint32_t> lower_predictions_; ///< of the odd row of each 2 x 2 blocks
    std::vector<uint32_t> above_;
    std::vector<uint32_t> row_;
    uint32_t rows_ = 0; ///< number of rows started so far
    uint32_t predictions_ = 0;
    uint32_t last_symbol_ = 0;
    uint32_t repeats_ = 0;
    uint32_t previous_ = 0;
};

/// Decodes the selector indices: new, from the history, or a run of the history's first entry.
class SelectorIndices
{
public:
    explicit SelectorIndices(const Codebooks& books) : books_(books), history_(books.history_size) {}

    std::optional<uint32_t> next(BasisBitReader& reader)
    {
        const auto count = static_cast<uint32_t>(books_.selectors.size());
        const uint32_t symbol = nextSymbol(reader, count);
        if (symbol < count)
        {
            history_.add(symbol);
            return symbol;
        }
        if (symbol - count >= history_.size())
            return std::nullopt;
        const uint32_t index = history_.use(symbol - count);
        return index < count ? std::optional(index) : std::nullopt;
    }

private:
    uint32_t nextSymbol(BasisBitReader& reader, uint32_t count)
    {
        constexpr uint32_t kLongRun = 63;
        constexpr uint32_t kShortestRun = 3;
        if (run_ > 0)
        {
            --run_;
            return count;
        }
        const uint32_t symbol = books_.selector.decode(reader);
        if (symbol != count + history_.size())
            return symbol;
        const uint32_t length = books_.selector_run.decode(reader);
        run_ = (length == kLongRun ? reader.readVariableLength(7) : length) + kShortestRun - 1;
        return count;
    }

    const Codebooks& books_;
    SelectorHistory history_;
    uint32_t run_ = 0;
};

enum class Target : uint8_t
{
    color,
    red,
    green,
    alpha,
};

void writeBlock(const Endpoint& endpoint, const Selector& selector, uint32_t block_x, uint32_t block_y,
                Target target, DecodedImage& image)
{
    std::array<std::array<uint8_t, 3>, 4> colors{};
    for (size_t s = 0; s < 4; ++s)
        for (size_t c = 0; c < 3; ++c)
        {
            const int base = endpoint.color5[c] << 3 | endpoint.color5[c] >> 2;
            colors[s][c] =
                static_cast<uint8_t>(std::clamp(base + kIntensities[endpoint.intensity][s], 0, 255));
        }
    for (uint32_t y = 0; y < std::min(4u, image.height - block_y * 4); ++y)
        for (uint32_t x = 0; x < std::min(4u, image.width - block_x * 4); ++x)
        {
            const auto& color = colors[(uint32_t{selector[y]} >> (2 * x)) & 3u];
            const size_t index = (size_t{block_y} * 4 + y) * image.width + size_t{block_x} * 4 + x;
            auto* texel = reinterpret_cast<uint8_t*>(image.texels.data()) + index * 4;
            if (target == Target::color)
                std::copy(color.begin(), color.end(), texel);
            else
                texel[target == Target::red ? 0 : target == Target::green ? 1 : 3] = color[1];
        }
}

bool decodeSlice(const Codebooks& books, std::span<const std::byte> slice, Target target, DecodedImage& image)
{
    const uint32_t columns = (image.width + 3) / 4;
    const uint32_t rows = (image.height + 3) / 4;
    BasisBitReader reader(slice);
    EndpointIndices endpoints(books, columns);
    SelectorIndices selectors(books);
    for (uint32_t y = 0; y < rows; ++y)
    {
        endpoints.startRow();
        for (uint32_t x = 0; x < columns; ++x)
        {
            const auto endpoint = endpoints.next(reader, x);
            const auto selector = endpoint ? selectors.next(reader) : std::nullopt;
            if (!selector || reader.failed())
                return false;
            writeBlock(books.endpoints[*endpoint], books.selectors[*selector], x, y, target, image);
        }
    }
    return true;
}

bool readCodebooks(ByteReader& reader, const GlobalHeader& header, Codebooks& books)
{
    const auto endpoints = reader.readBytes(header.endpoints_size);
    const auto selectors = endpoints ? reader.readBytes(header.selectors_size) : std::nullopt;
    const auto tables = selectors ? reader.readBytes(header.tables_size) : std::nullopt;
    if (!tables)
        return false;
    books.endpoints.resize(header.endpoint_count);
    books.selectors.resize(header.selector_count);
    return readEndpoints(*endpoints, books.endpoints) && readSelectors(*selectors, books.selectors) &&
           readTables(*tables, books);
}

} // namespace

std::string_view decodeBasisEtc1s(std::span<const std::byte> global_data, std::span<const std::byte> level,
                                  const BasisLayout& layout, DecodedImage& image)
{
    ByteReader reader(global_data);
    const auto header = reader.read<GlobalHeader>();
    const auto description = reader.read<ImageDescription>();
    if (!description || !reader.skip(uint64_t{layout.image_count - 1} * sizeof(ImageDescription)))
        return "the global data ends too early";
    if (header->extended_size != 0 || (description->flags & ~kFlagPredictedFrame) != 0)
        return kDamaged;
    if ((description->flags & kFlagPredictedFrame) != 0)
        return "the first image builds on one before it";

    const bool two_slices = layout.sample_channels.size() == 2;
    const auto first = checkedPart(level, description->color_offset, description->color_size);
    const auto second = checkedPart(level, description->alpha_offset, description->alpha_size);
    if (!first || !second || first->empty() || second->empty() == two_slices)
        return "a slice is missing or lies outside its level";

    Codebooks books;
    if (!readCodebooks(reader, *header, books))
        return "the codebooks are damaged";
    std::fill(image.texels.begin(), image.texels.end(), std::byte{0xFF});
    const bool red_green =
        two_slices && layout.sample_channels[0] == kChannelRed && layout.sample_channels[1] == kChannelGreen;
    if (two_slices && !red_green && layout.sample_channels[1] != kChannelAlpha)
        return "the channels of the two slices are not known";
    if (!decodeSlice(books, *first, red_green ? Target::red : Target::color, image))
        return kDamaged;
    if (two_slices && !decodeSlice(books, *second, red_green ? Target::green : Target::alpha, image))
        return kDamaged;
    return {};
}

} // namespace hearth::import

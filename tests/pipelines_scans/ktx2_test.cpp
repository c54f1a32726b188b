// KTX2 files made by hand, and ETC1S data by a small encoder.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/half.h"
#include "pipelines/import/readers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <functional>
#include <map>
#include <set>
#include <zstd.h>

namespace hearth::import
{

namespace
{

using Bytes = std::vector<uint8_t>;
using Rgba8 = std::array<uint8_t, 4>;

void append(Bytes& bytes, uint64_t value, size_t size)
{
    for (size_t i = 0; i < size; ++i)
        bytes.push_back(static_cast<uint8_t>(value >> (8 * i)));
}

struct Ktx2
{
    uint32_t vk_format = 37; // R8G8B8A8_UNORM
    uint32_t width = 2;
    uint32_t height = 2;
    uint32_t depth = 0;
    uint32_t layers = 0;
    uint32_t faces = 1;
    uint32_t level_count = 1;
    uint32_t scheme = 0;
    uint8_t model = 1; // RGBSDA
    std::vector<uint8_t> channels = {0, 1, 2, 15};
    Bytes key_values;
    Bytes global_data;
    std::vector<Bytes> levels = {Bytes(16)}; // finest first
    std::vector<uint64_t> uncompressed = {16};

    Bytes file() const
    {
        Bytes descriptor;
        const auto block = static_cast<uint32_t>(24 + 16 * channels.size());
        append(descriptor, 4 + block, 4);
        append(descriptor, 0, 4);
        append(descriptor, 2 | block << 16, 4);
        append(descriptor, model, 4);
        append(descriptor, 0, 12);
        for (const uint8_t channel : channels)
        {
            append(descriptor, uint32_t{channel} << 24, 4);
            append(descriptor, 0, 12);
        }
        const size_t descriptor_at = 80 + 24 * levels.size();
        const size_t key_values_at = descriptor_at + descriptor.size();
        const size_t global_at = (key_values_at + key_values.size() + 7) / 8 * 8;
        size_t end = global_at + global_data.size();

        std::vector<size_t> offsets(levels.size());
        for (size_t i = levels.size(); i-- > 0;)
        {
            offsets[i] = (end + 47) / 48 * 48; // suits texels of 3, 4 and 16 bytes
            end = offsets[i] + levels[i].size();
        }
        Bytes bytes = {0xAB, 'K', 'T', 'X', ' ', '2', '0', 0xBB, '\r', '\n', 0x1A, '\n'};
        for (const uint32_t value : {vk_format, 1u, width, height, depth, layers, faces, level_count, scheme})
            append(bytes, value, 4);
        append(bytes, descriptor_at, 4);
        append(bytes, descriptor.size(), 4);
        append(bytes, key_values.empty() ? 0 : key_values_at, 4);
        append(bytes, key_values.size(), 4);
        append(bytes, global_data.empty() ? 0 : global_at, 8);
        append(bytes, global_data.size(), 8);
        for (size_t i = 0; i < levels.size(); ++i)
        {
            append(bytes, offsets[i], 8);
            append(bytes, levels[i].size(), 8);
            append(bytes, uncompressed[i], 8);
        }
        bytes.insert(bytes.end(), descriptor.begin(), descriptor.end());
        bytes.insert(bytes.end(), key_values.begin(), key_values.end());
        bytes.resize(global_at);
        bytes.insert(bytes.end(), global_data.begin(), global_data.end());
        for (size_t i = levels.size(); i-- > 0;)
        {
            bytes.resize(offsets[i]);
            bytes.insert(bytes.end(), levels[i].begin(), levels[i].end());
        }
        return bytes;
    }
};

Result<DecodedImage> decode(const Bytes& bytes)
{
    return decodeImage(std::as_bytes(std::span(bytes)), "texture", {});
}

Rgba8 texelOf(const DecodedImage& image, size_t x, size_t y)
{
    Rgba8 texel{};
    std::memcpy(texel.data(), &image.texels.at((y * image.width + x) * 4), 4);
    return texel;
}

TEST(DecodeKtx2, readsUncompressedTexels)
{
    Ktx2 ktx;
    for (size_t i = 0; i < 16; ++i)
        ktx.levels[0][i] = static_cast<uint8_t>(i);
    const auto rgba = decode(ktx.file());
    ASSERT_TRUE(rgba.ok());
    EXPECT_EQ(texelOf(*rgba, 1, 1), (Rgba8{12, 13, 14, 15}));

    ktx.vk_format = 50; // B8G8R8A8_SRGB
    EXPECT_EQ(texelOf(*decode(ktx.file()), 0, 1), (Rgba8{10, 9, 8, 11}));
    ktx.vk_format = 23; // R8G8B8_UNORM
    ktx.levels[0].resize(12);
    ktx.uncompressed = {12};
    EXPECT_EQ(texelOf(*decode(ktx.file()), 0, 1), (Rgba8{6, 7, 8, 255}));
    ktx.vk_format = 9; // R8_UNORM
    ktx.levels[0].resize(4);
    ktx.uncompressed = {4};
    EXPECT_EQ(texelOf(*decode(ktx.file()), 1, 0), (Rgba8{1, 1, 1, 255}));
}

TEST(DecodeKtx2, readsFloatsAsHalves)
{
    Ktx2 ktx;
    ktx.vk_format = 109; // R32G32B32A32_SFLOAT
    ktx.width = ktx.height = 1;
    const std::array<float, 4> texel = {1.5f, -2, 1e9f, 0.25f};
    ktx.levels = {Bytes(16)};
    std::memcpy(ktx.levels[0].data(), texel.data(), 16);
    const auto image = decode(ktx.file());
    ASSERT_TRUE(image.ok());
    ASSERT_TRUE(image->is_float);
    std::array<uint16_t, 4> half{};
    std::memcpy(half.data(), image->texels.data(), 8);
    EXPECT_EQ(half, (std::array<uint16_t, 4>{finiteHalf(1.5f), finiteHalf(-2), 0x7BFF, finiteHalf(0.25f)}));
}

TEST(DecodeKtx2, unpacksZstandard)
{
    Ktx2 ktx;
    Bytes texels(16, 77);
    Bytes packed(ZSTD_compressBound(texels.size()));
    packed.resize(ZSTD_compress(packed.data(), packed.size(), texels.data(), texels.size(), 1));
    ktx.scheme = 2;
    ktx.levels = {packed};
    EXPECT_EQ(texelOf(*decode(ktx.file()), 1, 1), (Rgba8{77, 77, 77, 77}));
    ktx.levels[0].pop_back();
    EXPECT_EQ(decode(ktx.file()).error().issue, Issue::image_malformed);
}

TEST(DecodeKtx2, takesTheFinestOfSeveralLevels)
{
    Ktx2 ktx;
    ktx.level_count = 2;
    ktx.levels = {Bytes(16, 9), Bytes(4, 5)};
    ktx.uncompressed = {16, 4};
    EXPECT_EQ(texelOf(*decode(ktx.file()), 0, 0), (Rgba8{9, 9, 9, 9}));
}

TEST(DecodeKtx2, refusesWhatTheSpecificationForbids)
{
    struct Case
    {
        const char* name;
        std::function<void(Ktx2&)> change;
        Issue issue;
    };
    const Issue malformed = Issue::image_malformed;
    const Issue unsupported = Issue::image_unsupported;
    const Case cases[] = {
        {"no width", [](Ktx2& k) { k.width = 0; }, malformed},
        {"five faces", [](Ktx2& k) { k.faces = 5; }, malformed},
        {"no faces", [](Ktx2& k) { k.faces = 0; }, malformed},
        {"cube that is not square", [](Ktx2& k) { k.faces = 6, k.height = 4; }, malformed},
        {"cube with depth", [](Ktx2& k) { k.faces = 6, k.depth = 2; }, malformed},
        {"too many levels", [](Ktx2& k) { k.level_count = 3; }, malformed},
        {"BasisLZ with a format", [](Ktx2& k) { k.scheme = 1; }, malformed},
        {"global data without need", [](Ktx2& k) { k.global_data = Bytes(8); }, malformed},
        {"size of a level", [](Ktx2& k) { k.uncompressed = {20}; }, malformed},
        {"bytes of a level", [](Ktx2& k) { k.levels = {Bytes(20)}; }, malformed},
        {"key without its end", [](Ktx2& k) { k.key_values = {3, 0, 0, 0, 'a', 'b', 'c', 0}; }, malformed},
        {"key/value too long", [](Ktx2& k) { k.key_values = {99, 0, 0, 0, 'a', 0, 'c', 0}; }, malformed},
        {"no samples", [](Ktx2& k) { k.channels.clear(); }, malformed},
        {"too large", [](Ktx2& k) { k.width = 0xFFFFFFFF, k.height = 0xFFFFFFFF; }, Issue::input_too_large},
        {"cube", [](Ktx2& k) { k.faces = 6; }, unsupported},
        {"array", [](Ktx2& k) { k.layers = 2; }, unsupported},
        {"volume", [](Ktx2& k) { k.depth = 2; }, unsupported},
        {"line", [](Ktx2& k) { k.height = 0; }, unsupported},
        {"BC7", [](Ktx2& k) { k.vk_format = 145; }, unsupported},
        {"unknown format", [](Ktx2& k) { k.vk_format = 999999; }, unsupported},
        {"unknown scheme", [](Ktx2& k) { k.scheme = 9; }, unsupported},
        {"UASTC", [](Ktx2& k) { k.vk_format = 0, k.model = 166; }, unsupported},
    };
    ASSERT_TRUE(decode(Ktx2().file()).ok());
    for (const Case& c : cases)
    {
        Ktx2 ktx;
        c.change(ktx);
        const auto image = decode(ktx.file());
        ASSERT_FALSE(image.ok()) << c.name;
        EXPECT_EQ(image.error().issue, c.issue) << c.name;
    }
}

TEST(DecodeKtx2, refusesPartsOutsideTheFile)
{
    const Bytes good = Ktx2().file();
    for (const size_t field : {48u, 52u, 56u, 60u, 64u, 72u, 80u, 88u}) // offsets and sizes of the index
    {
        Bytes damaged = good;
        damaged[field + 3] = 0x7F;
        EXPECT_FALSE(decode(damaged).ok()) << field;
    }
    for (size_t size = 12; size < good.size(); ++size)
        EXPECT_FALSE(decode(Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size))).ok())
            << size;
}

/// Writes bits, the least significant first, and prefix codes with all used symbols of equal length.
class BitWriter
{
public:
    void bits(uint32_t value, uint32_t count)
    {
        for (uint32_t i = 0; i < count; ++i, ++used_)
        {
            if (used_ % 8 == 0)
                bytes_.push_back(0);
            bytes_.back() = static_cast<uint8_t>(bytes_.back() | ((value >> i) & 1u) << (used_ % 8));
        }
    }

    const Bytes& bytes() const { return bytes_; }

private:
    Bytes bytes_;
    size_t used_ = 0;
};

class UniformCode
{
public:
    /// `symbols` are padded to a power of two with the lowest others; a single symbol has a code of one bit.
    explicit UniformCode(std::set<uint32_t> symbols)
    {
        for (uint32_t filler = 0; symbols.size() > 1 && !std::has_single_bit(symbols.size()); ++filler)
            symbols.insert(filler);
        length_ = symbols.size() == 1 ? 1 : static_cast<uint32_t>(std::countr_zero(symbols.size()));
        for (const uint32_t symbol : symbols)
            code_of_symbol_.emplace(symbol, static_cast<uint32_t>(code_of_symbol_.size()));
    }

    /// The lengths of the code: a code of two symbols (0 and the length) codes them.
    void define(BitWriter& out) const
    {
        constexpr std::array<uint32_t, 21> kOrder = {17, 18, 19, 20, 0,  8, 7,  9, 6,  10, 5,
                                                     11, 4,  12, 3,  13, 2, 14, 1, 15, 16};
        const uint32_t count = code_of_symbol_.rbegin()->first + 1;
        out.bits(count, 14);
        out.bits(21, 5);
        for (const uint32_t symbol : kOrder)
            out.bits(symbol == 0 || symbol == length_ ? 1 : 0, 3);
        for (uint32_t symbol = 0; symbol < count; ++symbol)
            out.bits(code_of_symbol_.contains(symbol) ? 1 : 0, 1);
    }

    void write(BitWriter& out, uint32_t symbol) const
    {
        const uint32_t code = code_of_symbol_.at(symbol);
        for (uint32_t i = length_; i-- > 0;)
            out.bits(code >> i, 1);
    }

private:
    std::map<uint32_t, uint32_t> code_of_symbol_;
    uint32_t length_ = 0;
};

// Two endpoints and three selectors. Endpoint 0: (8, 16, 24) of 31 and intensity 2; endpoint 1: (31, 0, 16) and 0.
constexpr std::array<std::array<int, 3>, 2> kColors5 = {{{8, 16, 24}, {31, 0, 16}}};
constexpr std::array<std::array<int, 4>, 2> kIntensities = {{{-29, -9, 9, 29}, {-8, -2, 2, 8}}};
constexpr std::array<std::array<uint8_t, 4>, 3> kSelectors = {
    {{0x00, 0x55, 0xAA, 0xFF}, {0xE4, 0xE4, 0xE4, 0xE4}, {0x1B, 0x00, 0xFF, 0x1B}}};
constexpr uint32_t kHistory = 2;

Rgba8 expectedTexel(size_t endpoint, size_t selector, size_t x, size_t y)
{
    const auto value = static_cast<size_t>(kSelectors[selector][y] >> (2 * x) & 3);
    Rgba8 texel = {0, 0, 0, 255};
    for (size_t c = 0; c < 3; ++c)
    {
        const int base = kColors5[endpoint][c] * 8 + kColors5[endpoint][c] / 4;
        texel[c] = static_cast<uint8_t>(std::clamp(base + kIntensities[endpoint][value], 0, 255));
    }
    return texel;
}

/// The symbols that slices use; selector symbol 3 + i is the history's entry i, 5 a run.
struct EtcCodes
{
    UniformCode prediction{{0x93, 0xFF, 256}};
    UniformCode delta{{0, 1}};
    UniformCode selector{{0, 1, 2, 3, 4, 5}};
    UniformCode run{{0, 1, 63}};
};

/// One image of global data for slices of these sizes.
Bytes globalData(uint32_t color_size, uint32_t alpha_size)
{
    BitWriter endpoints;
    // differences modulo 32 from (16, 16, 16), then from endpoint 0; the code depends on the value before
    const UniformCode low({23, 24}); // before <= 9
    const UniformCode middle({0, 8, 16, 24, 31});
    const UniformCode high({0, 24}); // before >= 22
    const UniformCode intensity({2, 6});
    for (const UniformCode* code : {&low, &middle, &high, &intensity})
        code->define(endpoints);
    endpoints.bits(0, 1); // not grey
    intensity.write(endpoints, 2);
    middle.write(endpoints, 24);   // 16 -> 8
    middle.write(endpoints, 0);    // 16
    middle.write(endpoints, 8);    // 16 -> 24
    intensity.write(endpoints, 6); // 2 -> 0
    low.write(endpoints, 23);      // 8 -> 31
    middle.write(endpoints, 16);   // 16 -> 0
    high.write(endpoints, 24);     // 24 -> 16

    BitWriter selectors;
    std::set<uint32_t> deltas;
    for (size_t i = 1; i < 3; ++i)
        for (size_t row = 0; row < 4; ++row)
            deltas.insert(kSelectors[i][row] ^ kSelectors[i - 1][row]);
    const UniformCode delta(deltas);
    selectors.bits(0, 3); // no global codebook, no hybrid one, not raw
    delta.define(selectors);
    for (size_t i = 0; i < 3; ++i)
        for (size_t row = 0; row < 4; ++row)
            if (i == 0)
                selectors.bits(kSelectors[0][row], 8);
            else
                delta.write(selectors, kSelectors[i][row] ^ kSelectors[i - 1][row]);

    BitWriter tables;
    const EtcCodes codes;
    for (const UniformCode* code : {&codes.prediction, &codes.delta, &codes.selector, &codes.run})
        code->define(tables);
    tables.bits(kHistory, 13);

    Bytes global;
    append(global, 2, 2);
    append(global, 3, 2);
    append(global, endpoints.bytes().size(), 4);
    append(global, selectors.bytes().size(), 4);
    append(global, tables.bytes().size(), 4);
    append(global, 0, 4);
    append(global, 0, 4); // flags
    append(global, 0, 4);
    append(global, color_size, 4);
    append(global, alpha_size == 0 ? 0 : color_size, 4);
    append(global, alpha_size, 4);
    for (const BitWriter* part : {&endpoints, &selectors, &tables})
        global.insert(global.end(), part->bytes().begin(), part->bytes().end());
    return global;
}

Ktx2 etc1sFile(uint32_t width, uint32_t height, const Bytes& color, const Bytes& alpha = {})
{
    Ktx2 ktx;
    ktx.vk_format = 0;
    ktx.scheme = 1;
    ktx.model = 163;
    ktx.channels = alpha.empty() ? std::vector<uint8_t>{0} : std::vector<uint8_t>{0, 15};
    ktx.width = width;
    ktx.height = height;
    ktx.global_data = globalData(static_cast<uint32_t>(color.size()), static_cast<uint32_t>(alpha.size()));
    ktx.levels = {color};
    ktx.levels[0].insert(ktx.levels[0].end(), alpha.begin(), alpha.end());
    ktx.uncompressed = {0};
    return ktx;
}

/// 8 x 8 texels, all endpoints given by differences: 0 1 / 1 0, selectors 0 1 2 2.
Bytes plainSlice()
{
    const EtcCodes codes;
    BitWriter slice;
    codes.prediction.write(slice, 0xFF);
    constexpr std::array<std::array<uint32_t, 2>, 4> kBlocks = {
        {{0, 0}, {1, 1}, {0, 2}, {1, 2}}}; // delta, selector
    for (const auto& [delta, selector] : kBlocks)
    {
        codes.delta.write(slice, delta);
        codes.selector.write(slice, selector);
    }
    return slice.bytes();
}

void expectBlock(const DecodedImage& image, size_t block_x, size_t block_y, size_t endpoint, size_t selector)
{
    for (size_t y = 0; y < 4; ++y)
        for (size_t x = 0; x < 4; ++x)
            ASSERT_EQ(texelOf(image, block_x * 4 + x, block_y * 4 + y),
                      expectedTexel(endpoint, selector, x, y))
                << "block " << block_x << " " << block_y << " texel " << x << " " << y;
}

TEST(DecodeEtc1s, readsBlocksByDifferences)
{
    const auto image = decode(etc1sFile(8, 8, plainSlice()).file());
    ASSERT_TRUE(image.ok()) << image.error().detail;
    expectBlock(*image, 0, 0, 0, 0);
    expectBlock(*image, 1, 0, 1, 1);
    expectBlock(*image, 0, 1, 1, 2);
    expectBlock(*image, 1, 1, 0, 2);
}

TEST(DecodeEtc1s, predictsFromTheLeftAboveAndAboveLeft)
{
    // upper row: by difference, from the left; lower row: from above, from above left
    const EtcCodes codes;
    BitWriter slice;
    codes.prediction.write(slice, 0x93);
    codes.delta.write(slice, 1);
    for (int block = 0; block < 4; ++block)
        codes.selector.write(slice, 1);
    const auto image = decode(etc1sFile(8, 8, slice.bytes()).file());
    ASSERT_TRUE(image.ok()) << image.error().detail;
    for (const size_t x : {0u, 1u})
        for (const size_t y : {0u, 1u})
            expectBlock(*image, x, y, 1, 1);
}

TEST(DecodeEtc1s, repeatsPredictionsAndRunsThroughTheHistory)
{
    // 32 x 4 texels: four pairs of blocks. Predictions once and three times more; selector 2, the history's second
    // entry (2 again, which moves to the front), then a run of six of the first.
    const EtcCodes codes;
    BitWriter slice;
    codes.prediction.write(slice, 0xFF);
    codes.delta.write(slice, 0);
    codes.selector.write(slice, 2);
    codes.delta.write(slice, 1);
    codes.selector.write(slice, 4);
    codes.prediction.write(slice, 256);
    slice.bits(0, 5); // 3 + 0 times
    codes.delta.write(slice, 0);
    codes.selector.write(slice, 5);
    codes.run.write(slice, 63);
    slice.bits(3, 8); // 3 + 3 blocks
    for (int block = 3; block < 8; ++block)
        codes.delta.write(slice, 0);
    const auto image = decode(etc1sFile(32, 4, slice.bytes()).file());
    ASSERT_TRUE(image.ok()) << image.error().detail;
    expectBlock(*image, 0, 0, 0, 2);
    for (size_t block = 1; block < 8; ++block)
        expectBlock(*image, block, 0, 1, 2);
}

TEST(DecodeEtc1s, theSecondSliceIsAlpha)
{
    const auto image = decode(etc1sFile(8, 8, plainSlice(), plainSlice()).file());
    ASSERT_TRUE(image.ok()) << image.error().detail;
    for (size_t y = 0; y < 4; ++y)
        for (size_t x = 0; x < 4; ++x)
        {
            Rgba8 expected = expectedTexel(1, 1, x, y);
            expected[3] = expected[1];
            EXPECT_EQ(texelOf(*image, 4 + x, y), expected);
        }
}

TEST(DecodeEtc1s, refusesDamage)
{
    const auto refused = [](const Ktx2& ktx)
    {
        const auto image = decode(ktx.file());
        return !image.ok() && image.error().issue == Issue::image_malformed;
    };
    const Ktx2 good = etc1sFile(8, 8, plainSlice());
    Ktx2 ktx = good;
    ktx.levels[0].resize(1); // a slice that ends too early
    EXPECT_TRUE(refused(ktx));
    ktx = good;
    ktx.width = 6; // KHR_texture_basisu asks for multiples of 4
    EXPECT_TRUE(refused(ktx));
    ktx = good;
    ktx.uncompressed = {1};
    EXPECT_TRUE(refused(ktx));
    ktx = good;
    ktx.channels = {0, 15}; // no second slice
    EXPECT_TRUE(refused(ktx));
    ktx = good;
    ktx.global_data[16] = 1; // extended data
    EXPECT_TRUE(refused(ktx));
    ktx = good;
    ktx.global_data[20] = 2; // a frame of a video
    EXPECT_TRUE(refused(ktx));
    for (size_t size = 1; size < good.global_data.size(); ++size)
    {
        ktx = good;
        ktx.global_data.resize(size);
        EXPECT_TRUE(refused(ktx)) << size;
    }
}

TEST(DecodeEtc1s, noBitOfTheFileBringsItDown)
{
    const Bytes good = etc1sFile(8, 8, plainSlice(), plainSlice()).file();
    for (size_t bit = 0; bit < good.size() * 8; ++bit)
    {
        Bytes damaged = good;
        damaged[bit / 8] = static_cast<uint8_t>(damaged[bit / 8] ^ 1u << bit % 8);
        const auto image = decode(damaged);
        if (!image.ok())
            continue;
        EXPECT_EQ(image->texels.size(), size_t{image->width} * image->height * 4);
    }
}

} // namespace

} // namespace hearth::import

// Tests the ETC1S decoder with data from a small encoder.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/pipelines_scans/ktx2_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <map>
#include <set>

namespace hearth::import
{

namespace
{

using namespace test;

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
    /// Pad `symbols` to a power of two with the lowest other symbols; a single symbol has a code of one bit.
    explicit UniformCode(std::set<uint32_t> symbols)
    {
        for (uint32_t filler = 0; symbols.size() > 1 && !std::has_single_bit(symbols.size()); ++filler)
            symbols.insert(filler);
        length_ = symbols.size() == 1 ? 1 : static_cast<uint32_t>(std::countr_zero(symbols.size()));
        for (const uint32_t symbol : symbols)
            code_of_symbol_.emplace(symbol, static_cast<uint32_t>(code_of_symbol_.size()));
    }

    /// Write the lengths of the code with a code of two symbols (0 and the length).
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

// Two endpoints and three selectors. Endpoint 0: colour (8, 16, 24) of 31, intensity 2; endpoint 1: colour
// (31, 0, 16), intensity 0.
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

/// Codes of the symbols in slices; selector symbol 3 + i is entry i of the history, 5 a run.
struct EtcCodes
{
    UniformCode prediction{{0x93, 0xFF, 256}};
    UniformCode delta{{0, 1}};
    UniformCode selector{{0, 1, 2, 3, 4, 5}};
    UniformCode run{{0, 1, 63}};
};

/// Return global data for one image with slices of these sizes.
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
            ASSERT_EQ(getTexel(image, block_x * 4 + x, block_y * 4 + y),
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
    // 32 x 4 texels: four pairs of blocks. Predictions once and repeated three times; selector 2, the
    // history's second entry (2 again, which moves to the front), then a run of six of the first entry.
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
            EXPECT_EQ(getTexel(*image, 4 + x, y), expected);
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

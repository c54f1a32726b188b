// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/half.h"
#include "tests/pipelines_scans/ktx2_builder.h"

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <zstd.h>

namespace hearth::import
{

namespace
{

using namespace test;

TEST(DecodeKtx2, readsUncompressedTexels)
{
    Ktx2 ktx;
    for (size_t i = 0; i < 16; ++i)
        ktx.levels[0][i] = static_cast<uint8_t>(i);
    const auto rgba = decode(ktx.file());
    ASSERT_TRUE(rgba.ok());
    EXPECT_EQ(getTexel(*rgba, 1, 1), (Rgba8{12, 13, 14, 15}));

    ktx.vk_format = 50; // B8G8R8A8_SRGB
    EXPECT_EQ(getTexel(*decode(ktx.file()), 0, 1), (Rgba8{10, 9, 8, 11}));
    ktx.vk_format = 23; // R8G8B8_UNORM
    ktx.levels[0].resize(12);
    ktx.uncompressed = {12};
    EXPECT_EQ(getTexel(*decode(ktx.file()), 0, 1), (Rgba8{6, 7, 8, 255}));
    ktx.vk_format = 9; // R8_UNORM
    ktx.levels[0].resize(4);
    ktx.uncompressed = {4};
    EXPECT_EQ(getTexel(*decode(ktx.file()), 1, 0), (Rgba8{1, 1, 1, 255}));
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
    ASSERT_TRUE(image->isFloat());
    std::array<uint16_t, 4> half{};
    std::memcpy(half.data(), image->texels.data(), 8);
    EXPECT_EQ(half, (std::array<uint16_t, 4>{halfFromFloat(1.5f), halfFromFloat(-2), 0x7BFF,
                                             halfFromFloat(0.25f)}));
}

TEST(DecodeKtx2, saysThatFloatsBecomeHalves)
{
    Ktx2 ktx;
    ktx.vk_format = 100; // R32_SFLOAT
    ktx.width = ktx.height = 1;
    ktx.levels = {Bytes(4)};
    ktx.uncompressed = {4};
    const auto notes = [&](float value)
    {
        std::memcpy(ktx.levels[0].data(), &value, sizeof(value));
        return decode(ktx.file())->notes;
    };
    EXPECT_TRUE(notes(0.25f).empty()) << "a half is as good";
    ASSERT_EQ(notes(0.1f).size(), 1u);
    EXPECT_EQ(notes(0.1f)[0].issue, Issue::image_depth);
    EXPECT_EQ(notes(0.1f)[0].text, "its channels are floats of 32 bits, 16 are kept");
}

TEST(DecodeKtx2, keepsSixteenBits)
{
    const auto decodeWords = [](uint32_t vk_format, const std::vector<uint16_t>& words)
    {
        Ktx2 ktx;
        ktx.vk_format = vk_format;
        ktx.width = ktx.height = 1;
        ktx.levels = {Bytes(words.size() * 2)};
        ktx.uncompressed = {words.size() * 2};
        std::memcpy(ktx.levels[0].data(), words.data(), words.size() * 2);
        const auto image = decode(ktx.file());
        EXPECT_TRUE(image.ok()) << vk_format;
        std::vector<uint16_t> texel(image->texels.size() / 2);
        std::memcpy(texel.data(), image->texels.data(), image->texels.size());
        return texel;
    };
    using Words = std::vector<uint16_t>;
    EXPECT_EQ(decodeWords(91, {1, 20000, 30000, 40000}), (Words{1, 20000, 30000, 40000}));
    EXPECT_EQ(decodeWords(84, {1, 20000, 30000}), (Words{1, 20000, 30000, 65535}));
    EXPECT_EQ(decodeWords(77, {1, 20000}), (Words{1, 20000, 0, 65535}));
    EXPECT_EQ(decodeWords(70, {20000}), (Words{20000, 20000, 20000, 65535}));
    EXPECT_EQ(decodeWords(91, {257, 514, 0, 65535}).size(), 2u) << "8 bits say as much";
}

TEST(DecodeKtx2, unpacksZstandard)
{
    Ktx2 ktx;
    Bytes texels(16, 77);
    Bytes packed(ZSTD_compressBound(texels.size()));
    packed.resize(ZSTD_compress(packed.data(), packed.size(), texels.data(), texels.size(), 1));
    ktx.scheme = 2;
    ktx.levels = {packed};
    EXPECT_EQ(getTexel(*decode(ktx.file()), 1, 1), (Rgba8{77, 77, 77, 77}));
    ktx.levels[0].pop_back();
    EXPECT_EQ(decode(ktx.file()).error().issue, Issue::image_malformed);
}

TEST(DecodeKtx2, takesTheFinestOfSeveralLevels)
{
    Ktx2 ktx;
    ktx.level_count = 2;
    ktx.levels = {Bytes(16, 9), Bytes(4, 5)};
    ktx.uncompressed = {16, 4};
    EXPECT_EQ(getTexel(*decode(ktx.file()), 0, 0), (Rgba8{9, 9, 9, 9}));
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
        {"PVRTC", [](Ktx2& k) { k.vk_format = 1000054001; }, unsupported},
        {"BC7 of another size", [](Ktx2& k) { k.vk_format = 145, k.width = 5; }, malformed},
        {"unknown format", [](Ktx2& k) { k.vk_format = 999999; }, unsupported},
        {"unknown scheme", [](Ktx2& k) { k.scheme = 9; }, unsupported},
        {"a model without a format", [](Ktx2& k) { k.vk_format = 0; }, unsupported},
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

} // namespace

} // namespace hearth::import

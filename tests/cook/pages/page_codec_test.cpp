// Tests that pages decode bit for bit, and that the decoder rejects anything else without access outside of
// its buffers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/codecs/cluster_bounds.h"
#include "formats/codecs/page_codec.h"
#include "formats/codecs/page_decode.h"
#include "tests/cook/pages/random_pages.h"
#include "tests/support/sanitized.h"

#include <gtest/gtest.h>
#include <zstd.h>

#include <algorithm>
#include <cstring>
#include <set>

namespace hearth::test
{

using namespace formats;

namespace
{

std::vector<std::byte> encode(RandomPage& page)
{
    pages::PageEncoder encoder;
    return encoder.encode(page.records, page.layout, page.clusters);
}

/// Decode into memory of exactly the page's size, so that a sanitizer sees any access beside it.
bool decodes(std::span<const std::byte> stored, const RandomPage& page, std::vector<std::byte>& out)
{
    static PageDecoder decoder;
    // a copy, so that reads behind the stored bytes are seen too
    const std::vector<std::byte> bytes(stored.begin(), stored.end());
    return decoder.decode(bytes, page.records, page.layout, out);
}

/// Return a cluster's triangles; a corner is its vertex's words and morph deltas, and each triangle is
/// rotated to the least of its three orders.
std::multiset<std::vector<uint32_t>> getTriangles(const RandomPage& page, size_t cluster)
{
    const pages::CodedCluster& coded = page.clusters[cluster];
    const uint32_t layout = clusterVertexLayout(page.records[cluster], page.layout);
    const uint32_t words = vertexWords(layout);
    std::multiset<std::vector<uint32_t>> triangles;
    for (size_t t = 0; t < coded.indices.size(); t += 3)
    {
        std::array<std::vector<uint32_t>, 3> corners;
        for (size_t i = 0; i < 3; ++i)
        {
            const auto at = coded.words.begin() + static_cast<ptrdiff_t>(uvBaseWords(layout)) +
                            static_cast<ptrdiff_t>(coded.indices[t + i]) * static_cast<ptrdiff_t>(words);
            corners[i].assign(at, at + words);
            const size_t targets = coded.morphs.empty() ? 0 : coded.morphs[0];
            for (size_t target = 0; target < targets; ++target)
            {
                const auto deltas =
                    coded.morphs.begin() +
                    static_cast<ptrdiff_t>(
                        morphSectionWords(targets, 0) +
                        (target * page.records[cluster].vertex_count + coded.indices[t + i]) * 3);
                corners[i].insert(corners[i].end(), deltas, deltas + 3);
            }
        }
        std::array<std::vector<uint32_t>, 3> least = corners;
        for (int turn = 0; turn < 2; ++turn)
        {
            std::rotate(corners.begin(), corners.begin() + 1, corners.end());
            least = std::min(least, corners);
        }
        std::vector<uint32_t> all;
        for (const auto& corner : least)
            all.insert(all.end(), corner.begin(), corner.end());
        triangles.insert(all);
    }
    return triangles;
}

void expectRoundTrip(RandomPage page)
{
    const RandomPage original = page;
    const std::vector<std::byte> stored = encode(page);
    for (size_t c = 0; c < page.clusters.size(); ++c)
        ASSERT_TRUE(getTriangles(page, c) == getTriangles(original, c)) << "cluster " << c;
    const std::vector<std::byte> content = page.content();
    std::vector<std::byte> out(content.size(), std::byte{0xCD});
    ASSERT_TRUE(decodes(stored, page, out));
    ASSERT_TRUE(out == content);
}

std::vector<std::byte> packed(std::span<const std::byte> content)
{
    std::vector<std::byte> frame(ZSTD_compressBound(content.size()));
    frame.resize(ZSTD_compress(frame.data(), frame.size(), content.data(), content.size(), 1));
    return frame;
}

std::vector<std::byte> unpacked(std::span<const std::byte> stored)
{
    std::vector<std::byte> content(ZSTD_getFrameContentSize(stored.data(), stored.size()));
    const size_t frame = ZSTD_findFrameCompressedSize(stored.data(), stored.size());
    EXPECT_EQ(ZSTD_decompress(content.data(), content.size(), stored.data(), frame), content.size());
    content.insert(content.end(), stored.begin() + static_cast<ptrdiff_t>(frame), stored.end());
    return content;
}

class PageCodecOfLayout : public ::testing::TestWithParam<uint32_t>
{
};

INSTANTIATE_TEST_SUITE_P(Samples, PageCodecOfLayout, ::testing::ValuesIn(sampleLayouts()));

} // namespace

TEST_P(PageCodecOfLayout, isLegal)
{
    EXPECT_TRUE(isLegalLayout(GetParam()));
    EXPECT_EQ(vertexLanes(GetParam()).count, 2 * vertexWords(GetParam()));
}

TEST_P(PageCodecOfLayout, bringsRandomPagesBack)
{
    for (uint32_t seed = 0; seed < (test::kSanitized ? 3 : 20); ++seed)
    {
        SCOPED_TRACE(seed);
        expectRoundTrip(randomPage(GetParam(), seed));
    }
}

TEST_P(PageCodecOfLayout, encodesADecodedPageToTheSameBytes)
{
    for (uint32_t seed = 0; seed < (test::kSanitized ? 2 : 10); ++seed)
    {
        SCOPED_TRACE(seed);
        RandomPage page = randomPage(GetParam(), seed);
        const std::vector<std::byte> stored = encode(page);
        const RandomPage in_order = page;
        size_t code_bytes = 0;
        for (const ClusterRecord& record : page.records)
            code_bytes += codeBytes(record.triangle_count);
        const std::vector<std::byte> content = unpacked(stored);
        const std::span codes(reinterpret_cast<const uint8_t*>(content.data()) + sizeof(PageHeader),
                              code_bytes);
        pages::PageEncoder encoder;
        ASSERT_TRUE(encoder.encodeAgain(page.records, page.layout, page.clusters, codes) == stored);
        ASSERT_TRUE(page.content() == in_order.content());
        // other values in the last words of vertices leave triangles and vertices where they are
        const uint32_t words = vertexWords(page.layout);
        for (size_t c = 0; c < page.clusters.size() && words > 2; ++c)
            if (page.records[c].extent_shift == 0)
                for (size_t v = 0; v < page.records[c].vertex_count; ++v)
                    page.clusters[c].words[uvBaseWords(page.layout) + v * words + words - 1] ^=
                        static_cast<uint32_t>(v % 5) << 8;
        const std::vector<std::byte> expected = page.content();
        const auto edited = encoder.encodeAgain(page.records, page.layout, page.clusters, codes);
        std::vector<std::byte> out(expected.size());
        ASSERT_TRUE(decodes(edited, page, out));
        ASSERT_TRUE(out == expected);
    }
}

TEST_P(PageCodecOfLayout, bringsMorphTargetsBack)
{
    for (uint32_t seed = 0; seed < 5; ++seed)
    {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        RandomPage page;
        page.layout = GetParam();
        page.morph_targets = 4;
        addGridCluster(page, 5, false, random);
        addWildCluster(page, 50, 30, random);
        addGridCluster(page, 3, true, random);
        expectRoundTrip(page);
    }
}

TEST_P(PageCodecOfLayout, bringsTheSmallestAndLargestClustersBack)
{
    std::mt19937 random(1);
    for (const auto& [vertices, triangles] :
         {std::pair{1u, 1u}, std::pair{2u, 1u}, std::pair{3u, 1u}, std::pair{3u, 128u}, std::pair{128u, 128u},
          std::pair{256u, 128u}, std::pair{256u, 86u}})
    {
        RandomPage page;
        page.layout = GetParam();
        addWildCluster(page, vertices, triangles, random);
        expectRoundTrip(page);
    }
    for (const bool wide : {false, true})
        for (const uint32_t side : {1u, 8u})
        {
            RandomPage page;
            page.layout = GetParam();
            addGridCluster(page, side, wide, random);
            addGridCluster(page, side, false, random);
            expectRoundTrip(page);
        }
}

TEST_P(PageCodecOfLayout, refusesEveryTruncation)
{
    RandomPage page = randomPage(GetParam(), 3);
    const std::vector<std::byte> stored = encode(page);
    std::vector<std::byte> out(page.content().size());
    for (size_t size = 0; size < stored.size(); size += 1 + size / 64)
        ASSERT_FALSE(decodes(std::span(stored).first(size), page, out)) << size;
    // also changes inside the frame
    const std::vector<std::byte> content = unpacked(stored);
    for (size_t size = 0; size < content.size(); size += 1 + size / 64)
        ASSERT_FALSE(decodes(packed(std::span(content).first(size)), page, out)) << size;
}

TEST_P(PageCodecOfLayout, takesAFrameThatEndsAnywhere)
{
    RandomPage page = randomPage(GetParam(), 7);
    const std::vector<std::byte> content = unpacked(encode(page));
    std::vector<std::byte> out(page.content().size());
    for (const size_t coded : {content.size(), content.size() / 3, size_t{72}, size_t{1}, size_t{0}})
    {
        std::vector<std::byte> stored = packed(std::span(content).first(coded));
        stored.insert(stored.end(), content.begin() + static_cast<ptrdiff_t>(coded), content.end());
        std::fill(out.begin(), out.end(), std::byte{0xCD});
        ASSERT_TRUE(decodes(stored, page, out)) << coded;
        ASSERT_TRUE(out == page.content()) << coded;
    }
}

TEST_P(PageCodecOfLayout, refusesCodesThatDoNotExist)
{
    std::mt19937 random(8);
    RandomPage page;
    page.layout = GetParam();
    addGridCluster(page, 8, false, random);
    const std::vector<std::byte> content = unpacked(encode(page));
    std::vector<std::byte> out(page.content().size());
    // change a code with the edge on the left to the code above the last edge: the corner stays the same
    size_t found = 0;
    for (size_t i = 0; i < codeBytes(page.records[0].triangle_count); ++i)
        for (const uint32_t shift : {0u, 4u})
        {
            std::vector<std::byte> damaged = content;
            std::byte& codes = damaged[sizeof(PageHeader) + i];
            if ((std::to_integer<uint32_t>(codes) >> shift & 15u) / 3 != kEdgeLeft)
                continue;
            codes = std::byte(std::to_integer<uint32_t>(codes) + (6u << shift));
            EXPECT_FALSE(decodes(packed(damaged), page, out)) << i;
            ++found;
        }
    EXPECT_GT(found, 0u);
}

TEST_P(PageCodecOfLayout, survivesEveryFlippedByte)
{
    RandomPage page = randomPage(GetParam(), 4);
    const std::vector<std::byte> stored = encode(page);
    std::vector<std::byte> out(page.content().size());
    for (size_t i = 0; i < stored.size(); i += 1 + i / 256)
    {
        std::vector<std::byte> damaged = stored;
        damaged[i] ^= std::byte{0x41};
        static_cast<void>(decodes(damaged, page, out));
    }
    const std::vector<std::byte> content = unpacked(stored);
    std::mt19937 random(5);
    size_t accepted = 0;
    size_t refused = 0;
    for (size_t i = 0; i < content.size(); i += 1 + i / 128)
    {
        std::vector<std::byte> damaged = content;
        damaged[i] = static_cast<std::byte>(random());
        damaged[random() % damaged.size()] ^= std::byte{0x80};
        ++(decodes(packed(damaged), page, out) ? accepted : refused);
    }
    // differences may have any value, triangles and counts may not
    EXPECT_GT(accepted, 10u);
    EXPECT_GT(refused, 10u);
}

TEST_P(PageCodecOfLayout, refusesRecordsOfAnotherPage)
{
    RandomPage page = randomPage(GetParam(), 6);
    const std::vector<std::byte> stored = encode(page);
    const auto refuses = [&](auto change)
    {
        RandomPage changed = page;
        change(changed);
        std::vector<std::byte> out(page.content().size());
        return !decodes(stored, changed, out);
    };
    EXPECT_FALSE(refuses([](RandomPage&) {}));
    EXPECT_TRUE(refuses([](RandomPage& p) { p.records.pop_back(); }));
    EXPECT_TRUE(refuses([](RandomPage& p) { ++p.records[1].page_word; }));
    EXPECT_TRUE(
        refuses([](RandomPage& p) { std::swap(p.records[0].vertex_count, p.records[1].vertex_count); }));
    EXPECT_TRUE(refuses([](RandomPage& p) { p.records[0].vertex_count = 257; }));
    EXPECT_TRUE(refuses([](RandomPage& p) { p.records[0].triangle_count = 255; }));
    EXPECT_TRUE(refuses([](RandomPage& p) { p.records[0].extent_shift ^= 1; }));
}

TEST(PageCodec, isDeterministicWhateverWasEncodedBefore)
{
    const uint32_t layout = sampleLayouts()[2];
    pages::PageEncoder encoder;
    RandomPage first = randomPage(layout, 1);
    const auto once = encoder.encode(first.records, layout, first.clusters);
    for (const uint32_t seed : {2u, 3u})
    {
        RandomPage other = randomPage(sampleLayouts()[seed], seed);
        static_cast<void>(encoder.encode(other.records, other.layout, other.clusters));
    }
    RandomPage again = randomPage(layout, 1);
    EXPECT_EQ(encoder.encode(again.records, layout, again.clusters), once);
}

TEST(PageCodec, storesSharedVerticesOnce)
{
    const uint32_t layout = sampleLayouts()[2];
    std::mt19937 random(9);
    RandomPage page;
    page.layout = layout;
    addGridCluster(page, 8, false, random);
    const size_t one = encode(page).size();
    page.clusters.push_back(page.clusters[0]);
    page.records.push_back(page.records[0]);
    page.records[1].page_word = static_cast<uint16_t>(page.content().size() / 8);
    EXPECT_LT(encode(page).size(), one * 3 / 2);
}

TEST(PageCodec, storesInfluencesInFewBytes)
{
    // a bone and a half: all but the few vertices between two joints have a neighbour's joints and similar
    // weights
    const uint32_t layout = kVertexNormal | kVertexInfluences;
    std::mt19937 random(10);
    RandomPage plain, skinned;
    plain.layout = kVertexNormal;
    skinned.layout = layout;
    addGridCluster(plain, 8, false, random);
    addGridCluster(skinned, 8, false, random);
    const uint32_t words = vertexWords(layout);
    for (uint32_t v = 0; v < 81; ++v)
    {
        const uint32_t row = v / 9;
        const uint32_t second = row < 3 ? 0 : row < 6 ? 8000 * (row - 2) : 32767;
        uint32_t* const influences = &skinned.clusters[0].words[(v + 1) * words - 4];
        influences[0] = second > 0 ? 7u | 8u << 16 : 7u;
        influences[1] = influences[3] = 0;
        influences[2] = (65535 - second) | second << 16;
    }
    const size_t bytes = encode(skinned).size() - encode(plain).size();
    EXPECT_LT(bytes, 81u * 16 / 4) << "of the 16 bytes that a vertex has";
}

TEST(PageCodec, foldsSignsBothWays)
{
    for (uint32_t value = 0; value < 0x10000; ++value)
        ASSERT_EQ(unzigzag16(zigzag16(static_cast<uint16_t>(value))), value);
    EXPECT_EQ(zigzag16(0xFFFF), 1);
    EXPECT_EQ(zigzag16(1), 2);
}

} // namespace hearth::test

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/cook/pages/random_pages.h"

#include "formats/codecs/cluster_bounds.h"

#include <cstring>
#include <span>

namespace hearth::test
{

using namespace formats;

namespace
{

size_t countBytes(const pages::CodedCluster& cluster)
{
    return 4 * (cluster.words.size() + (cluster.indices.size() + 3) / 4 + cluster.morphs.size());
}

/// Return a record with its counts, and the words in front of the vertices.
ClusterRecord& beginCluster(RandomPage& page, bool wide, std::mt19937& random)
{
    size_t used = 0;
    for (const pages::CodedCluster& cluster : page.clusters)
        used += countBytes(cluster);
    ClusterRecord record{};
    for (int32_t& base : record.base)
        base = static_cast<int32_t>(random() % 100000) - 50000;
    record.extent_shift = wide ? 1 : 0;
    record.page_word = static_cast<uint16_t>(used / 4);
    page.records.push_back(record);
    page.clusters.emplace_back();
    for (uint32_t word = 0; word < uvBaseWords(page.layout); ++word)
        page.clusters.back().words.push_back(static_cast<uint32_t>(random()));
    return page.records.back();
}

void finishCluster(RandomPage& page, size_t vertex_count, std::mt19937& random)
{
    if (page.morph_targets > 0)
    {
        auto& morphs = page.clusters.back().morphs;
        morphs.resize(morphSectionWords(random() % (page.morph_targets + 1), vertex_count));
        for (uint32_t& word : morphs)
            word = static_cast<uint32_t>(random());
        morphs[0] = static_cast<uint32_t>((morphs.size() - 1) / (2 + 3 * vertex_count));
    }
    page.records.back().vertex_count = static_cast<uint16_t>(vertex_count);
    page.records.back().triangle_count = static_cast<uint8_t>(page.clusters.back().indices.size() / 3);
}

/// Return words of a vertex near a position. Components that a page never uses are 0, as the codec may
/// assume.
void addVertex(RandomPage& page, uint32_t layout, uint32_t x, uint32_t y, uint32_t noise,
               std::mt19937& random)
{
    auto& words = page.clusters.back().words;
    const auto jitter = [&] { return static_cast<uint32_t>(random() % noise); };
    const size_t first = words.size();
    if (layout & kVertexWideOffsets)
        words.insert(words.end(), {x * 1000 + jitter(), y * 1000 + jitter(), jitter()});
    else
        words.insert(words.end(), {((x * 100 + jitter()) & 0xFFFFu) | (y * 100 + jitter()) << 16,
                                   (jitter() & 0xFFFFu) | jitter() << 16});
    while (words.size() - first < vertexWords(layout))
        words.push_back(jitter() * 0x01010101u);
}

} // namespace

std::vector<std::byte> RandomPage::content() const
{
    std::vector<std::byte> bytes;
    for (const pages::CodedCluster& cluster : clusters)
    {
        const auto append = [&](const auto& values)
        {
            const auto part = std::as_bytes(std::span(values));
            bytes.insert(bytes.end(), part.begin(), part.end());
        };
        const size_t end = bytes.size() + countBytes(cluster);
        append(cluster.words);
        append(cluster.indices);
        bytes.resize(end - cluster.morphs.size() * 4); // the padding of the indices
        append(cluster.morphs);
    }
    return bytes;
}

std::vector<uint32_t> sampleLayouts()
{
    const uint32_t grids = 14u << kVertexUvStepShift;
    const uint32_t widest = kVertexAttributesAll | kVertexNormal16 | kVertexColor16; // UVs are floats
    return {0,
            kVertexNormal,
            kVertexNormal | kVertexUv0 | grids,
            kVertexNormal | kVertexVisibility,
            kVertexNormal | kVertexUv0 | kVertexVisibility | grids,
            kVertexNormal | kVertexNormal16 | kVertexTangent | kVertexUv0,
            kVertexNormal | kVertexTangent | kVertexUv0 | kVertexUv2 | kVertexColor | grids,
            worstCaseLayout(kVertexAttributesAll & ~kVertexUvs) & ~kVertexWideOffsets,
            widest,
            widest & ~kVertexVisibility,
            kVertexNormal | kVertexUv0 | kVertexInfluences | grids,
            kVertexNormal | kVertexUv0 | kVertexVisibility | kVertexInfluences | grids,
            widest | kVertexInfluenceBits};
}

void addGridCluster(RandomPage& page, uint32_t side, bool wide, std::mt19937& random)
{
    const uint32_t layout = clusterVertexLayout(beginCluster(page, wide, random), page.layout);
    for (uint32_t y = 0; y <= side; ++y)
        for (uint32_t x = 0; x <= side; ++x)
            addVertex(page, layout, x, y, 40, random);
    auto& indices = page.clusters.back().indices;
    for (uint32_t y = 0; y < side; ++y)
        for (uint32_t x = 0; x < side; ++x)
        {
            const uint32_t at = y * (side + 1) + x;
            for (const uint32_t corner : {at, at + 1, at + side + 1, at + 1, at + side + 2, at + side + 1})
                indices.push_back(static_cast<uint8_t>(corner));
        }
    finishCluster(page, size_t{side + 1} * (side + 1), random);
}

void addWildCluster(RandomPage& page, uint32_t vertex_count, uint32_t triangle_count, std::mt19937& random)
{
    const uint32_t layout = clusterVertexLayout(beginCluster(page, random() % 4 == 0, random), page.layout);
    for (uint32_t v = 0; v < vertex_count; ++v)
        addVertex(page, layout, v, v, 0x10000, random);
    auto& indices = page.clusters.back().indices;
    // use all vertices, as far as there are corners
    for (uint32_t corner = 0; corner < triangle_count * 3; ++corner)
        indices.push_back(static_cast<uint8_t>(corner < vertex_count ? corner : random() % vertex_count));
    finishCluster(page, vertex_count, random);
}

RandomPage randomPage(uint32_t layout, uint32_t seed)
{
    std::mt19937 random(seed);
    RandomPage page;
    page.layout = layout;
    addWildCluster(page, 3, 1, random);
    while (page.content().size() < kMaxPageBytes / 2)
    {
        if (random() % 3 != 0)
            addGridCluster(page, 1 + static_cast<uint32_t>(random() % 8), random() % 16 == 0, random);
        else
        {
            const auto triangles = 1 + static_cast<uint32_t>(random() % 128);
            addWildCluster(page,
                           std::min<uint32_t>(256, 1 + static_cast<uint32_t>(random()) % (3 * triangles)),
                           triangles, random);
        }
        // every second cluster shares vertices with the one before
        if (page.clusters.size() % 2 == 0 && page.records.back().extent_shift == 0 &&
            page.records[page.records.size() - 2].extent_shift == 0)
        {
            auto& own = page.clusters.back().words;
            const auto& before = page.clusters[page.clusters.size() - 2].words;
            const size_t count = std::min(own.size(), before.size()) / 2;
            std::memcpy(own.data(), before.data(), count * 4);
            std::memcpy(page.records.back().base, page.records[page.records.size() - 2].base, 12);
        }
    }
    return page;
}

} // namespace hearth::test

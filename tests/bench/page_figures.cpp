// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/bench/page_figures.h"

#include "formats/base/assert.h"
#include "formats/codecs/cluster_bounds.h"
#include "formats/codecs/page_codec.h"
#include "formats/codecs/page_decode.h"

#include <zstd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ctime>
#include <functional>
#include <map>

namespace hearth::bench
{

namespace
{

using namespace formats;

constexpr int kRounds = 7;

double threadSeconds()
{
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

double leastSeconds(const std::function<void()>& work)
{
    double least = 1e9;
    for (int round = 0; round < kRounds; ++round)
    {
        const double begin = threadSeconds();
        work();
        least = std::min(least, threadSeconds() - begin);
    }
    return least;
}

double entropyBytes(std::span<const std::byte> stream)
{
    std::array<uint32_t, 256> histogram{};
    for (const std::byte byte : stream)
        ++histogram[std::to_integer<size_t>(byte)];
    double bits = 0;
    for (const uint32_t count : histogram)
        if (count > 0)
            bits += count * std::log2(static_cast<double>(stream.size()) / count);
    return bits / 8;
}

const char* kindOfLane(size_t lane, const VertexLanes& lanes, uint32_t layout)
{
    if (lane < 3)
        return "positions";
    if (lane == 3 || (lane < 6 && (layout & kVertexNormal16)))
        return "normals";
    if (lanes.kinds[lane] == LaneKind::grid)
        return "UVs";
    return "other attributes";
}

/// Bytes of the morph data behind the triangles of the page's clusters.
size_t morphBytes(const PageRecord& page, std::span<const ClusterRecord> clusters, uint32_t mesh_layout)
{
    size_t bytes = page.size;
    for (const ClusterRecord& cluster : clusters)
        bytes -= clusterBytes(clusterVertexLayout(cluster, mesh_layout), cluster.vertex_count,
                              cluster.triangle_count);
    return bytes;
}

/// Add the entropies of a page's streams, scaled to the stored size of the page.
void addKinds(const PageRecord& page, std::span<const ClusterRecord> clusters, uint32_t mesh_layout,
              std::span<const std::byte> content, std::map<std::string, double>& bytes_of_kind)
{
    size_t codes = 0, uv_bases = 0, wide = 0;
    for (const ClusterRecord& cluster : clusters)
    {
        const uint32_t layout = clusterVertexLayout(cluster, mesh_layout);
        codes += codeBytes(cluster.triangle_count);
        uv_bases += uvBaseWords(layout) * 4;
        wide += (layout & kVertexWideOffsets) ? cluster.vertex_count * vertexWords(layout) * 4 : 0;
    }
    PageHeader header;
    std::memcpy(&header, content.data(), sizeof(header));
    size_t at = 0;
    std::map<std::string, double> kinds;
    const auto take = [&](const char* kind, size_t size)
    {
        kinds[kind] += entropyBytes(content.subspan(at, size));
        at += size;
    };
    take("headers", sizeof(header));
    take("triangles", codes);
    for (const uint16_t restarts : header.restarts)
        take("triangles", restarts);
    for (const uint16_t reuses : header.reuses)
        take("reuses", reuses);
    take("references", header.references);
    take("references", header.references);
    take("UV bases", uv_bases);
    take("wide", wide);
    const VertexLanes lanes = vertexLanes(mesh_layout);
    const LaneForms forms = readLaneForms(header, content.subspan(at, moreLaneBytes(lanes)));
    take("headers", moreLaneBytes(lanes));
    take("morph targets", morphBytes(page, clusters, mesh_layout));
    take("escapes", header.escapes * 2);
    const auto takePlanes = [&](bool of_bytes, uint32_t part)
    {
        for (size_t lane = 0; lane < lanes.count; ++lane)
            if ((lanes.kinds[lane] == LaneKind::bytes) == of_bytes && (forms.planes[lane] & part) != 0)
                take(kindOfLane(lane, lanes, mesh_layout), header.new_vertices);
    };
    takePlanes(false, kPlaneMain);
    takePlanes(true, kPlaneMain);
    takePlanes(true, kPlaneSecond);
    for (size_t block = 0; block * kLanesPerBlock < lanes.count; ++block)
        for (uint32_t plane = 0; plane < lowBitFields(forms, block).planes(); ++plane)
            take("low bits", header.new_vertices);
    double sum = 0;
    for (const auto& [kind, bytes] : kinds)
        sum += bytes;
    for (const auto& [kind, bytes] : kinds)
        bytes_of_kind[kind] += bytes;
    bytes_of_kind["coding loss"] += page.stored_size - sum;
}

/// Decompress the zstd frame of a page. Returns its decompressed bytes.
size_t decompressFrame(ZSTD_DCtx* context, std::span<const std::byte> stored, std::span<std::byte> out)
{
    const size_t frame = ZSTD_findFrameCompressedSize(stored.data(), stored.size());
    HEARTH_ASSERT(!ZSTD_isError(frame));
    const size_t size = ZSTD_decompressDCtx(context, out.data(), out.size(), stored.data(), frame);
    HEARTH_ASSERT(!ZSTD_isError(size));
    return size;
}

} // namespace

PageFigures measurePages(const clusters::Hierarchy& hierarchy)
{
    PageFigures figures;
    std::map<std::string, double> bytes_of_kind;
    const auto stored = [&](const PageRecord& page)
    { return std::span(hierarchy.page_bytes).subspan(page.offset, page.stored_size); };
    const auto clusters = [&](const PageRecord& page)
    { return std::span(hierarchy.clusters).subspan(page.clusters.first, page.clusters.count); };
    std::vector<std::byte> content(size_t{1} << 20);
    ZSTD_DCtx* const context = ZSTD_createDCtx();
    for (const PageRecord& page : hierarchy.pages)
    {
        const size_t size = decompressFrame(context, stored(page), content);
        const auto rest =
            stored(page).subspan(ZSTD_findFrameCompressedSize(stored(page).data(), page.stored_size));
        std::copy(rest.begin(), rest.end(), content.begin() + static_cast<ptrdiff_t>(size));
        addKinds(page, clusters(page), hierarchy.mesh.attributes,
                 std::span(content).first(size + rest.size()), bytes_of_kind);
        figures.decoded_bytes += page.size;
    }
    bytes_of_kind["padding"] = static_cast<double>(hierarchy.page_bytes.size());
    for (const PageRecord& page : hierarchy.pages)
        bytes_of_kind["padding"] -= page.stored_size;
    for (const auto& [kind, bytes] : bytes_of_kind)
        figures.kinds.push_back({kind, bytes});

    PageDecoder decoder;
    std::vector<std::byte> out(kMaxPageBytes);
    figures.seconds = leastSeconds(
        [&]
        {
            for (const PageRecord& page : hierarchy.pages)
                HEARTH_ASSERT(decoder.decode(stored(page), clusters(page), hierarchy.mesh.attributes,
                                             std::span(out).first(page.size)));
        });
    figures.zstd_seconds = leastSeconds(
        [&]
        {
            for (const PageRecord& page : hierarchy.pages)
                decompressFrame(context, stored(page), content);
        });
    ZSTD_freeDCtx(context);
    return figures;
}

} // namespace hearth::bench

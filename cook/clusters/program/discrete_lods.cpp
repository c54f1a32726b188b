// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/program/discrete_lods.h"

#include "formats/base/assert.h"
#include "formats/codecs/page_decode.h"
#include "formats/pack/pack_view.h"

#include <zstd.h>

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <unordered_map>

namespace hearth::clusters
{

using namespace formats;

namespace
{

// Level 19 takes 16 % less on the rock of the benchmarks and 25 % less on the terrain, at five times the
// time: more than building their hierarchies.
constexpr int kChainZstdLevel = 9;

// Level of ContainerWriter for tables.
constexpr int kTableZstdLevel = ZSTD_CLEVEL_DEFAULT;

constexpr uint64_t kMaxVerticesOf16Bits = 65536;

uint64_t zstdSize(std::span<const std::byte> bytes, int level)
{
    std::vector<std::byte> packed(ZSTD_compressBound(bytes.size()));
    const size_t size = ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), level);
    HEARTH_ASSERT(ZSTD_isError(size) == 0);
    return size;
}

/// Errors at which cuts change, ascending, and the triangles that are drawn from each on.
class CutSizes
{
public:
    explicit CutSizes(const Hierarchy& hierarchy)
    {
        std::vector<std::pair<float, int64_t>> steps;
        for (const ClusterRecord& cluster : hierarchy.clusters)
        {
            const int64_t triangles = cluster.triangle_count;
            steps.push_back({clusterError(cluster, hierarchy.groups), triangles});
            steps.push_back({hierarchy.groups[cluster.group].error, -triangles});
        }
        std::sort(steps.begin(), steps.end());
        int64_t drawn = 0;
        for (const auto& [error, triangles] : steps)
        {
            drawn += triangles;
            if (errors_.empty() || errors_.back() != error)
            {
                errors_.push_back(error);
                sizes_.push_back(0);
            }
            sizes_.back() = static_cast<uint64_t>(drawn);
        }
    }

    /// Return the smallest error whose cut has at most this many triangles; infinity if there is none.
    float errorFor(uint64_t triangles) const
    {
        const auto found =
            std::find_if(sizes_.begin(), sizes_.end(), [&](uint64_t size) { return size <= triangles; });
        return errors_[static_cast<size_t>(found - sizes_.begin())];
    }

private:
    std::vector<float> errors_; ///< the last is infinity: nothing is drawn there
    std::vector<uint64_t> sizes_;
};

/// Word offsets of a vertex with full-width grid coordinates: 3 of the position, then the normal's code, the
/// tangent, two of each UV set, two of the colour, the visibility, eight of the influences. Missing
/// attributes are 0.
constexpr size_t kPositionWord = 0, kNormalWord = 3, kTangentWord = 4, kUvWord = 5, kColorWord = 13,
                 kVisibilityWord = 15, kInfluenceWord = 16;
using FullVertex = std::array<uint32_t, 24>;

struct VertexHash
{
    size_t operator()(const FullVertex& vertex) const
    {
        uint64_t hash = 0;
        for (const uint32_t word : vertex)
            hash = (hash ^ word) * 0x9E3779B97F4A7C15u; // 2^64 / golden ratio: spreads neighbours
        return static_cast<size_t>(hash ^ hash >> 32);
    }
};

FullVertex fullVertex(const ClusterRecord& cluster, const ClusterGeometry& geometry, uint32_t v)
{
    FullVertex full{};
    const std::array<uint32_t, 3> offset = geometry.gridOffset(v);
    for (size_t axis = 0; axis < 3; ++axis)
        full[kPositionWord + axis] = static_cast<uint32_t>(cluster.base[axis]) + offset[axis];
    const uint32_t layout = geometry.layout();
    if (geometry.has(kVertexNormal))
        full[kNormalWord] = geometry.normalCode(v);
    if (geometry.has(kVertexTangent))
        full[kTangentWord] = geometry.word(v, attributeWord(layout, kVertexTangent));
    for (uint32_t set = 0; set < 4; ++set)
        if (geometry.has(kVertexUv0 << set))
            for (uint32_t k = 0; k < 2; ++k)
                full[kUvWord + 2 * set + k] =
                    uvFractionBits(layout, set) == 0
                        ? geometry.word(v, attributeWord(layout, kVertexUv0 << set) + k)
                        : static_cast<uint32_t>(geometry.uvPoint(v, set)[k]);
    if (geometry.has(kVertexColor))
        for (uint32_t k = 0; k < (geometry.has(kVertexColor16) ? 2u : 1u); ++k)
            full[kColorWord + k] = geometry.word(v, attributeWord(layout, kVertexColor) + k);
    if (geometry.has(kVertexVisibility))
        full[kVisibilityWord] = geometry.visibilityCode(v);
    for (uint32_t i = 0; i < influencesPerVertex(layout); ++i)
        full[kInfluenceWord + i] = geometry.word(v, attributeWord(layout, kVertexInfluences) + i);
    return full;
}

/// Mesh of the chain: vertices in the order of their first use.
class WholeMesh
{
public:
    void add(const ClusterRecord& cluster, const ClusterGeometry& geometry)
    {
        std::array<uint32_t, kMaxClusterVertices> number_of{};
        for (uint32_t v = 0; v < geometry.vertexCount(); ++v)
        {
            const FullVertex vertex = fullVertex(cluster, geometry, v);
            const auto next = static_cast<uint32_t>(vertices_.size());
            const auto [found, is_new] = numbers_.emplace(vertex, next);
            number_of[v] = found->second;
            if (is_new)
                vertices_.push_back(vertex);
        }
        for (uint32_t t = 0; t < geometry.triangleCount(); ++t)
            for (const uint32_t corner : geometry.triangle(t))
                indices_.push_back(number_of[corner]);
    }

    DiscreteLod counts() const { return {indices_.size() / 3, vertices_.size()}; }

    /// Return the vertices as a game stores them: grid coordinates as 16 bits, in steps that fit the mesh.
    std::vector<std::byte> vertexBytes(uint32_t layout) const
    {
        std::vector<std::byte> bytes;
        const auto put = [&](uint32_t value, size_t size)
        {
            for (size_t i = 0; i < size; ++i)
                bytes.push_back(static_cast<std::byte>(value >> (8 * i)));
        };
        const GridRanges ranges = gridRanges(layout);
        const bool fine = (layout & kVertexNormal16) != 0;
        for (const FullVertex& vertex : vertices_)
        {
            for (size_t axis = 0; axis < 3; ++axis)
                put(ranges[kPositionWord + axis].narrow(vertex[kPositionWord + axis]), 2);
            put(fine ? 0 : vertex[kNormalWord], 2);
            if (fine)
                put(vertex[kNormalWord], 4);
            if (layout & kVertexTangent)
                put(vertex[kTangentWord], 4);
            for (uint32_t set = 0; set < 4; ++set)
                for (size_t word = kUvWord + 2 * set; word < kUvWord + 2 * set + 2; ++word)
                    if ((layout & kVertexUv0 << set) && uvFractionBits(layout, set) == 0)
                        put(vertex[word], 4);
                    else if (layout & kVertexUv0 << set)
                        put(ranges[word].narrow(vertex[word]), 2);
            if (layout & kVertexColor)
                put(vertex[kColorWord], 4);
            if (layout & kVertexColor16)
                put(vertex[kColorWord + 1], 4);
            if (layout & kVertexVisibility)
                put(vertex[kVisibilityWord], 4);
            for (uint32_t i = 0; i < influencesPerVertex(layout); ++i)
                put(vertex[kInfluenceWord + i], 4);
        }
        HEARTH_ASSERT(bytes.size() == vertices_.size() * vertexWords(layout) * 4);
        return bytes;
    }

    std::vector<std::byte> indexBytes() const
    {
        const size_t size = vertices_.size() <= kMaxVerticesOf16Bits ? 2 : 4;
        std::vector<std::byte> bytes;
        bytes.reserve(indices_.size() * size);
        for (const uint32_t index : indices_)
            for (size_t i = 0; i < size; ++i)
                bytes.push_back(static_cast<std::byte>(index >> (8 * i)));
        return bytes;
    }

private:
    /// Range of the values of one coordinate over the mesh.
    struct GridRange
    {
        int64_t min_value = std::numeric_limits<int64_t>::max();
        int64_t max_value = std::numeric_limits<int64_t>::min();
        uint32_t shift = 0;

        uint32_t narrow(uint32_t word) const
        {
            return static_cast<uint32_t>((int64_t{static_cast<int32_t>(word)} - min_value) >> shift);
        }
    };

    using GridRanges = std::array<GridRange, std::tuple_size_v<FullVertex>>;

    GridRanges gridRanges(uint32_t layout) const
    {
        GridRanges ranges;
        for (size_t word = 0; word < ranges.size(); ++word)
        {
            GridRange& range = ranges[word];
            for (const FullVertex& vertex : vertices_)
            {
                range.min_value = std::min(range.min_value, int64_t{static_cast<int32_t>(vertex[word])});
                range.max_value = std::max(range.max_value, int64_t{static_cast<int32_t>(vertex[word])});
            }
        }
        // all axes of a position, and u and v of a set, share a step
        const auto share = [&](size_t first, size_t count)
        {
            uint32_t shift = 0;
            for (size_t word = first; word < first + count; ++word)
                while ((ranges[word].max_value - ranges[word].min_value) >> shift > kMaxNarrowOffset)
                    ++shift;
            for (size_t word = first; word < first + count; ++word)
                ranges[word].shift = shift;
        };
        share(kPositionWord, 3);
        for (uint32_t set = 0; set < 4; ++set)
            if (uvFractionBits(layout, set) != 0)
                share(kUvWord + 2 * set, 2);
        return ranges;
    }

    std::unordered_map<FullVertex, uint32_t, VertexHash> numbers_;
    std::vector<FullVertex> vertices_;
    std::vector<uint32_t> indices_;
};

/// Collect the clusters that `isDrawn` selects as one mesh.
template <typename IsDrawn>
WholeMesh wholeMesh(const Hierarchy& hierarchy, const IsDrawn& isDrawn)
{
    WholeMesh mesh;
    PageDecoder decoder;
    std::vector<std::byte> decoded(kMaxPageBytes);
    for (const PageRecord& page : hierarchy.pages)
    {
        const auto clusters =
            recordsInRange(std::span<const ClusterRecord>(hierarchy.clusters), page.clusters);
        if (std::none_of(clusters.begin(), clusters.end(), isDrawn))
            continue;
        HEARTH_ASSERT(page.size <= decoded.size() &&
                      page.offset + page.stored_size <= hierarchy.page_bytes.size());
        const auto stored = std::span(hierarchy.page_bytes).subspan(page.offset, page.stored_size);
        const auto bytes = std::span(decoded).first(page.size);
        HEARTH_ASSERT(decoder.decode(stored, clusters, hierarchy.mesh.attributes, bytes));
        for (const ClusterRecord& cluster : clusters)
        {
            if (!isDrawn(cluster))
                continue;
            const auto geometry = ClusterGeometry::at(bytes, cluster, hierarchy.mesh);
            HEARTH_ASSERT(geometry.has_value());
            mesh.add(cluster, *geometry);
        }
    }
    return mesh;
}

} // namespace

DiscreteLods measureDiscreteLods(const Hierarchy& hierarchy)
{
    DiscreteLods chain;
    if (hierarchy.clusters.empty())
        return chain;
    const auto add = [&](const WholeMesh& mesh)
    {
        const std::vector<std::byte> vertices = mesh.vertexBytes(hierarchy.mesh.attributes);
        const std::vector<std::byte> indices = mesh.indexBytes();
        chain.lods.push_back(mesh.counts());
        chain.bytes += vertices.size() + indices.size();
        chain.bytes_zstd += zstdSize(vertices, kChainZstdLevel) + zstdSize(indices, kChainZstdLevel);
    };
    add(wholeMesh(hierarchy, [](const ClusterRecord& cluster) { return cluster.level == 0; }));
    const CutSizes sizes(hierarchy);
    for (uint32_t lod = 1; lod < kDiscreteLodCount; ++lod)
    {
        const uint64_t most = chain.lods.front().triangles >> lod;
        const float error = sizes.errorFor(most);
        if (std::isinf(error))
            break;
        if (chain.lods.back().triangles > most)
            add(wholeMesh(hierarchy,
                          [&](const ClusterRecord& cluster)
                          {
                              return clusterError(cluster, hierarchy.groups) <= error &&
                                     hierarchy.groups[cluster.group].error > error;
                          }));
    }
    return chain;
}

uint64_t storedBytes(const Hierarchy& hierarchy)
{
    uint64_t bytes = hierarchy.page_bytes.size();
    const auto add = [&](const auto& table)
    { bytes += zstdSize(std::as_bytes(std::span(table)), kTableZstdLevel); };
    add(std::span(&hierarchy.mesh, 1));
    add(hierarchy.levels);
    add(hierarchy.groups);
    add(hierarchy.clusters);
    add(hierarchy.pages);
    add(hierarchy.page_parents);
    return bytes;
}

} // namespace hearth::clusters

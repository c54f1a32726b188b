// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/codecs/page_decode.h"

#include "formats/codecs/cluster_bounds.h"
#include "formats/codecs/page_vertices.h"

#include <zstd.h>

#include <algorithm>
#include <cstring>
#include <vector>

namespace hearth::formats
{

namespace
{

using namespace page;

/// Upper bound of the content of a 64 KiB page before its entropy coding.
constexpr size_t kMaxContentBytes = size_t{1} << 19;

/// Vertices of a cluster that edges can address.
constexpr size_t kLocalIndices = 256;

template <size_t Blocks>
Slot<Blocks> readClusterBase(const ClusterRecord& cluster, const VertexLanes& lanes, const uint8_t* uv_bases)
{
    Slot<Blocks> base{};
    for (size_t axis = 0; axis < 3; ++axis)
        base[0][axis] = static_cast<uint16_t>(cluster.base[axis]);
    size_t word = 0;
    for (size_t lane = 3; lane < lanes.count; ++lane)
        if (lanes.kinds[lane] == LaneKind::grid)
        {
            uint16_t low;
            std::memcpy(&low, uv_bases + 4 * word++, sizeof(low));
            base[lane / kHalves][lane % kHalves] = low;
        }
    return base;
}

/// Decoder of a page's clusters, in order.
template <size_t Blocks>
class ClusterDecoder
{
public:
    ClusterDecoder(Streams& streams, uint32_t mesh_layout, const VertexLanes& lanes, std::span<Halves> slots,
                   std::span<std::byte> out)
        : streams_(streams),
          mesh_layout_(mesh_layout),
          lanes_(lanes),
          vertices_(streams, lanes, slots),
          page_(out)
    {
    }

    bool decode(std::span<const ClusterRecord> clusters)
    {
        for (size_t first = 0; first < clusters.size(); first += 2)
        {
            const auto pair = clusters.subspan(first, std::min<size_t>(2, clusters.size() - first));
            if (!TriangleDecoder::decode(
                    streams_,
                    {pair.front().triangle_count, pair.size() < 2 ? uint8_t{0} : pair[1].triangle_count},
                    connectivity_))
                return false;
            for (size_t i = 0; i < pair.size(); ++i)
                if (!writeCluster(pair[i], connectivity_[i]))
                    return false;
        }
        writeMorphs(page_.size());
        return isAllRead();
    }

private:
    bool writeCluster(const ClusterRecord& cluster, const Connectivity& connectivity)
    {
        if (connectivity.vertex_count != cluster.vertex_count)
            return false;
        const uint32_t layout = clusterVertexLayout(cluster, mesh_layout_);
        const size_t base_bytes = size_t{uvBaseWords(layout)} * 4;
        const size_t vertex_bytes = size_t{vertexWords(layout)} * 4;
        const size_t index_bytes = size_t{cluster.triangle_count} * 3;
        writeMorphs(size_t{cluster.page_word} * 4);
        std::byte* const end =
            page_.data() + at_ + clusterBytes(layout, cluster.vertex_count, cluster.triangle_count);
        const uint8_t* const uv_bases = streams_.uv_bases.at;
        std::byte* at = page_.data() + at_;
        std::memcpy(at, uv_bases, base_bytes);
        streams_.uv_bases.at += base_bytes;
        at += base_bytes;
        if (layout & kVertexWideOffsets)
        {
            if (connectivity.referenceCount() != 0)
                return false;
            std::memcpy(at, streams_.wide.at, cluster.vertex_count * vertex_bytes);
            streams_.wide.at += cluster.vertex_count * vertex_bytes;
        }
        else if (!vertices_.decode(connectivity, readClusterBase<Blocks>(cluster, lanes_, uv_bases), at,
                                   vertex_bytes, end))
            return false;
        at += cluster.vertex_count * vertex_bytes;
        std::memcpy(at, connectivity.indices.data(), index_bytes);
        std::fill(at + index_bytes, end, std::byte{0});
        at_ = static_cast<size_t>(end - page_.data());
        return true;
    }

    /// Write the words after the triangles of the last cluster, up to `end`.
    void writeMorphs(size_t end)
    {
        for (; at_ < end; at_ += streams_.morphs.size())
            for (size_t i = 0; i < streams_.morphs.size(); ++i)
                page_[at_ + i] = std::byte{*streams_.morphs[i]++};
    }

    bool isAllRead() const
    {
        return vertices_.isAllRead() && streams_.escapes.isAllRead() && streams_.restarts[0].isAllRead() &&
               streams_.restarts[1].isAllRead() && streams_.reuses[0].isAllRead() &&
               streams_.reuses[1].isAllRead();
    }

    Streams& streams_;
    uint32_t mesh_layout_;
    const VertexLanes& lanes_;
    std::array<Connectivity, 2> connectivity_;
    VertexDecoder<Blocks> vertices_;
    std::span<std::byte> page_;
    size_t at_ = 0; ///< bytes written
};

template <size_t Blocks>
bool decodeClusters(Streams& streams, std::span<const ClusterRecord> clusters, uint32_t mesh_layout,
                    const VertexLanes& lanes, std::span<Halves> slots, std::span<std::byte> out)
{
    return ClusterDecoder<Blocks>(streams, mesh_layout, lanes, slots, out).decode(clusters);
}

} // namespace

struct PageDecoder::Scratch
{
    struct FreeContext
    {
        void operator()(ZSTD_DCtx* freed) const { ZSTD_freeDCtx(freed); }
    };
    std::unique_ptr<ZSTD_DCtx, FreeContext> context{ZSTD_createDCtx()};
    std::vector<std::byte> content;
    std::vector<Halves> slots;

    /// Return the content with kStreamSlack bytes after it: the decompressed frame and the bytes that follow
    /// the frame. Empty if there is no frame.
    std::span<const std::byte> decompress(std::span<const std::byte> stored)
    {
        const unsigned long long size = ZSTD_getFrameContentSize(stored.data(), stored.size());
        const size_t frame = ZSTD_findFrameCompressedSize(stored.data(), stored.size());
        if (context == nullptr || size > kMaxContentBytes || ZSTD_isError(frame))
            return {};
        const auto coded = static_cast<size_t>(size);
        const std::span<const std::byte> rest = stored.subspan(frame);
        if (rest.size() > kMaxContentBytes)
            return {};
        if (content.size() < coded + rest.size() + kStreamSlack)
            content.resize(coded + rest.size() + kStreamSlack);
        if (ZSTD_decompressDCtx(context.get(), content.data(), coded, stored.data(), frame) != coded)
            return {};
        std::copy(rest.begin(), rest.end(), content.begin() + static_cast<ptrdiff_t>(coded));
        return std::span(content).first(coded + rest.size());
    }
};

PageDecoder::PageDecoder() : scratch_(std::make_unique<Scratch>()) {}
PageDecoder::PageDecoder(PageDecoder&&) noexcept = default;
PageDecoder& PageDecoder::operator=(PageDecoder&&) noexcept = default;
PageDecoder::~PageDecoder() = default;

bool PageDecoder::decode(std::span<const std::byte> stored, std::span<const ClusterRecord> clusters,
                         uint32_t mesh_layout, std::span<std::byte> out)
{
    PageStreamSizes shape;
    size_t end = 0;
    for (const ClusterRecord& cluster : clusters)
        if (!shape.add(cluster, mesh_layout, end))
            return false;
    if (out.empty() || !shape.finish(end, out.size()) || out.size() > kMaxPageBytes)
        return false;
    const std::span<const std::byte> content = scratch_->decompress(stored);
    const VertexLanes lanes = vertexLanes(mesh_layout);
    std::optional<Streams> streams = splitContent(content, shape, lanes);
    if (!streams)
        return false;
    const size_t blocks = (lanes.count + kHalves - 1) / kHalves;
    const size_t needed = (shape.slots + kLocalIndices) * blocks;
    if (scratch_->slots.size() < needed)
        scratch_->slots.resize(needed);
    switch (blocks)
    {
    case 1:
        return decodeClusters<1>(*streams, clusters, mesh_layout, lanes, scratch_->slots, out);
    case 2:
        return decodeClusters<2>(*streams, clusters, mesh_layout, lanes, scratch_->slots, out);
    case 3:
        return decodeClusters<3>(*streams, clusters, mesh_layout, lanes, scratch_->slots, out);
    case 4:
        return decodeClusters<4>(*streams, clusters, mesh_layout, lanes, scratch_->slots, out);
    case 5:
        return decodeClusters<5>(*streams, clusters, mesh_layout, lanes, scratch_->slots, out);
    default:
        return decodeClusters<6>(*streams, clusters, mesh_layout, lanes, scratch_->slots, out);
    }
}

} // namespace hearth::formats

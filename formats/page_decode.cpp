// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/page_decode.h"

#include "formats/byte_reader.h"
#include "formats/cluster_bounds.h"
#include "formats/page_codec.h"
#include "formats/vector16.h"

#include <zstd.h>

#include <algorithm>
#include <cstring>
#include <vector>

// Safe without a check at every byte: what a cluster can read and write at most is known before it starts (128 triangles,
// 384 corners). Streams, slots and buffers have that much room behind them; counts are checked when the cluster is done.

namespace hearth::formats
{

namespace
{

/// More than any page of 64 KiB comes to before its entropy coding.
constexpr size_t kMostContent = size_t{1} << 19;

constexpr size_t kClusterCorners = size_t{kClusterMaxTriangles} * 3;

/// Bytes behind the streams that a cluster may read in vain: two for each corner, and a vector.
constexpr size_t kStreamSlack = 2 * kClusterCorners + 64;

constexpr size_t kMostBlocks = (kMaxLanes + kHalves - 1) / kHalves;

/// Vertices are kept in slots of whole vectors. Slot 0 is all zeros.
constexpr size_t kLocalIndices = 256;

// How a vertex comes about: the edge's two vertices, the third corner of the triangle beside it, and
constexpr uint32_t kReferenceBit = 1u << 24;
constexpr uint32_t kLooseBit = 1u << 25; ///< no edge: the vertex before, whatever it is

constexpr uint32_t edge(uint32_t first, uint32_t second, uint32_t opposite)
{
    return first | second << 8 | opposite << 16;
}

struct Stream
{
    const uint8_t* at = nullptr;
    const uint8_t* end = nullptr;

    bool overrun() const { return at > end; }
};

struct Streams
{
    PageHeader header;
    Stream codes, restarts, reuses, uv_bases, wide, escapes;
    const uint8_t* references = nullptr; ///< low bytes; the high ones header.references behind them
    std::array<const uint8_t*, 2 * kMostBlocks * kHalves> planes{};
};

/// What the page's clusters need; false where they do not fill it one behind the other.
struct PageShape
{
    size_t codes = 0;
    size_t uv_base_bytes = 0;
    size_t wide_bytes = 0;
    size_t slots = 1;

    bool add(const ClusterRecord& cluster, uint32_t mesh_layout, size_t& end)
    {
        if (cluster.vertex_count > kClusterMaxVertices || cluster.triangle_count > kClusterMaxTriangles ||
            size_t{cluster.page_word} * 4 != end)
            return false;
        const uint32_t layout = layoutOf(cluster, mesh_layout);
        end += clusterBytes(layout, cluster.vertex_count, cluster.triangle_count);
        codes += (size_t{cluster.triangle_count} + 1) / 2;
        uv_base_bytes += size_t{uvBaseWords(layout)} * 4;
        if (layout & kVertexWide)
            wide_bytes += size_t{cluster.vertex_count} * vertexWords(layout) * 4;
        else
            slots += cluster.vertex_count;
        return true;
    }
};

/// Which lanes are coded how, as masks.
struct LaneMasks
{
    std::array<Halves, kMostBlocks> grid{}, mean{}, bytes{}, rest_scale{};
    size_t blocks = 0;

    LaneMasks(const VertexLanes& lanes, const PageHeader& header) : blocks((lanes.count + kHalves - 1) / kHalves)
    {
        for (size_t i = 0; i < lanes.count; ++i)
        {
            const LaneKind kind = lanes.kinds[i];
            const size_t block = i / kHalves, lane = i % kHalves;
            grid[block][lane] = kind == LaneKind::grid ? 0xFFFF : 0;
            mean[block][lane] = kind == LaneKind::mean ? 0xFFFF : 0;
            bytes[block][lane] = kind == LaneKind::mean || kind == LaneKind::code ? 0xFFFF : 0;
            rest_scale[block][lane] = static_cast<uint16_t>(1u << header.low_bits[i]);
        }
    }
};

/// Corners of the triangles of a cluster, and how its vertices come about.
struct Connectivity
{
    std::array<uint8_t, kClusterCorners + 1> indices; ///< room for a word at the last triangle
    std::array<uint32_t, kClusterCorners + 1> edges;
    uint32_t vertex_count = 0;
    uint32_t reference_count = 0;
};

class TriangleDecoder
{
public:
    TriangleDecoder(Streams& streams, Connectivity& out)
        : reuses_(streams.reuses.at), restarts_(streams.restarts.at), out_(out)
    {
    }

    /// False where a corner names a vertex that is not there yet, or there is no such code.
    bool decode(const uint8_t* codes, uint32_t triangle_count)
    {
        for (uint32_t t = 0; t < triangle_count; ++t)
        {
            const uint32_t code = codes[t / 2] >> (t % 2 * 4) & 15u;
            if (code >= 3 * kEdgeKept) [[unlikely]]
            {
                if (code == kCodeRestart)
                {
                    restart(t);
                    continue;
                }
                bad_ |= code > 3 * kEdgeKept + kCornerReuse || kept_count_ == 0 ? 1u : 0u;
                --kept_count_;
                addTriangle(t, kept_[kept_count_], code - 3 * kEdgeKept);
                continue;
            }
            const uint32_t right = edge(c_, b_, a_);
            const uint32_t left = edge(a_, c_, b_);
            kept_[kept_count_] = left;
            const uint32_t way = kWays[code];
            kept_count_ = static_cast<uint8_t>(kept_count_ + (way >> 3));
            addTriangle(t, (way & 4u) ? left : right, way & 3u);
        }
        out_.vertex_count = next_;
        out_.reference_count = references_;
        return bad_ == 0;
    }

    void advance(Streams& streams) const
    {
        streams.reuses.at = reuses_;
        streams.restarts.at = restarts_;
    }

private:
    /// corner | 4 if left | 8 if the left edge is kept; of the codes below 3 * kEdgeKept
    static constexpr std::array<uint8_t, 9> kWays{0, 1, 2, 8, 9, 10, 4, 5, 6};

    uint32_t corner(uint32_t kind, uint32_t new_edge)
    {
        const bool reuse = kind == kCornerReuse;
        const uint32_t reused = (last_reuse_ + unzigzag8(*reuses_)) & 255u;
        out_.edges[next_] = new_edge | (kind == kCornerReference ? kReferenceBit : 0u);
        const uint32_t vertex = reuse ? reused : next_;
        last_reuse_ = reuse ? reused : last_reuse_;
        reuses_ += reuse ? 1 : 0;
        next_ += reuse ? 0 : 1;
        references_ += kind == kCornerReference ? 1 : 0;
        bad_ |= vertex >= next_ ? 1u : 0u;
        return vertex;
    }

    void addTriangle(uint32_t t, uint32_t from, uint32_t kind)
    {
        a_ = from & 255u;
        b_ = from >> 8 & 255u;
        c_ = corner(kind, from);
        write(t);
    }

    void restart(uint32_t t)
    {
        const uint32_t kinds = *restarts_++;
        bad_ |= (kinds & kinds >> 1 & 0x15u) != 0 || kinds > 63 ? 1u : 0u;
        a_ = corner(kinds & 3u, kLooseBit);
        b_ = corner(kinds >> 2 & 3u, edge(a_, a_, a_));
        c_ = corner(kinds >> 4 & 3u, edge(b_, b_, b_));
        write(t);
    }

    void write(uint32_t t)
    {
        const uint32_t word = edge(a_, b_, c_);
        std::memcpy(out_.indices.data() + size_t{t} * 3, &word, sizeof(word));
    }

    const uint8_t* reuses_;
    const uint8_t* restarts_;
    Connectivity& out_;
    uint32_t a_ = 0, b_ = 0, c_ = 0;
    uint32_t next_ = 0;
    uint32_t references_ = 0;
    uint32_t last_reuse_ = 0;
    uint8_t kept_count_ = 0; ///< wraps around like kept_, once a code was bad
    uint32_t bad_ = 0;
    std::array<uint32_t, 256> kept_{};
};

/// The vertices of narrow clusters, in slots, and of one cluster after the other in the page.
template <size_t Blocks>
class VertexDecoder
{
public:
    using Slot = std::array<Halves, Blocks>;

    VertexDecoder(Streams& streams, const LaneMasks& masks, std::span<Halves> slots)
        : streams_(streams), masks_(masks), slots_(reinterpret_cast<Slot*>(slots.data()))
    {
        slots_[0] = Slot{};
    }

    /// Slots that are taken; the first is that of no vertex.
    size_t slotCount() const { return slot_count_; }

    bool decode(const Connectivity& connectivity, const Slot& base, std::byte* out, size_t vertex_bytes,
                const std::byte* end)
    {
        const uint32_t fresh = connectivity.vertex_count - connectivity.reference_count;
        if (fresh > streams_.header.new_vertices - new_used_ ||
            connectivity.reference_count > streams_.header.references - references_used_)
            return false;
        readResiduals(fresh);
        const Slot* const first = slots_ + slot_count_;
        const Slot* residual = residuals_.data();
        bool good = true;
        for (uint32_t v = 0; v < connectivity.vertex_count; ++v)
        {
            const uint32_t how = connectivity.edges[v];
            Slot& slot = slots_[slot_count_];
            if (how & kReferenceBit)
            {
                const size_t from = nextReference();
                good = good && from < slot_count_;
                slot = slots_[good ? from : 0];
            }
            else if (how & kLooseBit)
                slot = sum(predict(slots_[slot_count_ - 1], slots_[slot_count_ - 1], slots_[slot_count_ - 1]),
                           *residual++);
            else
                slot = sum(predict(first[how & 255u], first[how >> 8 & 255u], first[how >> 16 & 255u]),
                           *residual++);
            ++slot_count_;
            Slot offset;
            for (size_t i = 0; i < Blocks; ++i)
                offset[i] = slot[i] - base[i];
            // whole vectors run over into what is written later, but not beyond the cluster
            if (static_cast<size_t>(end - out) >= sizeof(Slot))
                std::memcpy(out, &offset, sizeof(Slot));
            else
                std::memcpy(out, &offset, vertex_bytes);
            out += vertex_bytes;
        }
        return good;
    }

    bool allRead() const
    {
        return new_used_ == streams_.header.new_vertices && references_used_ == streams_.header.references;
    }

private:
    size_t nextReference()
    {
        const uint8_t* const low = streams_.references + references_used_;
        const uint32_t code = uint32_t{low[0]} | uint32_t{low[streams_.header.references]} << 8;
        ++references_used_;
        last_reference_ = (last_reference_ + unzigzag16(static_cast<uint16_t>(code))) & 0xFFFFu;
        return last_reference_;
    }

    Slot predict(const Slot& a, const Slot& b, const Slot& opposite) const
    {
        Slot prediction;
        for (size_t i = 0; i < Blocks; ++i)
        {
            const Halves grid = a[i] + b[i] - opposite[i];
            const Halves mean = meanOfBytes(a[i], b[i]);
            prediction[i] = (grid & masks_.grid[i]) | (mean & masks_.mean[i]) |
                            (b[i] & ~(masks_.grid[i] | masks_.mean[i]));
        }
        return prediction;
    }

    Slot sum(const Slot& prediction, const Slot& residual) const
    {
        Slot sums;
        for (size_t i = 0; i < Blocks; ++i)
            sums[i] = select(masks_.bytes[i], addBytes(prediction[i], residual[i]), prediction[i] + residual[i]);
        return sums;
    }

    /// Of the cluster's new vertices, from the planes of all their bytes.
    void readResiduals(uint32_t count)
    {
        for (size_t i = 0; i < Blocks; ++i)
        {
            const uint8_t** const planes = streams_.planes.data() + i * 2 * kHalves;
            for (uint32_t v = 0; v < count; v += 16)
            {
                std::array<Bytes, 16> rows;
                for (size_t p = 0; p < 16; ++p)
                    rows[p] = planes[p] != nullptr ? loadBytes(planes[p] + v) : Bytes{};
                transpose(rows);
                Halves escapes{};
                for (size_t k = 0; k < 16; ++k)
                {
                    const Halves code = asHalves(rows[k]);
                    residuals_[v + k][i] = residual(code, i);
                    escapes |= escapesIn(code, i);
                }
                if (anyBit(escapes)) [[unlikely]]
                    readEscapes(rows, v, std::min(count - v, 16u), i);
            }
            for (size_t p = 0; p < 16; ++p)
                if (planes[p] != nullptr)
                    planes[p] += count;
        }
        new_used_ += count;
    }

    Halves escapesIn(Halves code, size_t block) const
    {
        return static_cast<Halves>((code & 0xFF) == kEscape) & ~masks_.bytes[block];
    }

    void readEscapes(std::span<const Bytes, 16> rows, uint32_t first, uint32_t count, size_t block)
    {
        for (uint32_t k = 0; k < count; ++k)
        {
            const Halves escapes = escapesIn(asHalves(rows[k]), block);
            for (size_t lane = 0; lane < kHalves; ++lane)
            {
                if (escapes[lane] == 0)
                    continue;
                uint16_t number = 0;
                if (streams_.escapes.end - streams_.escapes.at >= 2)
                    std::memcpy(&number, streams_.escapes.at, sizeof(number));
                streams_.escapes.at += 2;
                residuals_[first + k][block][lane] = unzigzag16(number);
            }
        }
    }

    Halves residual(Halves code, size_t block) const
    {
        const Halves whole = (code & 0xFF) * masks_.rest_scale[block] + (code >> 8);
        return select(masks_.bytes[block], unzigzagBytes(code), (whole >> 1) ^ -(whole & 1));
    }

    Streams& streams_;
    const LaneMasks& masks_;
    Slot* slots_;
    size_t slot_count_ = 1;
    uint32_t new_used_ = 0;
    uint32_t references_used_ = 0;
    size_t last_reference_ = 0;
    std::array<Slot, kClusterCorners + 16> residuals_;
};

/// The streams of the content; nullopt where their sizes do not add up to it.
std::optional<Streams> splitContent(std::span<const std::byte> content, const PageShape& shape,
                                    const VertexLanes& lanes)
{
    ByteReader reader(content);
    const auto header = reader.read<PageHeader>();
    if (!header)
        return std::nullopt;
    Streams streams;
    streams.header = *header;
    bool good = true;
    const auto take = [&](size_t size)
    {
        const auto bytes = reader.readBytes(size);
        good = good && bytes.has_value();
        const auto* at = bytes ? reinterpret_cast<const uint8_t*>(bytes->data()) : nullptr;
        return Stream{at, at + (bytes ? size : 0)};
    };
    streams.codes = take(shape.codes);
    streams.restarts = take(header->restarts);
    streams.reuses = take(header->reuses);
    streams.references = take(size_t{header->references} * 2).at;
    streams.uv_bases = take(shape.uv_base_bytes);
    streams.wide = take(shape.wide_bytes);
    streams.escapes = take(size_t{header->escapes} * 2);
    for (size_t lane = 0; lane < kMaxLanes; ++lane)
    {
        good = good && header->planes[lane] <= (kPlaneMain | kPlaneRest) && header->low_bits[lane] <= 8 &&
               (lane < lanes.count || header->planes[lane] == 0);
    }
    for (const size_t part : {size_t{0}, size_t{1}})
        for (size_t lane = 0; lane < lanes.count; ++lane)
            if (header->planes[lane] >> part & 1)
                streams.planes[2 * lane + part] = take(header->new_vertices).at;
    if (!good || reader.remaining() != 0)
        return std::nullopt;
    return streams;
}

template <size_t Blocks>
std::array<Halves, Blocks> baseOf(const ClusterRecord& cluster, const VertexLanes& lanes,
                                  const uint8_t* uv_bases)
{
    std::array<Halves, Blocks> base{};
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

template <size_t Blocks>
bool decodeClusters(Streams& streams, std::span<const ClusterRecord> clusters, uint32_t mesh_layout,
                    const VertexLanes& lanes, std::span<Halves> slots, std::span<std::byte> out)
{
    const LaneMasks masks(lanes, streams.header);
    VertexDecoder<Blocks> vertices(streams, masks, slots);
    Connectivity connectivity;
    std::byte* at = out.data();
    for (const ClusterRecord& cluster : clusters)
    {
        const uint32_t layout = layoutOf(cluster, mesh_layout);
        TriangleDecoder triangles(streams, connectivity);
        if (!triangles.decode(streams.codes.at, cluster.triangle_count) ||
            connectivity.vertex_count != cluster.vertex_count)
            return false;
        triangles.advance(streams);
        streams.codes.at += (size_t{cluster.triangle_count} + 1) / 2;
        if (streams.reuses.overrun() || streams.restarts.overrun())
            return false;

        const size_t base_bytes = size_t{uvBaseWords(layout)} * 4;
        const size_t vertex_bytes = size_t{vertexWords(layout)} * 4;
        const size_t index_bytes = size_t{cluster.triangle_count} * 3;
        std::byte* const end = at + clusterBytes(layout, cluster.vertex_count, cluster.triangle_count);
        const uint8_t* const uv_bases = streams.uv_bases.at;
        std::memcpy(at, uv_bases, base_bytes);
        streams.uv_bases.at += base_bytes;
        at += base_bytes;
        if (layout & kVertexWide)
        {
            if (connectivity.reference_count != 0)
                return false;
            std::memcpy(at, streams.wide.at, cluster.vertex_count * vertex_bytes);
            streams.wide.at += cluster.vertex_count * vertex_bytes;
        }
        else if (!vertices.decode(connectivity, baseOf<Blocks>(cluster, lanes, uv_bases), at,
                                  vertex_bytes, end))
            return false;
        at += cluster.vertex_count * vertex_bytes;
        std::memcpy(at, connectivity.indices.data(), index_bytes);
        std::fill(at + index_bytes, end, std::byte{0});
        at = end;
    }
    return vertices.allRead() && streams.escapes.at == streams.escapes.end &&
           streams.reuses.at == streams.reuses.end &&
           streams.restarts.at == streams.restarts.end;
}

} // namespace

struct PageDecoder::Scratch
{
    struct FreeContext
    {
        void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
    };
    std::unique_ptr<ZSTD_DCtx, FreeContext> context{ZSTD_createDCtx()};
    std::vector<std::byte> content;
    std::vector<Halves> slots;

    /// The decompressed content with kStreamSlack bytes behind it; empty if it is none.
    std::span<const std::byte> decompress(std::span<const std::byte> stored)
    {
        const unsigned long long size = ZSTD_getFrameContentSize(stored.data(), stored.size());
        if (context == nullptr || size > kMostContent)
            return {};
        const auto content_size = static_cast<size_t>(size);
        if (content.size() < content_size + kStreamSlack)
            content.resize(content_size + kStreamSlack);
        const size_t frame = ZSTD_findFrameCompressedSize(stored.data(), stored.size());
        if (ZSTD_isError(frame) || frame != stored.size() ||
            ZSTD_decompressDCtx(context.get(), content.data(), content_size, stored.data(), stored.size()) !=
                content_size)
            return {};
        return std::span(content).first(content_size);
    }
};

PageDecoder::PageDecoder() : scratch_(std::make_unique<Scratch>()) {}
PageDecoder::PageDecoder(PageDecoder&&) noexcept = default;
PageDecoder& PageDecoder::operator=(PageDecoder&&) noexcept = default;
PageDecoder::~PageDecoder() = default;

bool PageDecoder::decode(std::span<const std::byte> stored, std::span<const ClusterRecord> clusters,
                         uint32_t mesh_layout, std::span<std::byte> out)
{
    PageShape shape;
    size_t end = 0;
    for (const ClusterRecord& cluster : clusters)
        if (!shape.add(cluster, mesh_layout, end))
            return false;
    if (end != out.size() || out.size() > kPageMaxBytes)
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
    default:
        return decodeClusters<4>(*streams, clusters, mesh_layout, lanes, scratch_->slots, out);
    }
}

} // namespace hearth::formats

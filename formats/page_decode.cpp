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
    std::array<const uint8_t*, 2 * kMostBlocks * kHalves> planes{}; ///< main and second byte of each lane
    std::array<std::array<const uint8_t*, 2>, kMostBlocks> low_bits{};
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
    std::array<Halves, kMostBlocks> grid{}, bytes{}, main_scale{};
    std::array<Halves, kMostBlocks> lowest_field{}, field{},
        field_power{}; ///< the lowest has no power to be shifted by

    LaneMasks(const VertexLanes& lanes, const PageHeader& header)
    {
        for (size_t block = 0; block < kMostBlocks; ++block)
        {
            const LowBitFields fields = lowBitFields(header, block);
            for (size_t lane = 0; lane < kHalves; ++lane)
            {
                const bool lowest = fields.first[lane] == 0;
                (lowest ? lowest_field : field)[block][lane] = static_cast<uint16_t>(fields.mask[lane]);
                field_power[block][lane] = static_cast<uint16_t>(1u << (16 - fields.first[lane]));
            }
        }
        for (size_t i = 0; i < lanes.count; ++i)
        {
            const LaneKind kind = lanes.kinds[i];
            const size_t block = i / kHalves, lane = i % kHalves;
            grid[block][lane] = kind == LaneKind::grid ? 0xFFFF : 0;
            bytes[block][lane] = kind == LaneKind::bytes ? 0xFFFF : 0;
            main_scale[block][lane] = static_cast<uint16_t>(1u << header.low_bits[i]);
        }
    }
};

/// Corners of the triangles of a cluster, and how its vertices come about.
struct Connectivity
{
    std::array<uint8_t, kClusterCorners + 1> indices; ///< room for a word at the last triangle
    std::array<uint32_t, kClusterCorners + 1> edges;
    uint32_t vertex_count = 0;

    uint32_t countReferences() const
    {
        uint32_t count = 0;
        for (uint32_t v = 0; v < vertex_count; ++v)
            count += (edges[v] & kReferenceBit) / kReferenceBit;
        return count;
    }
};

/// What a code means, as masks: the next code cannot be foretold, and a wrong guess costs more than a triangle.
struct Way
{
    uint32_t left;  ///< all bits, or none
    uint32_t kept;  ///< the same
    uint32_t reuse; ///< the same
    uint32_t keep;  ///< 1 or 0
    uint32_t reference_bit;
    uint32_t bad; ///< the highest bit
};

constexpr std::array<Way, 16> kWays = []
{
    std::array<Way, 16> ways{};
    for (uint32_t code = 0; code < ways.size(); ++code)
    {
        const uint32_t start = code / 3;
        const uint32_t corner = code % 3;
        ways[code] = {start == kEdgeLeft ? ~0u : 0u,
                      start == kEdgeKept ? ~0u : 0u,
                      corner == kCornerReuse ? ~0u : 0u,
                      start == kEdgeRightKeepLeft ? 1u : 0u,
                      corner == kCornerReference ? kReferenceBit : 0u,
                      start > kEdgeKept ? 1u << 31 : 0u};
    }
    return ways;
}();

constexpr uint32_t choose(uint32_t mask, uint32_t yes, uint32_t no)
{
    return no ^ ((no ^ yes) & mask);
}

class TriangleDecoder
{
public:
    /// False where a corner names a vertex that is not there yet, or there is no such code. Moves the streams on.
    bool decode(Streams& streams, uint32_t triangle_count, Connectivity& out)
    {
        State s{streams.reuses.at, out.edges.data()};
        const uint8_t* restarts = streams.restarts.at;
        const uint8_t* const codes = streams.codes.at;
        for (uint32_t t = 0; t < triangle_count; ++t)
        {
            const uint32_t code = uint32_t{codes[t / 2]} >> (t % 2 * 4) & 15u;
            if (code == kCodeRestart) [[unlikely]]
            {
                restart(s, *restarts++);
                write(out, t, s.triangle);
                continue;
            }
            // a triangle is its corners in the bytes of a word
            const Way& way = kWays[code];
            const uint32_t right = __builtin_bswap32(s.triangle) >> 8;
            const uint32_t left =
                (s.triangle & 0xFFu) | (s.triangle >> 8 & 0xFF00u) | (s.triangle << 8 & 0xFF0000u);
            kept_[s.kept_count % kept_.size()] = left;
            s.kept_count += way.keep + way.kept;
            const uint32_t kept = kept_[s.kept_count % kept_.size()];
            const uint32_t from = choose(way.kept, kept, choose(way.left, left, right));
            s.bad |= s.kept_count | way.bad;
            s.triangle = (from & 0xFFFFu) | corner(s, way, from) << 16;
            write(out, t, s.triangle);
        }
        out.vertex_count = s.next;
        streams.reuses.at = s.reuses;
        streams.restarts.at = restarts;
        streams.codes.at += (size_t{triangle_count} + 1) / 2;
        return (s.bad & kBad) == 0;
    }

private:
    static constexpr uint32_t kBad = 1u << 31;

    struct State
    {
        const uint8_t* reuses;
        uint32_t* edges;
        uint32_t triangle = 0;
        uint32_t next = 0;
        uint32_t last_reuse = 0;
        uint32_t bad = 0;        ///< only its highest bit says something
        uint32_t kept_count = 0; ///< below 0 once a code was bad
    };

    static uint32_t corner(State& s, const Way& way, uint32_t from)
    {
        const uint32_t reused = (s.last_reuse + *s.reuses) & 255u;
        s.edges[s.next] = from | way.reference_bit;
        const uint32_t vertex = choose(way.reuse, reused, s.next);
        s.last_reuse = choose(way.reuse, reused, s.last_reuse);
        s.reuses += way.reuse & 1u;
        s.next += 1 - (way.reuse & 1u);
        s.bad |= s.next - 1 - vertex;
        return vertex;
    }

    static void restart(State& s, uint32_t kinds)
    {
        s.bad |= (kinds & kinds >> 1 & 0x15u) != 0 || kinds > 63 ? kBad : 0;
        const auto next = [&](uint32_t shift, uint32_t from)
        { return corner(s, kWays[(kinds >> shift & 3u) % 3], from); };
        const uint32_t a = next(0, kLooseBit);
        const uint32_t b = next(2, edge(a, a, a));
        s.triangle = edge(a, b, next(4, edge(b, b, b)));
    }

    static void write(Connectivity& out, uint32_t t, uint32_t triangle)
    {
        std::memcpy(out.indices.data() + size_t{t} * 3, &triangle, sizeof(triangle));
    }

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
        const uint32_t references = connectivity.countReferences();
        const uint32_t fresh = connectivity.vertex_count - references;
        if (fresh > streams_.header.new_vertices - new_used_ ||
            references > streams_.header.references - references_used_)
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
                const uint32_t from = nextReference();
                good = good && from < slot_count_;
                slot = slots_[good ? from : 0];
            }
            else if (how & kLooseBit) [[unlikely]]
                slot = sum(slots_[slot_count_ - 1], slots_[slot_count_ - 1], slots_[slot_count_ - 1],
                           *residual++);
            else
                slot = sum(first[how & 255u], first[how >> 8 & 255u], first[how >> 16 & 255u], *residual++);
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
    uint32_t nextReference()
    {
        const uint8_t* const low = streams_.references + references_used_;
        const uint32_t code = uint32_t{low[0]} | uint32_t{low[streams_.header.references]} << 8;
        ++references_used_;
        last_reference_ = (last_reference_ + unzigzag16(static_cast<uint16_t>(code))) & 0xFFFFu;
        return last_reference_;
    }

    /// What the edge (a, b) and the corner opposite to it tell, and what is left. In an order in which the vertex before,
    /// which a or b mostly is, is waited for last.
    Slot sum(const Slot& a, const Slot& b, const Slot& opposite, const Slot& residual) const
    {
        Slot sums;
        for (size_t i = 0; i < Blocks; ++i)
        {
            const Halves halves = residual[i] & ~masks_.bytes[i];
            const Halves bytes = residual[i] & masks_.bytes[i];
            const Halves ahead = ((a[i] - opposite[i]) & masks_.grid[i]) + halves;
            sums[i] = addBytes(b[i] + ahead, bytes);
        }
        return sums;
    }

    /// Of the cluster's new vertices, from the planes of all their bytes.
    void readResiduals(uint32_t count)
    {
        for (size_t i = 0; i < Blocks; ++i)
        {
            const auto planes = std::span(streams_.planes).subspan(i * 2 * kHalves, 2 * kHalves);
            auto& low_bits = streams_.low_bits[i];
            for (uint32_t v = 0; v < count; v += 16)
            {
                std::array<Bytes, 16> rows;
                for (size_t p = 0; p < 16; ++p)
                    rows[p] = planes[p] != nullptr ? loadBytes(planes[p] + v) : Bytes{};
                transpose(rows);
                const std::array<uint16_t, 16> fields = readFields(low_bits, v);
                Halves escapes{};
                for (size_t k = 0; k < 16; ++k)
                {
                    const Halves code = asHalves(rows[k]);
                    residuals_[v + k][i] = residual(code, allHalves(fields[k]), i);
                    escapes |= escapesIn(code, i);
                }
                if (anyBit(escapes)) [[unlikely]]
                    readEscapes(rows, v, std::min(count - v, 16u), i);
            }
            for (const uint8_t*& plane : planes)
                plane += plane != nullptr ? count : 0;
            for (const uint8_t*& plane : low_bits)
                plane += plane != nullptr ? count : 0;
        }
        new_used_ += count;
    }

    /// The low bits of sixteen vertices.
    static std::array<uint16_t, 16> readFields(const std::array<const uint8_t*, 2>& low_bits, uint32_t first)
    {
        const Bytes low = low_bits[0] != nullptr ? loadBytes(low_bits[0] + first) : Bytes{};
        const Bytes high = low_bits[1] != nullptr ? loadBytes(low_bits[1] + first) : Bytes{};
        const std::array<Bytes, 2> fields{interleaveLow(low, high), interleaveHigh(low, high)};
        return std::bit_cast<std::array<uint16_t, 16>>(fields);
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

    Halves residual(Halves code, Halves fields, size_t block) const
    {
        const Halves low = (shiftRight(fields, masks_.field_power[block]) & masks_.field[block]) |
                           (fields & masks_.lowest_field[block]);
        const Halves whole = (code & 0xFF) * masks_.main_scale[block] + (code >> 8) + low;
        return select(masks_.bytes[block], code, (whole >> 1) ^ -(whole & 1));
    }

    Streams& streams_;
    const LaneMasks& masks_;
    Slot* slots_;
    size_t slot_count_ = 1;
    uint32_t new_used_ = 0;
    uint32_t references_used_ = 0;
    uint32_t last_reference_ = 0;
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
    bool good = std::all_of(std::begin(header->reserved), std::end(header->reserved),
                            [](uint8_t byte) { return byte == 0; });
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
        good = good && header->planes[lane] <= (kPlaneMain | kPlaneSecond) && header->low_bits[lane] <= 8 &&
               (lane < lanes.count || header->planes[lane] == 0);
    }
    for (const size_t part : {size_t{0}, size_t{1}})
        for (size_t lane = 0; lane < lanes.count; ++lane)
            if (header->planes[lane] >> part & 1)
                streams.planes[2 * lane + part] = take(header->new_vertices).at;
    for (size_t block = 0; block < kMostBlocks; ++block)
    {
        const LowBitFields fields = lowBitFields(*header, block);
        good = good && fields.bits <= kMaxFieldBits;
        for (size_t plane = 0; good && plane < fields.planes(); ++plane)
            streams.low_bits[block][plane] = take(header->new_vertices).at;
    }
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
    TriangleDecoder triangles;
    std::byte* at = out.data();
    for (const ClusterRecord& cluster : clusters)
    {
        const uint32_t layout = layoutOf(cluster, mesh_layout);
        if (!triangles.decode(streams, cluster.triangle_count, connectivity) ||
            connectivity.vertex_count != cluster.vertex_count || streams.reuses.overrun() ||
            streams.restarts.overrun())
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
            if (connectivity.countReferences() != 0)
                return false;
            std::memcpy(at, streams.wide.at, cluster.vertex_count * vertex_bytes);
            streams.wide.at += cluster.vertex_count * vertex_bytes;
        }
        else if (!vertices.decode(connectivity, baseOf<Blocks>(cluster, lanes, uv_bases), at, vertex_bytes,
                                  end))
            return false;
        at += cluster.vertex_count * vertex_bytes;
        std::memcpy(at, connectivity.indices.data(), index_bytes);
        std::fill(at + index_bytes, end, std::byte{0});
        at = end;
    }
    return vertices.allRead() && streams.escapes.at == streams.escapes.end &&
           streams.reuses.at == streams.reuses.end && streams.restarts.at == streams.restarts.end;
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
    if (out.empty() || end != out.size() || out.size() > kPageMaxBytes)
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

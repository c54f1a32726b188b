// Decodes the vertices of a geometry page's narrow clusters (formats/codecs/page_codec.h), with SIMD vectors
// of sixteen bytes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/codecs/page_triangles.h"
#include "formats/codecs/vector16.h"

#include <algorithm>
#include <cstring>

namespace hearth::formats::page
{

/// Lanes of a vertex, in whole vectors.
template <size_t Blocks>
using Slot = std::array<Halves, Blocks>;

/// Reader of the residuals of new vertices (vertex minus its prediction): from the planes of all their bytes,
/// sixteen vertices at a time.
template <size_t Blocks>
class ResidualReader
{
public:
    ResidualReader(Streams& streams, const VertexLanes& lanes) : streams_(streams)
    {
        for (size_t block = 0; block < Blocks; ++block)
        {
            const LowBitFields fields = lowBitFields(streams.forms, block);
            low_planes_[block] = fields.planes();
            for (size_t i = 0; i < kHalves && block * kHalves + i < lanes.count; ++i)
                if (const LanePlan plan = makeLanePlan(block * kHalves + i, lanes, fields.first[i]);
                    plan.any())
                    plans_[block][plan_counts_[block]++] = plan;
        }
    }

    /// Return the residuals of the next `count` vertices, at most 256; all are in the planes.
    std::span<const Slot<Blocks>> next(uint32_t count)
    {
        // keep the surplus of the last group
        std::copy(rows_.begin() + used_, rows_.begin() + ready_, rows_.begin());
        ready_ -= used_;
        used_ = count;
        while (ready_ < count)
            readGroup();
        return std::span(rows_).first(count);
    }

private:
    static constexpr uint32_t kGroup = 16; ///< vertices

    /// Eight lanes of sixteen vertices: the first eight vertices of each lane, and the others.
    using Group = std::array<std::array<Halves, kHalves>, 2>;

    /// Low bits of sixteen vertices in halves of words, and one extra half.
    using Fields = std::array<std::array<Halves, kMaxLowBitPlanes / 2 + 1>, 2>;

    enum class Form : uint8_t
    {
        number,
        bytes,
        nibbles,
    };

    struct LanePlan
    {
        size_t lane = 0; ///< lane in the block
        Form form = Form::number;
        const uint8_t* main = nullptr;
        const uint8_t* second = nullptr;
        uint32_t main_shift = 0; ///< position of the number in its main byte
        uint8_t escape = kEscape;
        uint32_t low_bits = 0;
        uint32_t first_low_bit = 0;
        Halves low_mask{};

        bool any() const { return main != nullptr || second != nullptr || low_bits != 0; }
    };

    LanePlan makeLanePlan(size_t lane, const VertexLanes& lanes, uint32_t first_low_bit) const
    {
        LanePlan plan;
        plan.lane = lane % kHalves;
        plan.main = streams_.main[lane];
        plan.second = streams_.second[lane];
        plan.low_bits = streams_.forms.low_bits[lane];
        plan.first_low_bit = first_low_bit;
        plan.low_mask = allHalves(static_cast<uint16_t>((1u << plan.low_bits) - 1));
        if (lanes.kinds[lane] == LaneKind::bytes)
            plan.form = (streams_.forms.planes[lane] & kPlaneNibbles) ? Form::nibbles : Form::bytes;
        if (sharesMainByte(lanes, lane))
        {
            plan.main = streams_.main[lane & ~size_t{1}];
            plan.main_shift = lane % 2 == 1 ? 4 : 0;
            plan.escape = kEscapeOfFourBits;
        }
        return plan;
    }

    void readGroup()
    {
        for (size_t block = 0; block < Blocks; ++block)
        {
            const Fields fields = readFields(block);
            for (const LanePlan& plan : std::span(plans_[block]).first(plan_counts_[block]))
                readLane(plan, fields, groups_[block]);
            Slot<Blocks>* rows = rows_.data() + ready_;
            for (std::array<Halves, kHalves> square : groups_[block])
            {
                transpose(square);
                for (const Halves row : square)
                    (*rows++)[block] = row;
            }
        }
        ready_ += kGroup;
        position_ += kGroup;
    }

    void readLane(const LanePlan& plan, const Fields& fields, Group& group)
    {
        const Bytes main = loadBytesAt(plan.main);
        if (plan.form == Form::number)
        {
            readNumbers(plan, fields, main, group);
            return;
        }
        const Bytes second = loadBytesAt(plan.second);
        if (plan.form == Form::bytes)
            put(group, plan.lane, main, second);
        else
        {
            const Halves upper = asHalves(main);
            const Halves lower = asHalves(second);
            put(group, plan.lane, asBytes((upper << 4 & 0xF0F0) | (lower & 0x0F0F)),
                asBytes((upper & 0xF0F0) | (lower >> 4 & 0x0F0F)));
        }
    }

    Bytes loadBytesAt(const uint8_t* plane) const
    {
        return plane != nullptr ? loadBytes(plane + position_) : Bytes{};
    }

    static void put(Group& group, size_t lane, Bytes low, Bytes high)
    {
        group[0][lane] = asHalves(interleaveLow(low, high));
        group[1][lane] = asHalves(interleaveHigh(low, high));
    }

    Fields readFields(size_t block) const
    {
        Fields fields;
        const auto& planes = streams_.low_bits[block];
        for (size_t i = 0; i < (low_planes_[block] + 1) / 2; ++i)
        {
            const Bytes low = loadBytesAt(planes[2 * i]), high = loadBytesAt(planes[2 * i + 1]);
            fields[0][i] = asHalves(interleaveLow(low, high));
            fields[1][i] = asHalves(interleaveHigh(low, high));
            fields[0][i + 1] = fields[1][i + 1] = Halves{};
        }
        return fields;
    }

    void readNumbers(const LanePlan& plan, const Fields& fields, Bytes bytes, Group& group)
    {
        const Bytes main = asBytes(asHalves(bytes) >> plan.main_shift) & plan.escape;
        put(group, plan.lane, main, Bytes{});
        for (size_t half = 0; half < 2; ++half)
        {
            Halves number = group[half][plan.lane];
            if (plan.low_bits != 0)
            {
                const auto low = fields[half].begin() + plan.first_low_bit / 16;
                const uint32_t shift = plan.first_low_bit % 16;
                Halves field = low[0] >> shift;
                if (shift + plan.low_bits > 16)
                    field |= low[1] << (16 - shift);
                number = number << plan.low_bits | (field & plan.low_mask);
            }
            group[half][plan.lane] = number >> 1 ^ -(number & 1);
        }
        if (anyBit(asHalves(static_cast<Bytes>(main == plan.escape)))) [[unlikely]]
            readEscapes(plan, main, group);
    }

    void readEscapes(const LanePlan& plan, Bytes main, Group& group)
    {
        const uint32_t count = std::min(streams_.header.new_vertices - position_, kGroup);
        for (uint32_t v = 0; v < count; ++v)
        {
            if (main[v] != plan.escape)
                continue;
            uint16_t number = 0;
            if (streams_.escapes.end - streams_.escapes.at >= 2)
                std::memcpy(&number, streams_.escapes.at, sizeof(number));
            streams_.escapes.at += 2;
            group[v / kHalves][plan.lane][v % kHalves] = unzigzag16(number);
        }
    }

    Streams& streams_;
    std::array<std::array<LanePlan, kHalves>, Blocks> plans_{};
    std::array<size_t, Blocks> low_planes_{};
    std::array<size_t, Blocks> plan_counts_{};
    std::array<Group, Blocks> groups_{}; ///< lanes without a plan stay 0
    std::array<Slot<Blocks>, kMaxClusterVertices + kGroup> rows_;
    uint32_t used_ = 0, ready_ = 0; ///< rows used and rows decoded
    uint32_t position_ = 0;         ///< vertices read
};

/// Decoder of the vertices of narrow clusters into slots, one cluster of the page after the other.
template <size_t Blocks>
class VertexDecoder
{
public:
    /// slots  first the slot of no vertex, which is all zeros; then one for each vertex; with room after them
    VertexDecoder(Streams& streams, const VertexLanes& lanes, std::span<Halves> slots)
        : streams_(streams), residuals_(streams, lanes), slots_(reinterpret_cast<Slot<Blocks>*>(slots.data()))
    {
        slots_[0] = Slot<Blocks>{};
        for (size_t lane = 0; lane < lanes.count; ++lane)
        {
            grid_[lane / kHalves][lane % kHalves] = lanes.kinds[lane] == LaneKind::grid ? 0xFFFF : 0;
        }
    }

    /// Decode the cluster's vertices and write them, less the base, to `out`. Writes nothing past `end`.
    bool decode(const Connectivity& connectivity, const Slot<Blocks>& base, std::byte* out,
                size_t vertex_bytes, const std::byte* end)
    {
        const uint32_t references = connectivity.referenceCount();
        if (connectivity.new_count > streams_.header.new_vertices - new_used_ ||
            references > streams_.header.references - references_used_)
            return false;
        new_used_ += connectivity.new_count;
        const std::span<const Slot<Blocks>> residuals = residuals_.next(connectivity.new_count);
        Slot<Blocks>* const cluster = slots_ + slot_count_;
        // its first vertex is predicted from this one
        cluster[0] = cluster[-1];
        if (!copyReferences(std::span(connectivity.references).first(references)))
            return false;
        for (uint32_t i = 0; i < connectivity.new_count; ++i)
        {
            const uint32_t edge = connectivity.edges[i];
            cluster[connectivity.new_vertices[i]] = sum(cluster[edge & 255u], cluster[edge >> 8 & 255u],
                                                        cluster[edge >> 16 & 255u], residuals[i]);
        }
        writeVertices(std::span(cluster, connectivity.vertex_count), base, out, vertex_bytes, end);
        slot_count_ += connectivity.vertex_count;
        return true;
    }

    bool isAllRead() const
    {
        return new_used_ == streams_.header.new_vertices && references_used_ == streams_.header.references;
    }

private:
    static void writeVertices(std::span<const Slot<Blocks>> vertices, const Slot<Blocks> base, std::byte* out,
                              size_t vertex_bytes, const std::byte* end)
    {
        const auto getOffset = [&](const Slot<Blocks>& vertex)
        {
            Slot<Blocks> offset;
            for (size_t i = 0; i < Blocks; ++i)
                offset[i] = vertex[i] - base[i];
            return offset;
        };
        // whole vectors overlap data that is written later, but do not pass the end of the cluster
        const size_t room = static_cast<size_t>(end - out);
        const size_t whole =
            room < sizeof(base) ? 0 : std::min(vertices.size(), (room - sizeof(base)) / vertex_bytes + 1);
        for (const Slot<Blocks>& vertex : vertices.first(whole))
        {
            const Slot<Blocks> offset = getOffset(vertex);
            std::memcpy(out, &offset, sizeof(offset));
            out += vertex_bytes;
        }
        for (const Slot<Blocks>& vertex : vertices.subspan(whole))
        {
            const Slot<Blocks> offset = getOffset(vertex);
            std::memcpy(out, &offset, vertex_bytes);
            out += vertex_bytes;
        }
    }

    /// False if a reference is not a vertex of an earlier cluster.
    bool copyReferences(std::span<const uint8_t> vertices)
    {
        const uint8_t* const low = streams_.references + references_used_;
        const uint8_t* const high = low + streams_.header.references;
        bool good = true;
        for (size_t i = 0; i < vertices.size(); ++i)
        {
            const auto code = static_cast<uint16_t>(low[i] | high[i] << 8);
            last_reference_ = static_cast<uint16_t>(last_reference_ + unzigzag16(code));
            const bool earlier = last_reference_ < slot_count_;
            good = good && earlier;
            slots_[slot_count_ + vertices[i]] = slots_[earlier ? last_reference_ : 0];
        }
        references_used_ += static_cast<uint32_t>(vertices.size());
        return good;
    }

    /// Add the residual to the prediction from the edge (a, b) and the corner opposite to it. The order of
    /// operations uses the previous vertex, which is mostly a or b, last.
    Slot<Blocks> sum(const Slot<Blocks>& a, const Slot<Blocks>& b, const Slot<Blocks>& opposite,
                     const Slot<Blocks>& residual) const
    {
        Slot<Blocks> sums;
        for (size_t i = 0; i < Blocks; ++i)
            sums[i] = b[i] + (((a[i] - opposite[i]) & grid_[i]) + residual[i]);
        return sums;
    }

    Streams& streams_;
    ResidualReader<Blocks> residuals_;
    Slot<Blocks>* slots_;
    Slot<Blocks> grid_{}; ///< mask of the lanes with a grid prediction
    size_t slot_count_ = 1;
    uint32_t new_used_ = 0;
    uint32_t references_used_ = 0;
    uint16_t last_reference_ = 0;
};

} // namespace hearth::formats::page

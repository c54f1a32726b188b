// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/pages/page_encode.h"

#include "cook/pages/entropy_blocks.h"
#include "cook/pages/page_planes.h"
#include "cook/pages/triangle_walk.h"
#include "formats/base/assert.h"
#include "formats/codecs/cluster_bounds.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <optional>

namespace hearth::pages
{

namespace
{

using namespace formats;

/// Size of the vertex table: more than twice the vertices of a page.
constexpr size_t kDictionarySize = 1 << 15;

/// Vertices of the page's narrow clusters so far, by number from 1 on. Grid lanes are relative to the origin,
/// modulo 2^16.
class VertexSlots
{
public:
    void clear(size_t blocks)
    {
        blocks_ = blocks;
        rows_.assign(1, VertexRow{});
        table_.assign(kDictionarySize, 0);
    }

    size_t count() const { return rows_.size(); }
    const VertexRow& operator[](size_t slot) const { return rows_[slot]; }

    uint64_t hash(const VertexRow& row) const
    {
        uint64_t hash = 0;
        for (size_t block = 0; block < blocks_; ++block)
        {
            const auto words = std::bit_cast<std::array<uint64_t, 2>>(row[block]);
            hash = (hash ^ words[0]) * 0x9E3779B97F4A7C15u;
            hash = (hash ^ hash >> 32 ^ words[1]) * 0x9E3779B97F4A7C15u;
        }
        return hash;
    }

    /// Return the number of the first equal vertex, or 0.
    size_t find(const VertexRow& row, uint64_t hash) const { return table_[place(row, hash)]; }

    void append(const VertexRow& row) { rows_.push_back(row); }

    /// Make the vertex findable, unless an equal one exists.
    void remember(size_t slot, uint64_t hash)
    {
        uint16_t& found = table_[place(rows_[slot], hash)];
        if (found == 0)
            found = static_cast<uint16_t>(slot);
    }

private:
    /// Return the table index of an equal vertex, or of its insertion.
    size_t place(const VertexRow& row, uint64_t hash) const
    {
        size_t at = hash >> (64 - std::bit_width(kDictionarySize - 1));
        while (table_[at] != 0 && std::memcmp(&rows_[table_[at]], &row, blocks_ * sizeof(Halves)) != 0)
            at = (at + 1) % kDictionarySize;
        return at;
    }

    size_t blocks_ = 0;
    std::vector<VertexRow> rows_;
    std::vector<uint16_t> table_;
};

/// Edge that predicts a new vertex (parallelogram prediction), as slots.
struct Edge
{
    size_t first, second, opposite;
};

/// Coding of the lanes, as masks.
struct LaneMasks
{
    VertexRow grid{}, bytes{};

    explicit LaneMasks(const VertexLanes& lanes)
    {
        for (size_t lane = 0; lane < lanes.count; ++lane)
        {
            const LaneKind kind = lanes.kinds[lane];
            grid[lane / kHalves][lane % kHalves] = kind == LaneKind::grid ? 0xFFFF : 0;
            bytes[lane / kHalves][lane % kHalves] = kind == LaneKind::bytes ? 0xFFFF : 0;
        }
    }
};

Halves zigzag(Halves value)
{
    return value << 1 ^ -(value >> 15);
}

struct Streams
{
    PageHeader header;
    std::array<std::vector<uint8_t>, 2> restarts, reuses;
    std::vector<uint8_t> codes, references_low, references_high, uv_bases, wide, more_lanes;
    std::array<std::vector<uint8_t>, 4> morphs;

    void clear()
    {
        header = {};
        for (auto* stream :
             {&restarts[0], &restarts[1], &reuses[0], &reuses[1], &codes, &references_low, &references_high,
              &uv_bases, &wide, &more_lanes, &morphs[0], &morphs[1], &morphs[2], &morphs[3]})
            stream->clear();
    }
};

void appendWords(std::vector<uint8_t>& to, std::span<const uint32_t> words)
{
    const auto* bytes = reinterpret_cast<const uint8_t*>(words.data());
    to.insert(to.end(), bytes, bytes + words.size_bytes());
}

} // namespace

class PageEncoder::State
{
public:
    std::vector<std::byte> encode(std::span<const ClusterRecord> records, uint32_t mesh_layout,
                                  std::span<CodedCluster> clusters,
                                  std::optional<std::span<const uint8_t>> codes)
    {
        codes_ = codes;
        lanes_ = vertexLanes(mesh_layout);
        masks_ = LaneMasks(lanes_);
        blocks_ = (lanes_.count + kHalves - 1) / kHalves;
        slots_.clear(blocks_);
        streams_.clear();
        planes_.clear(lanes_);
        last_reference_ = 0;
        for (size_t c = 0; c < clusters.size(); ++c)
            addCluster(c % 2, records[c], clusterVertexLayout(records[c], mesh_layout), clusters[c]);
        return compress();
    }

private:
    /// Cluster being encoded.
    struct ClusterState
    {
        size_t place; ///< parity in the page: even or odd
        bool wide;
        uint32_t words;      ///< words of a vertex
        uint32_t base_words; ///< words before the vertices
        size_t first_slot;
        std::array<VertexRow, kMaxClusterVertices> rows; ///< of its vertices, if it is narrow
        std::array<uint64_t, kMaxClusterVertices> hashes;
        std::array<uint16_t, kMaxClusterVertices> known; ///< slots of earlier clusters; 0: new
        std::array<int, kMaxClusterVertices> new_of_old;
        std::array<uint8_t, kMaxClusterVertices> old_of_new;
        size_t new_count;

        size_t slot(uint8_t vertex) const { return first_slot + static_cast<size_t>(new_of_old[vertex]); }
    };

    void addCluster(size_t place, const ClusterRecord& record, uint32_t layout, CodedCluster& cluster)
    {
        ClusterState& c = current_;
        c.place = place;
        c.wide = (layout & kVertexWideOffsets) != 0;
        c.words = vertexWords(layout);
        c.base_words = uvBaseWords(layout);
        c.first_slot = slots_.count();
        c.new_of_old.fill(-1);
        c.new_count = 0;
        const size_t vertices = record.vertex_count;
        if (c.wide)
            std::fill_n(c.known.begin(), vertices, uint16_t{0});
        else
            readRows(record, cluster);
        const auto steps = codes_ ? walk_.replay(cluster.indices, takeCodes(record.triangle_count))
                                  : walk_.walk(cluster.indices, std::span(c.known).first(vertices));
        static_cast<void>(addTriangle(steps[0]));
        for (size_t i = 1; i < steps.size(); i += 2)
        {
            const uint32_t code = addTriangle(steps[i]);
            const uint32_t next = i + 1 < steps.size() ? addTriangle(steps[i + 1]) : 0;
            streams_.codes.push_back(static_cast<uint8_t>(code | next << 4));
        }
        for (size_t v = 0; v < c.new_count && !c.wide; ++v)
            if (c.known[c.old_of_new[v]] == 0)
                slots_.remember(c.first_slot + v, c.hashes[c.old_of_new[v]]);
        reorder(steps, cluster);
        const auto words = std::span<const uint32_t>(cluster.words);
        appendWords(streams_.uv_bases, words.first(c.base_words));
        if (c.wide)
            appendWords(streams_.wide, words.subspan(c.base_words));
        for (const uint32_t word : cluster.morphs)
            for (size_t i = 0; i < streams_.morphs.size(); ++i)
                streams_.morphs[i].push_back(static_cast<uint8_t>(word >> 8 * i));
    }

    std::span<const uint8_t> takeCodes(uint32_t triangle_count)
    {
        const auto codes = codes_->first(codeBytes(triangle_count));
        codes_ = codes_->subspan(codes.size());
        return codes;
    }

    void readRows(const ClusterRecord& record, const CodedCluster& cluster)
    {
        VertexRow base{};
        for (size_t axis = 0; axis < 3; ++axis)
            base[0][axis] = static_cast<uint16_t>(record.base[axis]);
        size_t word = 0;
        for (size_t lane = 3; lane < lanes_.count; ++lane)
            if (lanes_.kinds[lane] == LaneKind::grid)
                base[lane / kHalves][lane % kHalves] = static_cast<uint16_t>(cluster.words[word++]);
        for (size_t v = 0; v < record.vertex_count; ++v)
        {
            VertexRow row{};
            std::memcpy(&row, &cluster.words[current_.base_words + v * current_.words],
                        size_t{current_.words} * 4);
            for (size_t block = 0; block < blocks_; ++block)
                row[block] += base[block];
            current_.rows[v] = row;
            current_.hashes[v] = slots_.hash(row);
            current_.known[v] = static_cast<uint16_t>(slots_.find(row, current_.hashes[v]));
        }
    }

    /// Add a triangle. Returns its code.
    uint32_t addTriangle(const WalkStep& step)
    {
        const auto [a, b, c] = step.corners;
        if (step.edge == kEdgeNone)
        {
            const size_t before = current_.first_slot + current_.new_count - 1;
            uint32_t kinds = addCorner(a, {before, before, before});
            const size_t slot_a = current_.slot(a);
            kinds |= addCorner(b, {slot_a, slot_a, slot_a}) << 2;
            const size_t slot_b = current_.slot(b);
            kinds |= addCorner(c, {slot_b, slot_b, slot_b}) << 4;
            streams_.restarts[current_.place].push_back(static_cast<uint8_t>(kinds));
            remember(step);
            return kCodeRestart;
        }
        size_t opposite = opposite_right_;
        if (step.edge == kEdgeLeft)
            opposite = opposite_left_;
        else if (step.edge == kEdgePopped)
        {
            opposite = kept_.back();
            kept_.pop_back();
        }
        else if (step.edge == kEdgeRightPushLeft)
            kept_.push_back(opposite_left_);
        const uint32_t kind = addCorner(c, {current_.slot(a), current_.slot(b), opposite});
        remember(step);
        return 3 * step.edge + kind;
    }

    void remember(const WalkStep& step)
    {
        opposite_right_ = current_.slot(step.corners[0]);
        opposite_left_ = current_.slot(step.corners[1]);
    }

    /// Add a corner. Returns formats::kCorner*.
    uint32_t addCorner(uint8_t vertex, const Edge& edge)
    {
        ClusterState& c = current_;
        if (c.new_of_old[vertex] >= 0)
        {
            streams_.reuses[c.place].push_back(static_cast<uint8_t>(edge.second - c.slot(vertex)));
            return kCornerReuse;
        }
        c.new_of_old[vertex] = static_cast<int>(c.new_count);
        c.old_of_new[c.new_count++] = vertex;
        if (c.wide)
            return kCornerNew;
        slots_.append(c.rows[vertex]);
        if (c.known[vertex] != 0)
        {
            addReference(c.known[vertex]);
            return kCornerReference;
        }
        planes_.add(computeResidual(c.rows[vertex], edge));
        return kCornerNew;
    }

    VertexRow computeResidual(const VertexRow& row, const Edge& edge) const
    {
        const VertexRow& first = slots_[edge.first];
        const VertexRow& second = slots_[edge.second];
        const VertexRow& opposite = slots_[edge.opposite];
        VertexRow residual;
        for (size_t i = 0; i < blocks_; ++i)
        {
            const Halves ahead = (first[i] - opposite[i]) & masks_.grid[i];
            const Halves left = row[i] - second[i] - ahead;
            residual[i] = (zigzag(left) & ~masks_.bytes[i]) | (left & masks_.bytes[i]);
        }
        return residual;
    }

    void addReference(size_t slot)
    {
        const uint16_t code = zigzag16(static_cast<uint16_t>(slot - last_reference_));
        streams_.references_low.push_back(static_cast<uint8_t>(code));
        streams_.references_high.push_back(static_cast<uint8_t>(code >> 8));
        last_reference_ = slot;
    }

    void reorder(std::span<const WalkStep> steps, CodedCluster& cluster)
    {
        const ClusterState& c = current_;
        HEARTH_ASSERT(c.base_words + c.new_count * c.words == cluster.words.size());
        unordered_ = cluster.words;
        for (size_t v = 0; v < c.new_count; ++v)
            std::memcpy(cluster.words.data() + c.base_words + v * c.words,
                        unordered_.data() + c.base_words + size_t{c.old_of_new[v]} * c.words,
                        size_t{c.words} * 4);
        reorderMorphs(cluster);
        auto index = cluster.indices.begin();
        for (const WalkStep& step : steps)
            for (const uint8_t corner : step.corners)
                *index++ = static_cast<uint8_t>(c.new_of_old[corner]);
    }

    void reorderMorphs(CodedCluster& cluster)
    {
        if (cluster.morphs.empty())
            return;
        unordered_ = cluster.morphs;
        const ClusterState& c = current_;
        const size_t targets = cluster.morphs[0];
        for (size_t target = 0; target < targets; ++target)
        {
            const size_t first = morphSectionWords(targets, 0) + target * c.new_count * 3;
            for (size_t v = 0; v < c.new_count; ++v)
                std::copy_n(unordered_.begin() + static_cast<ptrdiff_t>(first + 3 * size_t{c.old_of_new[v]}),
                            3, cluster.morphs.begin() + static_cast<ptrdiff_t>(first + 3 * v));
        }
    }

    std::vector<std::byte> compress()
    {
        PageHeader& header = streams_.header;
        for (size_t place = 0; place < 2; ++place)
        {
            header.restarts[place] = static_cast<uint16_t>(streams_.restarts[place].size());
            header.reuses[place] = static_cast<uint16_t>(streams_.reuses[place].size());
        }
        header.references = static_cast<uint16_t>(streams_.references_low.size());
        const LaneForms forms = planes_.make(header);
        std::copy_n(forms.planes.begin(), kHeaderLanes, header.planes);
        std::copy_n(forms.low_bits.begin(), kHeaderLanes, header.low_bits);
        if (moreLaneBytes(lanes_) != 0)
            for (const auto* numbers : {&forms.planes, &forms.low_bits})
                streams_.more_lanes.insert(streams_.more_lanes.end(), numbers->begin() + kHeaderLanes,
                                           numbers->end());
        blocks_of_streams_.clear();
        blocks_of_streams_.add({reinterpret_cast<const uint8_t*>(&header), sizeof(header)});
        for (const auto* stream :
             {&streams_.codes, &streams_.restarts[0], &streams_.restarts[1], &streams_.reuses[0],
              &streams_.reuses[1], &streams_.references_low, &streams_.references_high, &streams_.uv_bases,
              &streams_.wide, &streams_.more_lanes, &streams_.morphs[0], &streams_.morphs[1],
              &streams_.morphs[2], &streams_.morphs[3]})
            blocks_of_streams_.add(*stream);
        blocks_of_streams_.add(planes_.escapes());
        for (const auto& plane : planes_.planes())
            blocks_of_streams_.add(plane);
        return blocks_of_streams_.compress();
    }

    /// Stream codes of the page as it was stored, for the clusters that remain.
    std::optional<std::span<const uint8_t>> codes_;
    VertexLanes lanes_;
    LaneMasks masks_{VertexLanes{}};
    size_t blocks_ = 0; ///< vectors of a vertex
    VertexSlots slots_;
    TriangleWalk walk_;
    Streams streams_;
    PagePlanes planes_;
    EntropyBlocks blocks_of_streams_;
    ClusterState current_;
    std::vector<uint32_t> unordered_;
    size_t last_reference_ = 0;
    size_t opposite_right_ = 0;
    size_t opposite_left_ = 0;
    std::vector<size_t> kept_;
};

PageEncoder::PageEncoder() : state_(std::make_unique<State>()) {}
PageEncoder::PageEncoder(PageEncoder&&) noexcept = default;
PageEncoder& PageEncoder::operator=(PageEncoder&&) noexcept = default;
PageEncoder::~PageEncoder() = default;

std::vector<std::byte> PageEncoder::encode(std::span<const ClusterRecord> records, uint32_t mesh_layout,
                                           std::span<CodedCluster> clusters)
{
    return state_->encode(records, mesh_layout, clusters, std::nullopt);
}

std::vector<std::byte> PageEncoder::encodeAgain(std::span<const ClusterRecord> records, uint32_t mesh_layout,
                                                std::span<CodedCluster> clusters,
                                                std::span<const uint8_t> codes)
{
    return state_->encode(records, mesh_layout, clusters, codes);
}

} // namespace hearth::pages

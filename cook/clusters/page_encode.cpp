// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/page_encode.h"

#include "cook/clusters/entropy_blocks.h"
#include "cook/clusters/triangle_walk.h"
#include "formats/assert.h"
#include "formats/cluster_bounds.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace hearth::clusters
{

namespace
{

using namespace formats;

/// The lanes of a vertex; those of grids count from the origin, modulo 2^16.
using Lanes = std::array<uint16_t, kMaxLanes>;

constexpr size_t kDictionarySize = 1 << 15;

/// The vertices of the page's narrow clusters so far, by number from 1 on.
class Slots
{
public:
    void clear()
    {
        lanes_.assign(1, Lanes{});
        table_.assign(kDictionarySize, 0);
    }

    size_t count() const { return lanes_.size(); }
    const Lanes& operator[](size_t slot) const { return lanes_[slot]; }

    /// Number of the first equal vertex, or 0.
    size_t find(const Lanes& lanes) const
    {
        const size_t slot = table_[place(lanes)];
        return slot;
    }

    void append(const Lanes& lanes)
    {
        uint16_t& slot = table_[place(lanes)];
        if (slot == 0)
            slot = static_cast<uint16_t>(lanes_.size());
        lanes_.push_back(lanes);
    }

private:
    /// Where in the table an equal vertex is, or would be.
    size_t place(const Lanes& lanes) const
    {
        std::array<uint64_t, sizeof(Lanes) / 8> words;
        std::memcpy(words.data(), lanes.data(), sizeof(Lanes));
        uint64_t hash = 0;
        for (const uint64_t word : words)
            hash = (hash ^ word) * 0x9E3779B97F4A7C15u;
        size_t at = hash >> (64 - std::bit_width(kDictionarySize - 1));
        while (table_[at] != 0 && lanes_[table_[at]] != lanes)
            at = (at + 1) % kDictionarySize;
        return at;
    }

    std::vector<Lanes> lanes_;
    std::vector<uint16_t> table_;
};

struct Edge
{
    size_t first, second, opposite; ///< slots
};

uint16_t predict(LaneKind kind, uint16_t first, uint16_t second, uint16_t opposite)
{
    return kind == LaneKind::grid ? static_cast<uint16_t>(first + second - opposite) : second;
}

/// What is left of a lane, as a small number.
uint16_t residual(LaneKind kind, uint16_t value, uint16_t prediction)
{
    if (kind == LaneKind::bytes)
        return static_cast<uint16_t>(((value - prediction) & 0xFF) |
                                     ((value & 0xFF00) - (prediction & 0xFF00)));
    return zigzag16(static_cast<uint16_t>(value - prediction));
}

struct Streams
{
    PageHeader header;
    std::vector<uint8_t> codes, restarts, reuses, references_low, references_high, uv_bases, wide, escapes;
    std::array<std::vector<uint16_t>, kMaxLanes> residuals;
    std::vector<size_t> cluster_ends; ///< new vertices up to the end of each cluster

    void clear()
    {
        cluster_ends.clear();
        header = {};
        for (auto* stream :
             {&codes, &restarts, &reuses, &references_low, &references_high, &uv_bases, &wide, &escapes})
            stream->clear();
        for (auto& lane : residuals)
            lane.clear();
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
                                  std::span<CodedCluster> clusters)
    {
        lane_kinds_ = vertexLanes(mesh_layout);
        slots_.clear();
        streams_.clear();
        last_reference_ = 0;
        for (size_t c = 0; c < clusters.size(); ++c)
            addCluster(records[c], layoutOf(records[c], mesh_layout), clusters[c]);
        return compress();
    }

private:
    /// A cluster on its way through.
    struct Current
    {
        bool wide;
        uint32_t words;      ///< of a vertex
        uint32_t base_words; ///< in front of the vertices
        size_t first_slot;
        std::vector<Lanes> lanes; ///< of its vertices, if it is narrow
        std::vector<uint8_t> known;
        std::array<int, kClusterMaxVertices> new_of_old;
        std::vector<uint8_t> old_of_new;
        uint32_t last_reuse;
    };

    void addCluster(const ClusterRecord& record, uint32_t layout, CodedCluster& cluster)
    {
        current_.wide = (layout & kVertexWide) != 0;
        current_.words = vertexWords(layout);
        current_.base_words = uvBaseWords(layout);
        current_.first_slot = slots_.count();
        current_.new_of_old.fill(-1);
        current_.old_of_new.clear();
        current_.last_reuse = 0;
        current_.known.assign(record.vertex_count, 0);
        if (!current_.wide)
            readLanes(record, cluster);
        const auto steps = walk_.walk(cluster.indices, current_.known);
        std::vector<uint8_t> codes;
        for (const WalkStep& step : steps)
            codes.push_back(addTriangle(step));
        for (size_t i = 0; i < codes.size(); i += 2)
            streams_.codes.push_back(
                static_cast<uint8_t>(codes[i] | (i + 1 < codes.size() ? codes[i + 1] << 4 : 0)));
        streams_.cluster_ends.push_back(streams_.residuals[0].size());
        reorder(steps, cluster);
        const auto words = std::span<const uint32_t>(cluster.words);
        appendWords(streams_.uv_bases, words.first(current_.base_words));
        if (current_.wide)
            appendWords(streams_.wide, words.subspan(current_.base_words));
    }

    void readLanes(const ClusterRecord& record, const CodedCluster& cluster)
    {
        Lanes base{};
        for (size_t axis = 0; axis < 3; ++axis)
            base[axis] = static_cast<uint16_t>(record.base[axis]);
        size_t word = 0;
        for (size_t lane = 3; lane < lane_kinds_.count; ++lane)
            if (lane_kinds_.kinds[lane] == LaneKind::grid)
                base[lane] = static_cast<uint16_t>(cluster.words[word++]);
        current_.lanes.assign(record.vertex_count, Lanes{});
        for (size_t v = 0; v < record.vertex_count; ++v)
        {
            Lanes& lanes = current_.lanes[v];
            std::memcpy(lanes.data(), &cluster.words[current_.base_words + v * current_.words],
                        size_t{current_.words} * 4);
            for (size_t lane = 0; lane < lane_kinds_.count; ++lane)
                lanes[lane] = static_cast<uint16_t>(lanes[lane] + base[lane]);
            current_.known[v] = slots_.find(lanes) != 0 ? 1 : 0;
        }
    }

    /// Returns the triangle's code.
    uint8_t addTriangle(const WalkStep& step)
    {
        const auto slotOf = [&](uint8_t corner)
        { return current_.first_slot + static_cast<size_t>(current_.new_of_old[corner]); };
        const auto [a, b, c] = step.corners;
        if (step.edge == kEdgeNone)
        {
            const size_t before = slots_.count() - 1;
            uint32_t kinds = addCorner(a, {before, before, before});
            kinds |= addCorner(b, {slotOf(a), slotOf(a), slotOf(a)}) << 2;
            kinds |= addCorner(c, {slotOf(b), slotOf(b), slotOf(b)}) << 4;
            streams_.restarts.push_back(static_cast<uint8_t>(kinds));
            remember(step);
            return kCodeRestart;
        }
        size_t opposite = opposite_right_;
        if (step.edge == kEdgeLeft)
            opposite = opposite_left_;
        else if (step.edge == kEdgeKept)
        {
            opposite = kept_.back();
            kept_.pop_back();
        }
        else if (step.edge == kEdgeRightKeepLeft)
            kept_.push_back(opposite_left_);
        const uint32_t kind = addCorner(c, {slotOf(a), slotOf(b), opposite});
        remember(step);
        return static_cast<uint8_t>(3 * step.edge + kind);
    }

    void remember(const WalkStep& step)
    {
        opposite_right_ = current_.first_slot + static_cast<size_t>(current_.new_of_old[step.corners[0]]);
        opposite_left_ = current_.first_slot + static_cast<size_t>(current_.new_of_old[step.corners[1]]);
    }

    /// Returns formats::kCorner*.
    uint32_t addCorner(uint8_t vertex, const Edge& edge)
    {
        int& number = current_.new_of_old[vertex];
        if (number >= 0)
        {
            const auto reused = static_cast<uint32_t>(number);
            streams_.reuses.push_back(static_cast<uint8_t>(reused - current_.last_reuse));
            current_.last_reuse = reused;
            return kCornerReuse;
        }
        number = static_cast<int>(current_.old_of_new.size());
        current_.old_of_new.push_back(vertex);
        if (current_.wide)
            return kCornerNew;
        const Lanes& lanes = current_.lanes[vertex];
        const size_t known = slots_.find(lanes);
        slots_.append(lanes);
        if (known != 0 && known < current_.first_slot)
        {
            addReference(known);
            return kCornerReference;
        }
        for (size_t lane = 0; lane < lane_kinds_.count; ++lane)
        {
            const LaneKind kind = lane_kinds_.kinds[lane];
            const uint16_t prediction = predict(kind, slots_[edge.first][lane], slots_[edge.second][lane],
                                                slots_[edge.opposite][lane]);
            streams_.residuals[lane].push_back(residual(kind, lanes[lane], prediction));
        }
        return kCornerNew;
    }

    void addReference(size_t slot)
    {
        const uint16_t code = zigzag16(static_cast<uint16_t>(slot - last_reference_));
        streams_.references_low.push_back(static_cast<uint8_t>(code));
        streams_.references_high.push_back(static_cast<uint8_t>(code >> 8));
        last_reference_ = slot;
    }

    void reorder(std::span<const WalkStep> steps, CodedCluster& cluster) const
    {
        CodedCluster ordered;
        const auto words = cluster.words.begin();
        ordered.words.assign(words, words + current_.base_words);
        for (const uint8_t old : current_.old_of_new)
        {
            const auto vertex = words + static_cast<ptrdiff_t>(current_.base_words + old * current_.words);
            ordered.words.insert(ordered.words.end(), vertex, vertex + current_.words);
        }
        for (const WalkStep& step : steps)
            for (const uint8_t corner : step.corners)
                ordered.indices.push_back(static_cast<uint8_t>(current_.new_of_old[corner]));
        HEARTH_ASSERT(ordered.words.size() == cluster.words.size());
        cluster = std::move(ordered);
    }

    std::vector<std::byte> compress()
    {
        EntropyBlocks content;
        PageHeader& header = streams_.header;
        header.restarts = static_cast<uint16_t>(streams_.restarts.size());
        header.reuses = static_cast<uint16_t>(streams_.reuses.size());
        header.references = static_cast<uint16_t>(streams_.references_low.size());
        header.new_vertices = static_cast<uint16_t>(streams_.residuals[0].size());
        const size_t blocks = (lane_kinds_.count + kLanesOfBlock - 1) / kLanesOfBlock;
        for (size_t block = 0; block < blocks; ++block)
            setLowBits(block);
        for (size_t lane = 0; lane < lane_kinds_.count; ++lane)
            setPlanes(lane);
        collectEscapes();
        header.escapes = static_cast<uint32_t>(streams_.escapes.size() / 2);
        const auto* bytes = reinterpret_cast<const uint8_t*>(&header);
        content.add({bytes, sizeof(header)});
        for (const auto* stream :
             {&streams_.codes, &streams_.restarts, &streams_.reuses, &streams_.references_low,
              &streams_.references_high, &streams_.uv_bases, &streams_.wide, &streams_.escapes})
            content.add(*stream);
        for (const uint32_t part : {0u, 1u})
            for (size_t lane = 0; lane < lane_kinds_.count; ++lane)
                if (header.planes[lane] >> part & 1)
                    content.add(plane(lane, part));
        for (size_t block = 0; block < blocks; ++block)
            for (uint32_t part = 0; part < lowBitFields(header, block).planes(); ++part)
                content.add(lowBitsPlane(block, part));
        return content.compress();
    }

    bool hasBytes(size_t lane) const { return lane_kinds_.kinds[lane] == LaneKind::bytes; }

    bool escapes(size_t lane, uint32_t value) const
    {
        return !hasBytes(lane) && value >> streams_.header.low_bits[lane] >= kEscape;
    }

    void collectEscapes()
    {
        size_t first = 0;
        for (const size_t end : streams_.cluster_ends)
        {
            for (size_t block = 0; block < lane_kinds_.count; block += kLanesOfBlock)
                for (size_t v = first; v < end; ++v)
                    for (size_t lane = block;
                         lane < std::min<size_t>(block + kLanesOfBlock, lane_kinds_.count); ++lane)
                        if (const uint16_t value = streams_.residuals[lane][v]; escapes(lane, value))
                        {
                            streams_.escapes.push_back(static_cast<uint8_t>(value));
                            streams_.escapes.push_back(static_cast<uint8_t>(value >> 8));
                        }
            first = end;
        }
    }

    /// What a lane costs with each number of bits below the main byte: they take what they are, those above have a
    /// code.
    std::array<double, 9> costsOfLowBits(std::span<const uint16_t> residuals) const
    {
        std::array<double, 9> costs;
        for (uint32_t low_bits = 0; low_bits <= 8; ++low_bits)
        {
            Histogram mains{};
            for (const uint32_t value : residuals)
                ++mains[std::min<uint32_t>(value >> low_bits, kEscape)];
            costs[low_bits] =
                bitsOf(mains) + 16.0 * mains[kEscape] + low_bits * static_cast<double>(residuals.size());
        }
        return costs;
    }

    /// Of the lanes of a block: the cheapest, as long as they fit into its low bits; then as many as fill their bytes,
    /// for bytes that are full of low bits are stored as they are.
    void setLowBits(size_t block)
    {
        std::array<std::array<double, 9>, kLanesOfBlock> costs{};
        auto* const low_bits = streams_.header.low_bits + block * kLanesOfBlock;
        uint32_t sum = 0;
        std::vector<size_t> lanes;
        for (size_t i = 0; i < kLanesOfBlock && block * kLanesOfBlock + i < lane_kinds_.count; ++i)
        {
            const size_t lane = block * kLanesOfBlock + i;
            if (hasBytes(lane))
                continue;
            costs[i] = costsOfLowBits(streams_.residuals[lane]);
            const auto best = std::min_element(costs[i].begin(), costs[i].end());
            low_bits[i] = static_cast<uint8_t>(best - costs[i].begin());
            if (low_bits[i] == 8)
                continue;
            lanes.push_back(i);
            sum += low_bits[i];
        }
        const auto step = [&](int by)
        {
            const auto cost = [&](size_t i)
            { return costs[i][low_bits[i] + static_cast<size_t>(by)] - costs[i][low_bits[i]]; };
            size_t best = kLanesOfBlock;
            for (const size_t i : lanes)
                if (low_bits[i] + by >= 0 && low_bits[i] + by < 8 &&
                    (best == kLanesOfBlock || cost(i) < cost(best)))
                    best = i;
            low_bits[best] = static_cast<uint8_t>(low_bits[best] + by);
            sum += static_cast<uint32_t>(by);
        };
        while (sum > kMaxFieldBits)
            step(-1);
        while (sum % 8 != 0 && lanes.size() * 7 > sum)
            step(1);
    }

    void setPlanes(size_t lane)
    {
        for (const uint32_t part : {0u, 1u})
        {
            const auto bytes = plane(lane, part);
            if (std::any_of(bytes.begin(), bytes.end(), [](uint8_t byte) { return byte != 0; }))
                streams_.header.planes[lane] |= static_cast<uint8_t>(1u << part);
        }
    }

    /// Main bytes (part 0) or second bytes of a lane.
    std::vector<uint8_t> plane(size_t lane, uint32_t part) const
    {
        const bool bytes = hasBytes(lane);
        const uint32_t low_bits = streams_.header.low_bits[lane];
        std::vector<uint8_t> plane;
        plane.reserve(streams_.residuals[lane].size());
        for (const uint32_t value : streams_.residuals[lane])
        {
            if (bytes)
                plane.push_back(static_cast<uint8_t>(value >> (8 * part)));
            else if (escapes(lane, value))
                plane.push_back(part == 0 ? kEscape : uint8_t{0});
            else if (part == 0)
                plane.push_back(static_cast<uint8_t>(value >> low_bits));
            else
                plane.push_back(low_bits == 8 ? static_cast<uint8_t>(value) : uint8_t{0});
        }
        return plane;
    }

    /// The low bits of a block's lanes: their byte number `part`.
    std::vector<uint8_t> lowBitsPlane(size_t block, uint32_t part) const
    {
        const LowBitFields fields = lowBitFields(streams_.header, block);
        std::vector<uint8_t> plane(streams_.header.new_vertices);
        for (size_t v = 0; v < plane.size(); ++v)
        {
            uint32_t bits = 0;
            for (size_t i = 0; i < kLanesOfBlock; ++i)
                if (fields.mask[i] != 0)
                {
                    const uint32_t value = streams_.residuals[block * kLanesOfBlock + i][v];
                    bits |= (value & fields.mask[i]) << fields.first[i];
                }
            plane[v] = static_cast<uint8_t>(bits >> (8 * part));
        }
        return plane;
    }

    VertexLanes lane_kinds_;
    Slots slots_;
    TriangleWalk walk_;
    Streams streams_;
    Current current_;
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
    return state_->encode(records, mesh_layout, clusters);
}

} // namespace hearth::clusters

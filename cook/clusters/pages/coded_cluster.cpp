// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/pages/coded_cluster.h"

#include "cook/clusters/core/bounds.h"
#include "cook/clusters/core/uv_density.h"
#include "formats/base/assert.h"
#include "formats/codecs/cluster_bounds.h"
#include "formats/codecs/visibility_code.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace hearth::clusters
{

namespace
{

using namespace formats;

constexpr uint32_t kUvSets = 4;

/// Range of values, in steps of a grid.
struct StepRange
{
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    void add(double value)
    {
        low = std::min(low, value);
        high = std::max(high, value);
    }
};

/// Return the nearest point of the grid of steps 2^-n. Exact: a float times a power of two.
int32_t uvPoint(float coordinate, uint32_t fraction_bits)
{
    const auto steps_in_unit = static_cast<float>(1u << fraction_bits);
    return static_cast<int32_t>(std::nearbyint(coordinate * steps_in_unit));
}

/// True if all UVs of the set are in the range of the grid.
bool fitsGrid(const std::vector<Float2>& uvs, uint32_t fraction_bits)
{
    const double most = std::ldexp(static_cast<double>(kMaxGridCoordinate), -static_cast<int>(fraction_bits));
    return std::all_of(uvs.begin(), uvs.end(),
                       [&](Float2 uv) { return std::abs(uv.x) < most && std::abs(uv.y) < most; });
}

/// True unless 8 bits hold every colour of the source to a sixteenth of their step, as for colours that came
/// from 8 bits.
bool needsFineColors(const PreparedMesh& mesh)
{
    const auto coarse = [](float part)
    {
        const float code = std::clamp(part, 0.0f, 1.0f) * 255;
        return std::abs(code - std::round(code)) < 1.0f / 16;
    };
    const auto& colors = mesh.vertices.colors;
    return std::any_of(mesh.corners.begin(), mesh.corners.end(),
                       [&](VertexId vertex)
                       {
                           const Float4 c = colors[toIndex(vertex)];
                           return !(coarse(c.x) && coarse(c.y) && coarse(c.z) && coarse(c.w));
                       });
}

/// Encodes the vertices of a cluster to words, and merges equal ones.
class ClusterCoder
{
public:
    ClusterCoder(const PreparedMesh& mesh, std::span<const VertexId> vertices, uint32_t mesh_layout)
        : mesh_(mesh),
          source_(mesh.vertices),
          steps_(1 / mesh.grid.step),
          vertices_(vertices),
          layout_(mesh_layout)
    {
    }

    /// True if the UVs of the cluster span more than 16 bits.
    bool hasWideUvs()
    {
        for (uint32_t set = 0; set < kUvSets; ++set)
        {
            const uint32_t bits = uvFractionBits(layout_, set);
            if (bits == 0)
                continue;
            StepRange u, v;
            for (const VertexId vertex : vertices_)
            {
                const Float2 uv = source_.uvs[set][toIndex(vertex)];
                u.add(uvPoint(uv.x, bits));
                v.add(uvPoint(uv.y, bits));
            }
            uv_base_[set] = {static_cast<int32_t>(u.low), static_cast<int32_t>(v.low)};
            spread_ =
                spread_ || std::max(u.high - u.low, v.high - v.low) > static_cast<double>(kMaxNarrowOffset);
        }
        return spread_;
    }

    CodedCluster code(const ClusterRecord& record, std::span<const uint8_t> indices)
    {
        layout_ = clusterVertexLayout(record, layout_);
        vertex_words_ = vertexWords(layout_);
        CodedCluster cluster;
        cluster.words.resize(uvBaseWords(layout_) + vertices_.size() * vertex_words_);
        findTargets();
        uint32_t* word = cluster.words.data();
        for (uint32_t set = 0; set < kUvSets; ++set)
            if (uvFractionBits(layout_, set) != 0)
                for (const int32_t base : uv_base_[set])
                    *word++ = static_cast<uint32_t>(base);
        std::array<uint8_t, kMaxClusterVertices> new_of_old;
        for (size_t i = 0; i < vertices_.size(); ++i)
            new_of_old[i] = static_cast<uint8_t>(findOrAppend(record, toIndex(vertices_[i]), word));
        cluster.words.resize(uvBaseWords(layout_) + count_ * vertex_words_);
        cluster.morphs = morphSection();
        cluster.indices.resize(indices.size());
        for (size_t i = 0; i < indices.size(); ++i)
            cluster.indices[i] = new_of_old[indices[i]];
        return cluster;
    }

private:
    /// Write the vertex at `words` unless an equal one is there. Returns its number.
    size_t findOrAppend(const ClusterRecord& record, uint32_t vertex, uint32_t* words)
    {
        uint32_t* const added = words + count_ * vertex_words_;
        writeVertex(record, vertex, added);
        const std::span<uint32_t> deltas = vertexDeltas(count_);
        writeDeltas(vertex, deltas);
        uint64_t hash = 0;
        for (size_t i = 0; i < vertex_words_; ++i)
            hash = (hash ^ added[i]) * 0x9E3779B97F4A7C15u;
        for (const uint32_t delta : deltas)
            hash = (hash ^ delta) * 0x9E3779B97F4A7C15u;
        for (size_t slot = hash >> 55;; slot = (slot + 1) % slots_.size())
        {
            if (slots_[slot] == 0)
            {
                slots_[slot] = static_cast<uint16_t>(++count_);
                return count_ - 1;
            }
            const size_t known = slots_[slot] - size_t{1};
            const uint32_t* const other = words + known * vertex_words_;
            if (std::equal(other, other + vertex_words_, added) &&
                std::ranges::equal(vertexDeltas(known), deltas))
                return known;
        }
    }

    void writeVertex(const ClusterRecord& record, uint32_t vertex, uint32_t* words) const
    {
        uint32_t offset[3];
        for (int axis = 0; axis < 3; ++axis)
            offset[axis] = static_cast<uint32_t>(
                static_cast<int32_t>(source_.positions[vertex][axis] * steps_) - record.base[axis]);
        const uint32_t normal =
            (layout_ & kVertexNormal) ? encodeNormal(layout_, source_.normals[vertex]) : 0;
        const bool shared_word = attributeWord(layout_, kVertexNormal) == 1;
        if (layout_ & kVertexWideOffsets)
            words = std::copy_n(offset, 3, words);
        else
        {
            *words++ = offset[0] | offset[1] << 16;
            *words++ = offset[2] | (shared_word ? normal << 16 : 0);
        }
        if ((layout_ & kVertexNormal) && !shared_word)
            *words++ = normal;
        if (layout_ & kVertexTangent)
            *words++ = encodeTangent(layout_, source_.tangents[vertex], decodeNormal(layout_, normal));
        for (uint32_t set = 0; set < kUvSets; ++set)
            if (layout_ & kVertexUv0 << set)
                words = writeUv(set, source_.uvs[set][vertex], words);
        if (layout_ & kVertexColor)
        {
            const std::array<uint32_t, 2> color = encodeColor(layout_, source_.colors[vertex]);
            words = std::copy_n(color.begin(), (layout_ & kVertexColor16) ? 2 : 1, words);
        }
        if (layout_ & kVertexVisibility)
            *words++ = kVisibilityUnoccluded;
        if (layout_ & kVertexInfluences)
            writeInfluences(vertex, words);
    }

    void writeInfluences(uint32_t vertex, uint32_t* words) const
    {
        const size_t sets = source_.joint_sets.size();
        for (size_t set = 0; set < sets; ++set)
        {
            const auto& joint = source_.joint_sets[set][vertex].joint;
            *words++ = joint[0] | uint32_t{joint[1]} << 16;
            *words++ = joint[2] | uint32_t{joint[3]} << 16;
        }
        for (size_t set = 0; set < sets; ++set)
        {
            const Float4 weights = source_.weight_sets[set][vertex];
            *words++ = quantizeUnorm(weights.x, 65535) | quantizeUnorm(weights.y, 65535) << 16;
            *words++ = quantizeUnorm(weights.z, 65535) | quantizeUnorm(weights.w, 65535) << 16;
        }
    }

    /// Find the targets that move a vertex of the cluster.
    void findTargets()
    {
        for (uint32_t target = 0; target < source_.morph_targets.size(); ++target)
        {
            const mesh::MorphTarget& morph = source_.morph_targets[target];
            const bool moves = std::any_of(
                vertices_.begin(), vertices_.end(),
                [&](VertexId vertex) { return deltaWords(morph, target, toIndex(vertex)) != DeltaWords{}; });
            if (moves)
                targets_.push_back(target);
        }
        deltas_.resize(vertices_.size() * 3 * targets_.size());
    }

    using DeltaWords = std::array<uint32_t, 3>;

    DeltaWords deltaWords(const mesh::MorphTarget& morph, uint32_t target, uint32_t vertex) const
    {
        const float step = mesh_.morph_steps[target];
        DeltaWords words;
        for (int axis = 0; axis < 3; ++axis)
        {
            const auto position = static_cast<int32_t>(std::lround(morph.positions[vertex][axis] / step));
            const long normal =
                morph.normals.empty() ? 0 : std::lround(morph.normals[vertex][axis] * kMorphNormalSteps);
            words[static_cast<size_t>(axis)] =
                packMorphDelta(position, static_cast<int32_t>(std::clamp(normal, -2047L, 2047L)));
        }
        return words;
    }

    /// Return the deltas of one of the cluster's vertices, by target.
    std::span<uint32_t> vertexDeltas(size_t number)
    {
        return std::span(deltas_).subspan(number * 3 * targets_.size(), 3 * targets_.size());
    }

    void writeDeltas(uint32_t vertex, std::span<uint32_t> words) const
    {
        for (size_t i = 0; i < targets_.size(); ++i)
            std::ranges::copy(deltaWords(source_.morph_targets[targets_[i]], targets_[i], vertex),
                              words.begin() + static_cast<ptrdiff_t>(3 * i));
    }

    std::vector<uint32_t> morphSection()
    {
        if (source_.morph_targets.empty())
            return {};
        std::vector<uint32_t> section{static_cast<uint32_t>(targets_.size())};
        for (const uint32_t target : targets_)
        {
            section.push_back(target);
            section.push_back(std::bit_cast<uint32_t>(mesh_.morph_steps[target]));
        }
        for (size_t i = 0; i < targets_.size(); ++i)
            for (size_t v = 0; v < count_; ++v)
            {
                const auto words = vertexDeltas(v).subspan(3 * i, 3);
                section.insert(section.end(), words.begin(), words.end());
            }
        return section;
    }

    /// Write UVs. Returns the position behind them.
    uint32_t* writeUv(uint32_t set, Float2 uv, uint32_t* words) const
    {
        const uint32_t bits = uvFractionBits(layout_, set);
        if (bits == 0)
        {
            *words++ = std::bit_cast<uint32_t>(uv.x);
            *words++ = std::bit_cast<uint32_t>(uv.y);
            return words;
        }
        const auto u = static_cast<uint32_t>(uvPoint(uv.x, bits) - uv_base_[set][0]);
        const auto v = static_cast<uint32_t>(uvPoint(uv.y, bits) - uv_base_[set][1]);
        if (layout_ & kVertexWideOffsets)
        {
            *words++ = u;
            *words++ = v;
        }
        else
            *words++ = u | v << 16;
        return words;
    }

    const PreparedMesh& mesh_;
    const mesh::SourceMesh& source_;
    double steps_; ///< steps of the grid in a unit; a power of two
    std::span<const VertexId> vertices_;
    uint32_t layout_;
    size_t vertex_words_ = 0;
    std::array<std::array<int32_t, 2>, kUvSets> uv_base_{};
    bool spread_ = false;
    std::array<uint16_t, 512> slots_{}; ///< 1 + number of a vertex, by its hash; 0: free
    size_t count_ = 0;
    std::vector<uint32_t> targets_; ///< morph targets that move a vertex of the cluster
    std::vector<uint32_t> deltas_;  ///< for each vertex and each of these targets
};

/// Return the code of the cluster's density: of the UV sets that its material reads that of the one with the
/// fewest UV units a metre, which wants finer mips. 0 without such UVs or area.
uint8_t findUvDensity(const PreparedMesh& mesh, uint32_t material, std::span<const VertexId> vertices,
                      std::span<const uint8_t> indices, std::span<const Float3> places)
{
    constexpr uint32_t kAllSets = (1u << kUvSets) - 1;
    const uint32_t sets = material < mesh.read_uv_sets.size() ? mesh.read_uv_sets[material] : kAllSets;
    uint8_t code = 0;
    std::vector<Float2> uvs(indices.size());
    for (uint32_t set = 0; set < kUvSets; ++set)
    {
        if ((mesh.attributes & kVertexUv0 << set) == 0 || (sets >> set & 1) == 0)
            continue;
        for (size_t i = 0; i < indices.size(); ++i)
            uvs[i] = mesh.vertices.uvs[set][toIndex(vertices[indices[i]])];
        const uint8_t own = encodeUvDensity(measureUvDensity(places, uvs));
        code = code == 0 ? own : std::min(code, own);
    }
    return code;
}

} // namespace

uint32_t chooseLayout(const PreparedMesh& mesh, const Config& config)
{
    HEARTH_ASSERT(config.uv_fraction_bits >= 1 && config.uv_fraction_bits <= 15);
    HEARTH_ASSERT(config.normal_bits == 0 || config.normal_bits == 8 || config.normal_bits == 16);
    uint32_t layout = mesh.attributes;
    if ((layout & kVertexNormal) == 0)
        layout &= ~uint32_t{kVertexTangent | kVertexVisibility};
    else if (config.normal_bits == 16 || (config.normal_bits == 0 && mesh.gently_curved))
        layout |= kVertexNormal16;
    for (uint32_t set = 0; set < kUvSets; ++set)
        if ((layout & kVertexUv0 << set) && fitsGrid(mesh.vertices.uvs[set], config.uv_fraction_bits))
            layout |= config.uv_fraction_bits << (kVertexUvStepShift + 4 * set);
    if ((layout & kVertexColor) && needsFineColors(mesh))
        layout |= kVertexColor16;
    return layout;
}

CodedCluster codeCluster(const PreparedMesh& mesh, const ClusterStore& store, const ClusterShape& shape,
                         uint32_t layout, ClusterRecord& record)
{
    const auto vertices = store.clusterVertices(shape);
    const auto indices = store.clusterIndices(shape);
    HEARTH_ASSERT(!indices.empty() && !vertices.empty() && vertices.size() <= kMaxClusterVertices);
    std::vector<Float3> points(vertices.size()), places(indices.size());
    for (size_t i = 0; i < vertices.size(); ++i)
        points[i] = mesh.positions()[vertices[i]];
    for (size_t i = 0; i < indices.size(); ++i)
        places[i] = points[indices[i]];
    ClusterCoder coder(mesh, store.clusterVertices(shape), layout);
    setBounds(record, mesh.grid.step, points, places, coder.hasWideUvs());
    CodedCluster cluster = coder.code(record, store.clusterIndices(shape));
    const size_t vertex_words = cluster.words.size() - uvBaseWords(layout);
    record.vertex_count =
        static_cast<uint16_t>(vertex_words / vertexWords(clusterVertexLayout(record, layout)));
    record.triangle_count = static_cast<uint8_t>(shape.triangle_count);
    record.uv_density = findUvDensity(mesh, record.material, vertices, indices, places);
    HEARTH_ASSERT(record.vertex_count > 0 && record.vertex_count <= vertices.size());
    HEARTH_ASSERT(record.triangle_count == shape.triangle_count);
    return cluster;
}

} // namespace hearth::clusters

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/mesh/weld.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace hearth::mesh
{

namespace
{

constexpr uint32_t kEmpty = 0xFFFFFFFFu;

uint64_t mix(uint64_t h)
{
    // finaliser of splitmix64 (S. Vigna): neighbouring coordinates spread over the whole table
    h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9u;
    h = (h ^ (h >> 27)) * 0x94D049BB133111EBu;
    return h ^ (h >> 31);
}

/// Open-addressing hash set of element indices; the caller provides hash and equality.
class IndexSet
{
public:
    explicit IndexSet(size_t count) : slots_(std::bit_ceil(count * 2 + 1), kEmpty) {}

    /// Return the element that equals `index`; `index` itself if it is new.
    template <typename Equal>
    uint32_t findOrInsert(uint32_t index, uint64_t hash, Equal equal)
    {
        const size_t mask = slots_.size() - 1;
        for (size_t slot = hash & mask;; slot = (slot + 1) & mask)
        {
            if (slots_[slot] == kEmpty)
                return slots_[slot] = index;
            if (equal(slots_[slot], index))
                return slots_[slot];
        }
    }

    /// Prefetch the slot that findOrInsert reads first.
    void prefetch(uint64_t hash) const { __builtin_prefetch(&slots_[hash & (slots_.size() - 1)], 1); }

private:
    std::vector<uint32_t> slots_;
};

/// Call visit(index, hash) for all indices in order, prefetching the slots of the next ones: the set is
/// larger than any cache, and accesses are scattered.
template <typename HashVertex, typename Visit>
void forEachHashed(const IndexSet& set, size_t count, HashVertex hashVertex, Visit visit)
{
    constexpr size_t kAhead = 32;
    std::array<uint64_t, kAhead> hashes;
    for (size_t first = 0; first < count; first += kAhead)
    {
        const size_t size = std::min(kAhead, count - first);
        for (size_t i = 0; i < size; ++i)
        {
            hashes[i] = hashVertex(static_cast<uint32_t>(first + i));
            set.prefetch(hashes[i]);
        }
        for (size_t i = 0; i < size; ++i)
            visit(static_cast<uint32_t>(first + i), hashes[i]);
    }
}

/// Array of a mesh as rows of bytes.
struct ByteRows
{
    const std::byte* data;
    size_t size;

    const std::byte* operator[](uint32_t row) const { return data + row * size; }
};

template <typename T>
void addRows(std::vector<ByteRows>& rows, const std::vector<T>& values)
{
    if (!values.empty())
        rows.push_back({reinterpret_cast<const std::byte*>(values.data()), sizeof(T)});
}

std::vector<ByteRows> allRows(const SourceMesh& mesh)
{
    std::vector<ByteRows> rows;
    addRows(rows, mesh.positions);
    addRows(rows, mesh.normals);
    addRows(rows, mesh.tangents);
    for (const auto& uv : mesh.uvs)
        addRows(rows, uv);
    addRows(rows, mesh.colors);
    for (const auto& set : mesh.joint_sets)
        addRows(rows, set);
    for (const auto& set : mesh.weight_sets)
        addRows(rows, set);
    for (const MorphTarget& target : mesh.morph_targets)
    {
        addRows(rows, target.positions);
        addRows(rows, target.normals);
        addRows(rows, target.tangents);
    }
    return rows;
}

uint64_t hashRow(const std::byte* row, size_t size, uint64_t hash)
{
    // every array's element is a multiple of four bytes
    for (size_t i = 0; i < size; i += sizeof(uint32_t))
    {
        uint32_t word;
        std::memcpy(&word, row + i, sizeof(word));
        hash = (hash ^ word) * 0x9E3779B97F4A7C15u;
        hash ^= hash >> 32;
    }
    return hash;
}

} // namespace

Weld weldPositions(std::span<const Float3> positions)
{
    Weld weld;
    weld.position_id_of_vertex.resize(positions.size());
    IndexSet set(positions.size());
    const auto equal = [&](uint32_t a, uint32_t b) { return positions[a] == positions[b]; };
    const auto hashVertex = [&](uint32_t vertex)
    {
        const Float3 p = positions[vertex] + Float3{}; // -0 + 0 = +0
        const uint64_t xy = std::bit_cast<uint32_t>(p.x) | uint64_t{std::bit_cast<uint32_t>(p.y)} << 32;
        return mix(mix(xy) + std::bit_cast<uint32_t>(p.z));
    };
    forEachHashed(set, positions.size(), hashVertex,
                  [&](uint32_t vertex, uint64_t hash)
                  {
                      const uint32_t first = set.findOrInsert(vertex, hash, equal);
                      weld.position_id_of_vertex[vertex] =
                          first == vertex ? weld.position_count++ : weld.position_id_of_vertex[first];
                  });
    return weld;
}

std::vector<uint32_t> firstEqualVertices(const SourceMesh& mesh)
{
    const std::vector<ByteRows> rows = allRows(mesh);
    std::vector<uint32_t> first(mesh.vertexCount());
    IndexSet set(mesh.vertexCount());
    const auto equal = [&](uint32_t a, uint32_t b)
    {
        for (const ByteRows& array : rows)
            if (std::memcmp(array[a], array[b], array.size) != 0)
                return false;
        return true;
    };
    const auto hashVertex = [&](uint32_t vertex)
    {
        uint64_t hash = 0;
        for (const ByteRows& array : rows)
            hash = hashRow(array[vertex], array.size, hash);
        return mix(hash);
    };
    forEachHashed(set, first.size(), hashVertex,
                  [&](uint32_t vertex, uint64_t hash)
                  { first[vertex] = set.findOrInsert(vertex, hash, equal); });
    return first;
}

} // namespace hearth::mesh

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/scene/level_meshes.h"

#include "formats/base/assert.h"

#include <bit>
#include <cmath>
#include <tbb/parallel_for.h>

namespace hearth::visibility
{

using namespace formats;

namespace
{

// Default of LevelMesh::reach (stored as 0), in diagonals.
constexpr float kDefaultReach = 0.05f;

/// Hash table of the vertices of a level by position and normal: bit-identical vertices look alike in any
/// cut.
class VertexTable
{
public:
    VertexTable() = default;

    /// Number the vertices, and fill `level.first_copy`. Refers to the arrays of the level, which must not be
    /// changed.
    explicit VertexTable(LevelArrays& level)
        : positions_(level.positions),
          normals_(level.normals),
          slots_(std::bit_ceil(level.positions.size() * 2 + 1), kInvalidIndex)
    {
        level.first_copy.reserve(level.positions.size());
        for (uint32_t v = 0; v < level.positions.size(); ++v)
        {
            uint32_t& slot = slots_[findSlot(positions_[v], normals_[v])];
            if (slot == kInvalidIndex)
                slot = v;
            level.first_copy.push_back(slot);
        }
    }

    /// Return the first vertex with this position and normal, or kInvalidIndex.
    uint32_t find(Float3 position, Float3 normal) const { return slots_[findSlot(position, normal)]; }

private:
    /// Return the slot of a vertex, or the free one where it belongs.
    size_t findSlot(Float3 position, Float3 normal) const
    {
        uint64_t hash = 0;
        for (const Float3& v : {position, normal})
            for (int axis = 0; axis < 3; ++axis)
            {
                hash = (hash ^ std::bit_cast<uint32_t>(v[axis])) * 0x9E3779B97F4A7C15u;
                hash ^= hash >> 32;
            }
        size_t slot = hash & (slots_.size() - 1);
        while (slots_[slot] != kInvalidIndex &&
               !(positions_[slots_[slot]] == position && normals_[slots_[slot]] == normal))
            slot = (slot + 1) & (slots_.size() - 1);
        return slot;
    }

    std::span<const Float3> positions_, normals_;
    std::vector<uint32_t> slots_; ///< a power of two
};

bool isDrawnAt(const PackView& part, const ClusterRecord& cluster, uint32_t level)
{
    return cluster.level == level ||
           (cluster.level < level && std::isinf(part.groups()[cluster.group].error));
}

void addCluster(LevelArrays& arrays, const MeshPages& pages, uint32_t number)
{
    const ClusterGeometry geometry = pages.cluster(number);
    const auto first = static_cast<uint32_t>(arrays.positions.size());
    arrays.parts.push_back({number, first});
    for (uint32_t v = 0; v < geometry.vertexCount(); ++v)
    {
        arrays.positions.push_back(geometry.position(v));
        if (geometry.has(kVertexNormal))
            arrays.normals.push_back(geometry.normal(v));
    }
    for (uint32_t t = 0; t < geometry.triangleCount(); ++t)
        for (const uint32_t corner : geometry.triangle(t))
            arrays.indices.push_back(first + corner);
    arrays.triangle_materials.insert(arrays.triangle_materials.end(), geometry.triangleCount(),
                                     pages.part().clusters()[number].material);
}

/// Link vertices to equal ones of the finer level: cuts that mix levels meet in vertices of both.
void linkToFiner(LevelArrays& level, const VertexTable& finer)
{
    level.finer_vertex.reserve(level.positions.size());
    for (size_t v = 0; v < level.positions.size(); ++v)
        level.finer_vertex.push_back(finer.find(level.positions[v], level.normals[v]));
}

} // namespace

Result<MeshPages> MeshPages::read(const PackView& part, uint32_t mesh)
{
    return decode(part, mesh, std::vector<bool>(part.meshes()[mesh].pages.count, true));
}

Result<MeshPages> MeshPages::readLevel(const PackView& part, uint32_t mesh, uint32_t level)
{
    const MeshRecord& record = part.meshes()[mesh];
    std::vector<bool> is_needed(record.pages.count, false);
    for (const ClusterRecord& cluster : recordsInRange(part.clusters(), record.clusters))
        if (isDrawnAt(part, cluster, level))
            is_needed[cluster.page - record.pages.first] = true;
    return decode(part, mesh, is_needed);
}

Result<MeshPages> MeshPages::decode(const PackView& part, uint32_t mesh, const std::vector<bool>& is_needed)
{
    MeshPages pages;
    pages.part_ = &part;
    pages.record_ = &part.meshes()[mesh];
    pages.pages_.resize(pages.record_->pages.count);
    std::vector<Status> statuses(pages.pages_.size(), success());
    tbb::parallel_for(size_t{0}, pages.pages_.size(),
                      [&](size_t i)
                      {
                          if (!is_needed[i])
                              return;
                          auto page = part.decodePage(pages.record_->pages.first + static_cast<uint32_t>(i));
                          if (page.ok())
                              pages.pages_[i] = std::move(*page);
                          else
                              statuses[i] = page.error();
                      });
    for (Status& end : statuses)
        HEARTH_TRY(std::move(end));
    return pages;
}

ClusterGeometry MeshPages::cluster(uint32_t number) const
{
    const ClusterRecord& record = part_->clusters()[number];
    const auto geometry = ClusterGeometry::at(pages_[record.page - record_->pages.first], record, *record_);
    HEARTH_ASSERT(geometry.has_value()); // checked by checkHierarchy
    return *geometry;
}

std::vector<uint64_t> countLevelTriangles(const PackView& part, uint32_t mesh)
{
    const MeshRecord& record = part.meshes()[mesh];
    std::vector<uint64_t> counts(record.lod_count, 0);
    for (uint32_t c = record.clusters.first; c < record.clusters.first + record.clusters.count; ++c)
    {
        const ClusterRecord& cluster = part.clusters()[c];
        for (uint32_t level = cluster.level; level < record.lod_count && isDrawnAt(part, cluster, level);
             ++level)
            counts[level] += cluster.triangle_count;
    }
    return counts;
}

LevelArrays extractLevel(const MeshPages& pages, uint32_t level)
{
    const MeshRecord& mesh = pages.record();
    LevelArrays arrays;
    for (uint32_t c = mesh.clusters.first; c < mesh.clusters.first + mesh.clusters.count; ++c)
        if (isDrawnAt(pages.part(), pages.part().clusters()[c], level))
            addCluster(arrays, pages, c);
    // far from the root, the default reach exceeds the deviation of the coarse surface
    const float max_deviation = 2 * pages.part().levels()[mesh.levels.first + level].max_error;
    if (max_deviation > kDefaultReach * length(mesh.box_max - mesh.box_min))
        arrays.reach = max_deviation;
    return arrays;
}

std::vector<LevelArrays> extractLevels(const MeshPages& pages)
{
    std::vector<LevelArrays> levels;
    VertexTable finer;
    for (uint32_t level = 0; level < pages.record().lod_count; ++level)
    {
        LevelArrays& arrays = levels.emplace_back(extractLevel(pages, level));
        if (level > 0)
            linkToFiner(arrays, finer);
        finer = VertexTable(arrays);
    }
    return levels;
}

} // namespace hearth::visibility

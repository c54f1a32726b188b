// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/scene/level_meshes.h"

#include "formats/base/assert.h"

#include <bit>
#include <cmath>
#include <tbb/parallel_for.h>
#include <unordered_map>

namespace hearth::visibility
{

using namespace formats;

namespace
{

// Default of LevelMesh::reach (stored as 0), in diagonals.
constexpr float kDefaultReach = 0.05f;

/// Vertex as position and normal: bit-identical vertices look alike in any cut.
struct VertexKey
{
    Float3 position;
    Float3 normal;
    friend bool operator==(const VertexKey&, const VertexKey&) = default;
};

struct KeyHash
{
    size_t operator()(const VertexKey& key) const
    {
        uint64_t hash = 0;
        for (const Float3& v : {key.position, key.normal})
            for (int axis = 0; axis < 3; ++axis)
            {
                hash = (hash ^ std::bit_cast<uint32_t>(v[axis])) * 0x9E3779B97F4A7C15u;
                hash ^= hash >> 32;
            }
        return hash;
    }
};

using VertexIdMap = std::unordered_map<VertexKey, uint32_t, KeyHash>;

VertexIdMap numberVertices(const LevelArrays& level)
{
    VertexIdMap numbers;
    numbers.reserve(level.positions.size());
    for (uint32_t v = 0; v < level.positions.size(); ++v)
        numbers.emplace(VertexKey{level.positions[v], level.normals[v]}, v);
    return numbers;
}

bool isDrawnAt(const PackView& part, const ClusterRecord& cluster, uint32_t level)
{
    return cluster.level == level ||
           (cluster.level < level && std::isinf(part.groups()[cluster.group].error));
}

void addCluster(LevelArrays& arrays, const MeshPages& pages, uint32_t number, bool with_materials)
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
    if (with_materials)
        arrays.triangle_materials.insert(arrays.triangle_materials.end(), geometry.triangleCount(),
                                         pages.part().clusters()[number].material);
}

LevelArrays extractLevel(const MeshPages& pages, uint32_t level)
{
    const MeshRecord& mesh = pages.record();
    LevelArrays arrays;
    for (uint32_t c = mesh.clusters.first; c < mesh.clusters.first + mesh.clusters.count; ++c)
        if (isDrawnAt(pages.part(), pages.part().clusters()[c], level))
            addCluster(arrays, pages, c, level == 0);
    // far from the root, the default reach exceeds the deviation of the coarse surface
    const float max_deviation = 2 * pages.part().levels()[mesh.levels.first + level].max_error;
    if (max_deviation > kDefaultReach * length(mesh.box_max - mesh.box_min))
        arrays.reach = max_deviation;
    return arrays;
}

/// Link vertices to equal ones of the finer level: cuts that mix levels meet in vertices of both.
void linkToFiner(LevelArrays& level, const VertexIdMap& finer)
{
    level.finer_vertex.reserve(level.positions.size());
    for (size_t v = 0; v < level.positions.size(); ++v)
    {
        const auto found = finer.find({level.positions[v], level.normals[v]});
        level.finer_vertex.push_back(found == finer.end() ? kInvalidIndex : found->second);
    }
}

} // namespace

Result<MeshPages> MeshPages::read(const PackView& part, uint32_t mesh)
{
    MeshPages pages;
    pages.part_ = &part;
    pages.record_ = &part.meshes()[mesh];
    pages.pages_.resize(pages.record_->pages.count);
    std::vector<Status> statuses(pages.pages_.size(), success());
    tbb::parallel_for(size_t{0}, pages.pages_.size(),
                      [&](size_t i)
                      {
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

LevelArrays extractFinestLevel(const MeshPages& pages)
{
    return extractLevel(pages, 0);
}

std::vector<LevelArrays> extractLevels(const MeshPages& pages)
{
    std::vector<LevelArrays> levels;
    VertexIdMap finer;
    for (uint32_t level = 0; level < pages.record().lod_count; ++level)
    {
        levels.push_back(extractLevel(pages, level));
        if (level > 0)
            linkToFiner(levels.back(), finer);
        finer = numberVertices(levels.back());
    }
    return levels;
}

} // namespace hearth::visibility

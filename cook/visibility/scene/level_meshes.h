// Extracts the meshes that uniform cuts through a cluster hierarchy draw from the pages of a clusters part.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/fit/level_fit.h"
#include "formats/pack/pack_view.h"

#include <vector>

namespace hearth::visibility
{

/// Decoded pages of one mesh. The view must outlive it.
class MeshPages
{
public:
    /// Decode the pages of a mesh.
    /// errors: those of PackView::decodePage, those of formats::checkHierarchy for tables; meaning_geometry
    static Result<MeshPages> read(const formats::PackView& part, uint32_t mesh);

    /// Decode the pages that one level of a mesh takes: others have no geometry.
    /// errors: those of read
    static Result<MeshPages> readLevel(const formats::PackView& part, uint32_t mesh, uint32_t level);

    const formats::PackView& part() const { return *part_; }
    const formats::MeshRecord& record() const { return *record_; }
    formats::ClusterGeometry cluster(uint32_t number) const;

private:
    /// is_needed  of each page of the mesh
    static Result<MeshPages> decode(const formats::PackView& part, uint32_t mesh,
                                    const std::vector<bool>& is_needed);

    const formats::PackView* part_ = nullptr;
    const formats::MeshRecord* record_ = nullptr;
    std::vector<std::vector<std::byte>> pages_;
};

/// Clusters of one level, and clusters of finer levels that nothing replaces. Vertices are stored cluster by
/// cluster: where clusters meet, each has its own copy.
struct LevelArrays
{
    struct Part
    {
        uint32_t cluster; ///< index in chunk CLUS
        uint32_t first_vertex;
    };
    std::vector<Float3> positions;
    std::vector<Float3> normals; ///< decoded from their codes
    std::vector<uint32_t> indices;
    std::vector<uint32_t> triangle_materials;
    std::vector<uint32_t> finer_vertex; ///< as LevelMesh::finer_vertex
    std::vector<uint32_t> first_copy;   ///< as LevelMesh::first_copy
    std::vector<Part> parts;
    float reach = 0;

    LevelMesh mesh() const { return {{positions, normals, indices}, finer_vertex, reach, first_copy}; }
};

/// Count the triangles that the uniform cut of each level draws, finest first.
std::vector<uint64_t> countLevelTriangles(const formats::PackView& part, uint32_t mesh);

/// Extract a level of a mesh, 0 the finest, without links between vertices. Fills normals only if its
/// vertices have them.
LevelArrays extractLevel(const MeshPages& pages, uint32_t level);

/// Extract all levels of a mesh whose vertices have normals, finest first.
std::vector<LevelArrays> extractLevels(const MeshPages& pages);

} // namespace hearth::visibility

// The meshes that uniform cuts through a hierarchy draw, out of the pages of a clusters part.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/fit/level_fit.h"
#include "formats/pack/pack_view.h"

#include <vector>

namespace hearth::visibility
{

/// The decoded pages of one mesh. The view must outlive it.
class MeshPages
{
public:
    /// errors: those of PackView::decodePage and formats::checkHierarchy's of tables; meaning_geometry
    static Result<MeshPages> read(const formats::PackView& part, uint32_t mesh);

    const formats::PackView& part() const { return *part_; }
    const formats::MeshRecord& record() const { return *record_; }
    formats::ClusterGeometry cluster(uint32_t number) const;

private:
    const formats::PackView* part_ = nullptr;
    const formats::MeshRecord* record_ = nullptr;
    std::vector<std::vector<std::byte>> pages_;
};

/// The clusters of one level, and those of finer levels that nothing replaces. Vertices stand cluster by cluster: where
/// clusters meet, each has its own.
struct LevelArrays
{
    struct Part
    {
        uint32_t cluster; ///< chunk CLUS
        uint32_t first_vertex;
    };
    std::vector<Float3> positions;
    std::vector<Float3> normals; ///< as their codes decode
    std::vector<uint32_t> indices;
    std::vector<uint32_t> triangle_materials; ///< level 0 only
    std::vector<uint32_t> finer_vertex;       ///< as LevelMesh::finer_vertex
    std::vector<Part> parts;
    float reach = 0;

    LevelMesh mesh() const { return {{positions, normals, indices}, finer_vertex, reach}; }
};

/// The finest level of a mesh; normals only where its vertices have them.
LevelArrays finestOf(const MeshPages& pages);

/// All levels of a mesh whose vertices have normals, finest first.
std::vector<LevelArrays> levelsOf(const MeshPages& pages);

} // namespace hearth::visibility

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/pack_geometry.h"

namespace hearth::reference
{

using namespace formats;

SceneTables readTables(const PackView& view)
{
    return {view.instances(), view.materials()};
}

bool isDoubleSided(std::span<const MaterialRecord> materials, uint32_t material)
{
    return material != kInvalidIndex && (materials[material].flags & kMaterialDoubleSided) != 0;
}

bool isDeformed(const PackView& view, uint32_t instance)
{
    for (const DeformedMeshRecord& mesh : view.deformedMeshes())
        if (mesh.mesh == view.instances()[instance].mesh)
            return true;
    return false;
}

Result<PackGeometry> PackGeometry::decode(const PackView& view)
{
    PackGeometry geometry(view);
    for (uint32_t page = 0; page < view.pages().size(); ++page)
    {
        HEARTH_ASSIGN_OR_RETURN(std::vector<std::byte> bytes, view.decodePage(page));
        geometry.pages_.push_back(std::move(bytes));
    }
    return geometry;
}

ClusterGeometry PackGeometry::cluster(uint32_t index) const
{
    const ClusterRecord& record = view_->clusters()[index];
    const auto geometry =
        ClusterGeometry::at(pages_[record.page], record, view_->meshes()[view_->pages()[record.page].mesh]);
    HEARTH_ASSERT(geometry.has_value());
    return *geometry;
}

std::vector<std::array<Float3, 3>> PackGeometry::triangles(uint32_t cluster_index) const
{
    const ClusterGeometry geometry = cluster(cluster_index);
    std::vector<std::array<Float3, 3>> triangles;
    for (uint32_t t = 0; t < geometry.triangleCount(); ++t)
    {
        const auto corners = geometry.triangle(t);
        triangles.push_back(
            {geometry.position(corners[0]), geometry.position(corners[1]), geometry.position(corners[2])});
    }
    return triangles;
}

std::vector<SceneTriangle> trianglesOfSlots(const PackGeometry& geometry, std::span<const DrawnCluster> slots)
{
    std::vector<SceneTriangle> triangles;
    for (uint32_t slot = 0; slot < slots.size(); ++slot)
    {
        const uint32_t material = geometry.view().clusters()[slots[slot].cluster].material;
        uint32_t number = 0;
        for (const auto& corners : geometry.triangles(slots[slot].cluster))
            triangles.push_back({corners, slots[slot].instance, material, slot << 7 | number++});
    }
    return triangles;
}

std::vector<SceneTriangle> trianglesOfFinestLevel(const PackGeometry& geometry)
{
    const PackView& view = geometry.view();
    std::vector<SceneTriangle> triangles;
    for (uint32_t instance = 0; instance < view.instances().size(); ++instance)
    {
        const Range clusters = view.meshes()[view.instances()[instance].mesh].clusters;
        for (uint32_t c = clusters.first; c < clusters.first + clusters.count; ++c)
            if (view.clusters()[c].level == 0)
                for (const auto& corners : geometry.triangles(c))
                    triangles.push_back({corners, instance, view.clusters()[c].material,
                                         static_cast<uint32_t>(triangles.size())});
    }
    return triangles;
}

} // namespace hearth::reference

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/scene/neighbour_occluders.h"

#include "cook/visibility/scene/scene_occluders.h"
#include "formats/base/affine3d.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace hearth::visibility
{

using namespace formats;

namespace
{

/// Return the transforms of a mesh's instances that are near enough, by the level that each is added at.
std::map<uint32_t, std::vector<Affine3>> groupByLevel(const PackView& scene, const PackView& part,
                                                      uint32_t mesh, uint32_t sampled_level,
                                                      const Box3& receivers, float max_distance)
{
    const MeshRecord& record = part.meshes()[mesh];
    std::map<uint32_t, std::vector<Affine3>> transforms;
    for (const InstanceRecord& instance : scene.instances())
    {
        if (instance.mesh != mesh || !isInvertible(instance.world_from_object))
            continue;
        const float distance = distanceBetween(
            receivers, transformBox(widened(instance.world_from_object), {record.box_min, record.box_max}));
        if (distance <= max_distance)
            transforms[chooseNeighbourLevel(part, mesh, instance.scale_max, distance, sampled_level)]
                .push_back(instance.world_from_object);
    }
    return transforms;
}

} // namespace

float distanceBetween(const Box3& a, const Box3& b)
{
    const auto gap = [&](int axis) {
        return std::max({a.min[axis] - b.max[axis], b.min[axis] - a.max[axis], 0.0f});
    };
    return std::hypot(gap(0), gap(1), gap(2));
}

uint32_t chooseNeighbourLevel(const PackView& part, uint32_t mesh, float scale_max, float distance,
                              uint32_t sampled_level)
{
    const MeshRecord& record = part.meshes()[mesh];
    uint32_t level = sampled_level;
    while (level + 1 < record.lod_count &&
           part.levels()[record.levels.first + level + 1].max_error * scale_max <=
               distance * kMaxNeighbourError)
        ++level;
    return level;
}

Status addNeighbour(Occluders& occluders, const PackView& scene, const PackView& part,
                    std::span<const uint32_t> sampled_levels, const Box3& receivers, float max_distance)
{
    SceneSurfaces surfaces(scene);
    for (uint32_t mesh = 0; mesh < part.meshes().size(); ++mesh)
    {
        const MeshRecord& record = part.meshes()[mesh];
        if (record.clusters.count == 0 || isDeformed(record))
            continue;
        const auto transforms =
            groupByLevel(scene, part, mesh, sampled_levels[mesh], receivers, max_distance);
        if (transforms.empty())
            continue;
        HEARTH_ASSIGN_OR_RETURN(const MeshPages pages, MeshPages::read(part, mesh));
        for (const auto& [level, of_level] : transforms)
            HEARTH_TRY(addMesh(occluders, surfaces, pages, extractLevel(pages, level), of_level));
    }
    return success();
}

} // namespace hearth::visibility

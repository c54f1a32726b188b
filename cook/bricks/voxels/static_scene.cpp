// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/voxels/static_scene.h"

#include "formats/pack/pack_check.h"
#include "formats/pack/proxy_sections.h"
#include "formats/scene/lit_material.h"

#include <algorithm>

namespace hearth::bricks
{

using namespace formats;

namespace
{

bool isDeformed(const MeshRecord& mesh)
{
    return mesh.skinned != 0 || mesh.morph_target_count != 0;
}

Box3 instanceBox(const MeshRecord& mesh, const Affine3& world_from_object)
{
    Box3 box;
    for (uint32_t corner = 0; corner < 8; ++corner)
        box.add(transformPoint(world_from_object, {(corner & 1) != 0 ? mesh.box_max.x : mesh.box_min.x,
                                                   (corner & 2) != 0 ? mesh.box_max.y : mesh.box_min.y,
                                                   (corner & 4) != 0 ? mesh.box_max.z : mesh.box_min.z}));
    return box;
}

Status checkParts(const SourceParts& source, const std::vector<SurfaceMaterial>& materials)
{
    HEARTH_TRY(checkHierarchy(source.clusters));
    for (const ClusterRecord& cluster : source.clusters.clusters())
        if (cluster.material != kInvalidIndex && cluster.material >= materials.size())
            return Error{Issue::meaning_reference, source.clusters.name(), "",
                         "material " + std::to_string(cluster.material) + " of a cluster is not in " +
                             source.scene.name()};
    if (!source.proxies)
        return success();
    for (const ProxyRecord& proxy : source.proxies->proxies())
        if (proxy.mesh >= source.clusters.meshes().size())
            return Error{Issue::meaning_reference, source.proxies->name(), "",
                         "mesh " + std::to_string(proxy.mesh) + " is not in " + source.clusters.name()};
    return success();
}

/// True if all materials of the mesh are unlit.
bool isUnlit(const StaticScene& scene, uint32_t source, const MeshRecord& mesh)
{
    const auto clusters = recordsInRange(scene.sources[source].clusters.clusters(), mesh.clusters);
    return std::ranges::all_of(clusters, [&](const ClusterRecord& cluster)
                               { return !isLit(scene.material(source, cluster.material).record); });
}

Status addInstances(StaticScene& scene, uint32_t source)
{
    const SourceParts& parts = scene.sources[source];
    const std::vector<bool> moved = findAnimatedNodes(parts.scene);
    for (size_t i = 0; i < parts.scene.instances().size(); ++i)
    {
        const InstanceRecord& instance = parts.scene.instances()[i];
        if (instance.mesh >= parts.clusters.meshes().size())
            return Error{Issue::meaning_reference, parts.scene.name(), "instance " + std::to_string(i),
                         "mesh " + std::to_string(instance.mesh) + " is not in " + parts.clusters.name()};
        const MeshRecord& mesh = parts.clusters.meshes()[instance.mesh];
        if (mesh.clusters.count == 0)
            continue;
        if (isDeformed(mesh))
            ++scene.left_out.deformed;
        else if (instance.node < moved.size() && moved[instance.node])
            ++scene.left_out.animated;
        else if (isUnlit(scene, source, mesh))
            ++scene.left_out.unlit;
        else
            scene.instances.push_back({source, static_cast<uint32_t>(i), instance.mesh,
                                       instance.world_from_object, instance.scale_max,
                                       (instance.flags & kInstanceMirrored) != 0,
                                       instanceBox(mesh, instance.world_from_object)});
    }
    for (const CameraRecord& camera : parts.scene.cameras())
        scene.cameras.push_back({camera.world_from_camera.m[0][3], camera.world_from_camera.m[1][3],
                                 camera.world_from_camera.m[2][3]});
    return success();
}

/// Call visit(index, cluster) for each cluster of a mesh in the LOD cut at an error in object space.
template <typename Visit>
void forEachCutCluster(const PackView& part, const MeshRecord& mesh, float error, const Visit& visit)
{
    for (uint32_t c = mesh.clusters.first; c < mesh.clusters.first + mesh.clusters.count; ++c)
    {
        const ClusterRecord& cluster = part.clusters()[c];
        if (clusterError(cluster, part.groups()) <= error && part.groups()[cluster.group].error > error)
            visit(c, cluster);
    }
}

} // namespace

std::vector<bool> findAnimatedNodes(const PackView& scene)
{
    std::vector<bool> moved(scene.nodes().size());
    for (const AnimationRecord& animation : scene.animations())
        for (const AnimationChannelRecord& channel : recordsInRange(scene.channels(), animation.channels))
            if (channel.target < moved.size())
                moved[channel.target] = true;
    // repeat, because parents may follow their children in the table
    for (bool changed = true; changed;)
    {
        changed = false;
        for (size_t node = 0; node < moved.size(); ++node)
        {
            const uint32_t parent = scene.nodes()[node].parent;
            if (!moved[node] && parent < moved.size() && moved[parent])
                moved[node] = changed = true;
        }
    }
    return moved;
}

Box3 StaticScene::box() const
{
    Box3 box;
    for (const StaticInstance& instance : instances)
        box.add(instance.box);
    return box;
}

const SurfaceMaterial& StaticScene::material(uint32_t source, uint32_t material) const
{
    return material == kInvalidIndex ? default_material_ : materials[source][material];
}

Result<StaticScene> collectStaticScene(std::span<const SourceParts> sources)
{
    StaticScene scene;
    scene.sources = sources;
    for (uint32_t source = 0; source < sources.size(); ++source)
    {
        HEARTH_ASSIGN_OR_RETURN(std::vector<SurfaceMaterial> materials,
                                readMaterials(sources[source].scene, sources[source].textures));
        HEARTH_TRY(checkParts(sources[source], materials));
        scene.materials.push_back(std::move(materials));
        HEARTH_TRY(addInstances(scene, source));
    }
    return scene;
}

std::vector<InstancedCluster> findCutClusters(const StaticScene& scene, float error)
{
    std::vector<InstancedCluster> placed;
    for (uint32_t i = 0; i < scene.instances.size(); ++i)
    {
        const StaticInstance& instance = scene.instances[i];
        const PackView& part = scene.sources[instance.source].clusters;
        // skip instances of size 0: they have no error and no area
        if (!(instance.scale_max > 0))
            continue;
        forEachCutCluster(part, part.meshes()[instance.mesh], error / instance.scale_max,
                          [&](uint32_t number, const ClusterRecord& cluster)
                          {
                              if (isLit(scene.material(instance.source, cluster.material).record))
                                  placed.push_back({instance.source, cluster.page, number, i});
                          });
    }
    std::ranges::sort(placed);
    return placed;
}

std::vector<ClosedProxy> findClosedProxies(const StaticScene& scene)
{
    std::vector<ClosedProxy> placed;
    for (uint32_t i = 0; i < scene.instances.size(); ++i)
    {
        const std::optional<PackView>& part = scene.sources[scene.instances[i].source].proxies;
        if (!part)
            continue;
        const auto [first, last] =
            std::ranges::equal_range(part->proxies(), scene.instances[i].mesh, {}, &ProxyRecord::mesh);
        for (auto proxy = first; proxy != last; ++proxy)
            if (proxy->is_closed != 0 && !hasConvexParts(*part, *proxy))
                placed.push_back({i, static_cast<uint32_t>(proxy - part->proxies().begin())});
    }
    return placed;
}

ClosedSurface makeClosedSurface(const StaticScene& scene, const ClosedProxy& placed, const GridFrame& frame)
{
    const StaticInstance& instance = scene.instances[placed.instance];
    const PackView& part = *scene.sources[instance.source].proxies;
    const ProxyRecord& proxy = part.proxies()[placed.proxy];
    const Affine3d voxels_from_object = voxelsFromObject(frame, instance.world_from_object);
    ClosedSurface surface;
    for (const Float3& position : recordsInRange(part.proxyPositions(), proxy.positions))
        surface.positions.push_back(transformPoint(voxels_from_object, widen(position)));
    const auto indices = recordsInRange(part.proxyIndices(), proxy.indices);
    surface.indices.assign(indices.begin(), indices.end());
    return surface;
}

VoxelBox computeVoxelBox(const StaticScene& scene, const InstancedCluster& placed,
                         const Affine3d& voxels_from_object)
{
    const PackView& part = scene.sources[placed.source].clusters;
    const ClusterRecord& cluster = part.clusters()[placed.cluster];
    const double step = part.meshes()[scene.instances[placed.instance].mesh].grid_step;
    Double3 low, high;
    for (size_t axis = 0; axis < 3; ++axis)
    {
        const double base = cluster.base[axis];
        const double extent = static_cast<double>(uint32_t{cluster.extent[axis]} << cluster.extent_shift);
        (axis == 0 ? low.x : axis == 1 ? low.y : low.z) = base * step;
        (axis == 0 ? high.x : axis == 1 ? high.y : high.z) = (base + extent) * step;
    }
    const Double3 middle = transformPoint(voxels_from_object, (low + high) * 0.5);
    const Double3 half = (high - low) * 0.5;
    // margin: rounding moves corners by half a step of the snapping grid, and sides by the error of doubles
    const auto reach = [&](const double(&row)[4])
    {
        return std::abs(row[0]) * half.x + std::abs(row[1]) * half.y + std::abs(row[2]) * half.z +
               1 / kStepsPerVoxel;
    };
    const Double3 reached{reach(voxels_from_object.m[0]), reach(voxels_from_object.m[1]),
                          reach(voxels_from_object.m[2])};
    return {middle - reached, middle + reached};
}

} // namespace hearth::bricks

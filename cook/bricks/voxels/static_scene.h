// Collects the static instances of the sources, and the clusters that a grid is made from.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/grid/grid_frame.h"
#include "cook/bricks/voxels/interior.h"
#include "cook/bricks/voxels/material.h"
#include "cook/bricks/voxels/source_parts.h"

#include <span>
#include <vector>

namespace hearth::bricks
{

struct StaticInstance
{
    uint32_t source;
    uint32_t record; ///< index in the source's instances
    uint32_t mesh;
    Affine3 world_from_object;
    float scale_max; ///< as in InstanceRecord
    bool mirrored;   ///< the transform inverts the winding of triangles
    Box3 box;        ///< world space
};

/// Numbers of instances that are excluded, by reason.
struct ExcludedInstances
{
    uint32_t animated = 0; ///< animated by a clip, directly or through an ancestor
    uint32_t deformed = 0; ///< with joints or morph targets
    uint32_t unlit = 0;    ///< unlit, mostly painted skies
};

/// Scenes of all sources in one world.
struct StaticScene
{
    std::span<const SourceParts> sources;
    std::vector<std::vector<SurfaceMaterial>> materials; ///< by source
    std::vector<StaticInstance> instances;
    std::vector<Float3> cameras;
    ExcludedInstances left_out;

    Box3 box() const;
    const SurfaceMaterial& material(uint32_t source, uint32_t material) const;

private:
    SurfaceMaterial default_material_ = defaultMaterial();
};

/// Collect the static scene. The sources must outlive it.
/// errors: errors of checkHierarchy; meaning_reference where parts are not of one source, or an index is out
/// of range
Result<StaticScene> collectStaticScene(std::span<const SourceParts> sources);

/// Return for each node of a scene whether a clip animates it, directly or through an ancestor.
std::vector<bool> findAnimatedNodes(const formats::PackView& scene);

/// Cluster of an instance.
struct InstancedCluster
{
    uint32_t source;
    uint32_t page;
    uint32_t cluster; ///< index in chunk CLUS
    uint32_t instance;

    friend auto operator<=>(const InstancedCluster&, const InstancedCluster&) = default;
};

/// Return the clusters of the LOD cut at an error, of all instances, without unlit clusters, sorted.
/// error  metres in world space, >= 0; an upper bound for the cut of each instance
std::vector<InstancedCluster> findCutClusters(const StaticScene& scene, float error);

/// Closed proxy of an instance's mesh.
struct ClosedProxy
{
    uint32_t instance; ///< of the scene
    uint32_t proxy;    ///< of its source
};

/// Return the closed proxies of all instances.
std::vector<ClosedProxy> findClosedProxies(const StaticScene& scene);

/// Return the surface of a proxy in voxels.
ClosedSurface makeClosedSurface(const StaticScene& scene, const ClosedProxy& placed, const GridFrame& frame);

/// Bounding box of a cluster in voxels, in floating point, extended by the rounding to the grid.
struct VoxelBox
{
    Double3 min, max;
};
VoxelBox computeVoxelBox(const StaticScene& scene, const InstancedCluster& placed,
                         const Affine3d& voxels_from_object);

} // namespace hearth::bricks

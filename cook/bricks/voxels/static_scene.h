// What of the sources stands still, and which clusters of it a grid is made from.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/grid/grid_frame.h"
#include "cook/bricks/voxels/material.h"
#include "formats/pack/pack_view.h"

#include <span>
#include <vector>

namespace hearth::bricks
{

/// The parts of one source.
struct SourceParts
{
    formats::PackView scene; ///< import part: nodes, instances, materials, cameras
    formats::PackView clusters;
    formats::PackView textures;
};

struct StaticInstance
{
    uint32_t source;
    uint32_t mesh;
    Affine3 world_from_object;
    float scale_max; ///< as InstanceRecord
    bool mirrored;   ///< its triangles turn the other way
    Box3 box;        ///< world space
};

/// How many instances take no part, and why.
struct LeftOut
{
    uint32_t animated = 0; ///< a clip moves them, or a node above them
    uint32_t deformed = 0; ///< joints or morph targets move their vertices
    uint32_t unlit = 0;    ///< light does not show on them: painted skies, mostly
};

/// The scenes of all sources in one world.
struct StaticScene
{
    std::span<const SourceParts> sources;
    std::vector<std::vector<MaterialUse>> materials; ///< of each source
    std::vector<StaticInstance> instances;
    std::vector<Float3> cameras;
    LeftOut left_out;

    Box3 box() const;
    const MaterialUse& material(uint32_t source, uint32_t material) const;

private:
    MaterialUse default_material_ = defaultMaterial();
};

/// The sources must outlive the scene.
/// errors: those of checkHierarchy; meaning_reference where parts are not of one source, or an index points nowhere
Result<StaticScene> staticScene(std::span<const SourceParts> sources);

/// A cluster of an instance.
struct PlacedCluster
{
    uint32_t source;
    uint32_t page;
    uint32_t cluster; ///< chunk CLUS
    uint32_t instance;

    friend auto operator<=>(const PlacedCluster&, const PlacedCluster&) = default;
};

/// The clusters of the cut that the runtime would draw at an error, of all instances but for what is unlit, sorted.
/// error  metres in the world, >= 0; no instance's cut is off by more
std::vector<PlacedCluster> clustersOfCut(const StaticScene& scene, float error);

/// Voxels that a cluster can reach, in floating point: its box, and what rounding to the grid adds.
struct VoxelBox
{
    Double3 min, max;
};
VoxelBox voxelBoxOf(const StaticScene& scene, const PlacedCluster& placed,
                    const Affine3d& voxels_from_object);

} // namespace hearth::bricks

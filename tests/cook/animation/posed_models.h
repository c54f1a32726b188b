// Animated models for tests of bounds: their poses by the definition, and clusters without a cooker.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/skinning/cluster_bounds.h"
#include "formats/pack/pack_view.h"
#include "formats/scene/animation.h"

#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace hearth::test
{

/// A mesh as one node of a scene deforms it, and the bounds that it is to keep.
struct PosedMesh
{
    uint32_t node = 0;
    uint32_t skin = kInvalidIndex;
    std::vector<skinning::DeformedCluster> clusters;
    std::vector<formats::DeformedClusterRecord> bounds; ///< one for each cluster
    std::vector<uint32_t> levels;                       ///< of each cluster
    uint32_t anchor = 0;
    std::vector<Sphere> spheres; ///< in the anchor: of each cluster's group
    Box3 box;                    ///< in the anchor
};

/// The deformed meshes of a pack, once for each node that draws one.
Result<std::vector<PosedMesh>> posedMeshes(const formats::PackView& pack);

/// Bounds of clusters that stand alone, each in a group of its own.
void computeBounds(const formats::AnimationTables& tables, PosedMesh& mesh);

/// Poses of a scene: the rest pose, then what its clips, or blends of two of them, make of it at random times, half of
/// them with random morph weights from 0 to 1.
class PoseSource
{
public:
    PoseSource(const formats::AnimationTables& tables, uint32_t seed);

    const formats::ScenePose& next();
    const formats::ScenePose& rest();

    std::span<const Affine3d> worldFromNode() const { return world_from_node_; }
    std::vector<Affine3d> palette(uint32_t skin, uint32_t node) const;

private:
    const formats::ScenePose& place();
    void sample(formats::ScenePose& pose);

    formats::AnimationTables tables_;
    std::mt19937 random_;
    formats::ScenePose from_, to_, blend_;
    std::vector<uint32_t> parents_first_;
    std::vector<Affine3d> world_from_node_;
};

/// What a test of a mesh's bounds found.
struct BoundsFigures
{
    size_t clusters = 0;
    size_t poses = 0;
    size_t violations = 0; ///< vertices outside of a box or sphere
    double worst = 0;      ///< metres outside of it
    /// Sum over the clusters: volume of the box to that of the smallest around the vertices in all poses.
    double volume_ratio = 0;
    size_t finest_clusters = 0; ///< of the source's triangles
    double finest_volume_ratio = 0;
    size_t cones = 0;        ///< that can cull
    size_t facing_wrong = 0; ///< triangles that face an eye for which their cone says that none does
};
BoundsFigures& operator+=(BoundsFigures& a, const BoundsFigures& b);

/// Hold the bounds of a mesh against `poses` poses, computed by the definition.
BoundsFigures checkBounds(const formats::AnimationTables& tables, const PosedMesh& mesh, size_t poses,
                          uint32_t seed);

} // namespace hearth::test

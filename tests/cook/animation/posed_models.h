// Animated models for tests of bounds: poses computed by glTF's definition, and clusters built without a
// cooker.
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

/// Mesh deformed by one node of a scene, with the bounds to check.
struct PosedMesh
{
    uint32_t node = 0;
    uint32_t skin = kInvalidIndex;
    std::vector<skinning::DeformedCluster> clusters;
    std::vector<formats::DeformedClusterRecord> bounds; ///< one for each cluster
    std::vector<std::vector<uint32_t>> joints;          ///< entries of chunk DJNT of each cluster
    std::vector<uint32_t> levels;                       ///< level of each cluster
    uint32_t anchor = 0;
    std::vector<Sphere> spheres; ///< sphere of each cluster's group, in the anchor's space
    Box3 box;                    ///< in the anchor's space
};

/// Return the deformed meshes of a pack, once for each node that draws one.
Result<std::vector<PosedMesh>> posedMeshes(const formats::PackView& pack);

/// Compute the bounds of clusters that are not part of a hierarchy, each in its own group.
void computeBounds(const formats::AnimationTables& tables, PosedMesh& mesh);

/// Poses of a scene: the rest pose, then single clips and blends of two clips at random times. Half of them
/// have random morph weights from 0 to 1.
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

/// Results of the test of a mesh's bounds.
struct BoundsFigures
{
    size_t clusters = 0;
    size_t poses = 0;
    size_t violations = 0; ///< vertices outside of their box or sphere
    double worst = 0;      ///< metres outside of the box or sphere
    /// Sum over the clusters of the box's volume, relative to the smallest box around the vertices in all
    /// poses.
    double volume_ratio = 0;
    double volume = 0;          ///< sum over the clusters of the boxes' volumes, cubic metres
    double tightest_volume = 0; ///< the same of the smallest boxes
    size_t finest_clusters = 0; ///< clusters of the finest level
    double finest_volume_ratio = 0;
    size_t cones = 0;        ///< cones that can cull
    size_t facing_wrong = 0; ///< front-facing triangles that their cone would cull
};
BoundsFigures& operator+=(BoundsFigures& a, const BoundsFigures& b);

/// Compare the bounds of a mesh with `poses` poses, computed by glTF's definition.
BoundsFigures checkBounds(const formats::AnimationTables& tables, const PosedMesh& mesh, size_t poses,
                          uint32_t seed);

} // namespace hearth::test

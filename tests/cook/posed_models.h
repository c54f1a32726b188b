// Animated models for tests of bounds: their poses by the definition, and clusters without a cooker.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/mesh/source_mesh.h"
#include "cook/skinning/cluster_bounds.h"
#include "formats/animation.h"
#include "formats/pack_view.h"

#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace hearth::test
{

/// A mesh as one node of a scene deforms it.
struct PosedMesh
{
    uint32_t node = 0;
    uint32_t skin = formats::kNone;
    std::vector<skinning::DeformedCluster> clusters;
    std::vector<motion::Interval> morph_weights;
    std::vector<motion::Box3d> reach; ///< by joint
};

/// Clusters of at most 128 triangles that lie together, in the bind pose. morph targets that move none of a cluster's
/// vertices are left out of it.
std::vector<skinning::DeformedCluster> clustersOf(const mesh::SourceMesh& mesh);

/// For each joint the box of the positions that it moves.
std::vector<motion::Box3d> reachOf(std::span<const skinning::DeformedCluster> clusters, uint32_t joints);

/// A pose of the scene: what its clips, or a blend of two of them, make of it at random times.
class PoseSource
{
public:
    PoseSource(const formats::MotionTables& tables, uint32_t seed);

    const formats::ScenePose& next();
    const formats::ScenePose& rest();

    std::span<const Affine3d> worldFromNode() const { return world_from_node_; }
    std::vector<Affine3d> palette(uint32_t skin, uint32_t node) const;

private:
    const formats::ScenePose& place();
    void sample(formats::ScenePose& pose);

    formats::MotionTables tables_;
    std::mt19937 random_;
    formats::ScenePose from_, to_, blend_;
    std::vector<uint32_t> parents_first_;
    std::vector<Affine3d> world_from_node_;
};

/// What a test of a mesh's bounds found.
struct BoundsFigures
{
    size_t violations = 0;
    double worst = 0;        ///< metres outside of a box
    double volume_ratio = 0; ///< of each box to the smallest around its vertices in all poses, on average
    size_t clusters = 0;
    size_t cones = 0;        ///< that can cull
    size_t facing_wrong = 0; ///< triangles that face an eye which their cone's cluster is culled for
};

/// Hold the bounds of a mesh's clusters against `poses` poses.
BoundsFigures checkBounds(const formats::MotionTables& tables, const PosedMesh& mesh, size_t poses,
                          uint32_t seed);

} // namespace hearth::test

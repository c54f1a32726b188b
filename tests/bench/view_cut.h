// Chooses the clusters of a view by the product's rule, or with one of its parts replaced by an ideal that
// only a measurement can afford.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/mesh/source_mesh.h"
#include "runtime/frame/frame.h"
#include "tests/reference/pack_geometry.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace hearth::bench
{

/// Decoded triangles of a cluster.
struct ClusterMesh
{
    std::vector<Float3> positions; ///< object space
    std::vector<Float3> normals;
    std::vector<std::array<uint32_t, 3>> triangles;
};

/// Distances to the source of points on simplified triangles: corners, middles of edges, centres. Object
/// space.
struct SampledError
{
    float max = 0;
    float rms = 0; ///< over the area
};

/// Scene whose cuts are measured.
class CutScene
{
public:
    /// view     outlives the scene
    /// sources  for each mesh of the view, what it was made from
    static Result<CutScene> read(const formats::PackView& view, std::span<const mesh::SourceMesh> sources);

    const formats::PackView& view() const { return *view_; }
    const ClusterMesh& cluster(uint32_t cluster) const { return clusters_[cluster]; }
    /// Error of the clusters that replace a group; 0 for a root.
    const SampledError& groupError(uint32_t group) const { return of_group_[group]; }
    /// Unit mean normal of a group's clusters, object space.
    Float3 groupNormal(uint32_t group) const { return group_normals_[group]; }
    const SampledError& clusterError(uint32_t cluster) const { return of_cluster_[cluster]; }

private:
    explicit CutScene(const formats::PackView& view) : view_(&view) {}
    void sampleErrors(std::span<const mesh::SourceMesh> sources);

    const formats::PackView* view_;
    std::vector<ClusterMesh> clusters_;
    std::vector<SampledError> of_group_;
    std::vector<SampledError> of_cluster_;
    std::vector<Float3> group_normals_;
};

/// Error of a group that the cut compares with the threshold.
enum class CutError : uint8_t
{
    stored,
    position, ///< the stored bound of the distance alone
    sampled,  ///< largest sampled distance
    rms,      ///< root mean square of the sampled distances, times kRmsScale
};

/// Factor that makes root mean squares as large as largest distances, about, so that thresholds compare.
inline constexpr float kRmsScale = 4;

/// Distance that divides the error.
enum class CutDistance : uint8_t
{
    sphere,  ///< to the group's sphere
    nearest, ///< to the nearest vertex of the group's clusters
};

/// Weight of a group's error by the side that its clusters' mean normal shows to the eye.
enum class CutFacing : uint8_t
{
    none,
    away,  ///< less where it faces away
    slant, ///< in proportion to the cosine of normal and view, least where it faces away
};

struct CutRule
{
    CutError error = CutError::stored;
    CutDistance distance = CutDistance::sphere;
    float threshold = 1; ///< pixels
    CutFacing facing = CutFacing::none;
};

/// Return for each group of the pack, for one instance, its error on the screen in pixels: infinity for
/// roots; no value falls towards the root.
std::vector<float> projectErrors(const CutScene& scene, const shared::FrameView& view, uint32_t instance,
                                 const CutRule& rule);

/// Return the clusters of the cut that pass the frustum and the cone test.
std::vector<reference::DrawnCluster> chooseClusters(const CutScene& scene, const shared::FrameView& view,
                                                    const CutRule& rule);

/// Return the number of triangles of the whole cut if each cluster of a group could be replaced alone,
/// divided by the number when groups are replaced as a whole. Both by sampled errors. A cluster that is too
/// coarse counts as its share of the clusters that it was made from.
double shareWithoutGroups(const CutScene& scene, const shared::FrameView& view, const CutRule& rule);

} // namespace hearth::bench

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/bench/view_cut.h"

#include "tests/support/surfaces/surface_distance.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace hearth::bench
{

using namespace formats;

namespace
{

/// Sums over the triangles of clusters.
struct ErrorSums
{
    double max = 0;
    double square = 0; ///< times the area
    double area = 0;

    void add(const ErrorSums& other)
    {
        max = std::max(max, other.max);
        square += other.square;
        area += other.area;
    }
    SampledError error() const
    {
        return {static_cast<float>(max), area > 0 ? static_cast<float>(std::sqrt(square / area)) : 0.0f};
    }
};

ErrorSums sampleCluster(const ClusterMesh& cluster, const SurfaceDistance& source)
{
    std::vector<double> at_vertices;
    for (const Float3 position : cluster.positions)
        at_vertices.push_back(source.to(position));
    ErrorSums sums;
    for (const auto [i, j, k] : cluster.triangles)
    {
        const Float3 a = cluster.positions[i], b = cluster.positions[j], c = cluster.positions[k];
        const double middles[] = {source.to((a + b) * 0.5f), source.to((b + c) * 0.5f),
                                  source.to((c + a) * 0.5f), source.to((a + b + c) * (1.0f / 3))};
        const double area = 0.5 * double{length(cross(b - a, c - a))};
        double square = 0;
        for (const double distance :
             {at_vertices[i], at_vertices[j], at_vertices[k], middles[0], middles[1], middles[2], middles[3]})
        {
            sums.max = std::max(sums.max, distance);
            square += distance * distance / 7;
        }
        sums.square += square * area;
        sums.area += area;
    }
    return sums;
}

ClusterMesh readCluster(const ClusterGeometry& geometry)
{
    ClusterMesh cluster;
    for (uint32_t v = 0; v < geometry.vertexCount(); ++v)
    {
        cluster.positions.push_back(geometry.position(v));
        cluster.normals.push_back(geometry.normal(v));
    }
    for (uint32_t t = 0; t < geometry.triangleCount(); ++t)
        cluster.triangles.push_back(geometry.triangle(t));
    return cluster;
}

float errorByRule(const CutScene& scene, uint32_t group, CutError kind)
{
    const GroupRecord& record = scene.view().groups()[group];
    switch (kind)
    {
    case CutError::stored:
        break;
    case CutError::position:
        return record.position_error;
    case CutError::sampled:
        return scene.groupError(group).max;
    case CutError::rms:
        return scene.groupError(group).rms * kRmsScale;
    }
    return record.error;
}

float nearestVertex(const CutScene& scene, const shared::FrameView& view, const shared::Instance& instance,
                    const GroupRecord& group)
{
    float nearest2 = std::numeric_limits<float>::infinity();
    for (uint32_t c = group.clusters.first; c < group.clusters.first + group.clusters.count; ++c)
        for (const Float3 position : scene.cluster(c).positions)
        {
            const Float3 relative = shared::toEyeRelative(instance, view.eye, position);
            nearest2 = std::min(nearest2, dot(relative, relative));
        }
    return std::max(std::sqrt(nearest2), view.z_near);
}

Float3 meanNormal(const CutScene& scene, const GroupRecord& group)
{
    Float3 sum;
    for (uint32_t c = group.clusters.first; c < group.clusters.first + group.clusters.count; ++c)
        for (const auto [i, j, k] : scene.cluster(c).triangles)
        {
            const std::vector<Float3>& p = scene.cluster(c).positions;
            sum += cross(p[j] - p[i], p[k] - p[i]);
        }
    return normalizeOr(sum, {0, 1, 0});
}

// Weight of groups that face away.
constexpr float kAwayWeight = 0.35f;

float facingWeight(const CutScene& scene, const shared::FrameView& view, const shared::Instance& instance,
                   uint32_t group, CutFacing facing)
{
    if (facing == CutFacing::none)
        return 1;
    const shared::InstanceInverse inverse =
        shared::makeInstanceInverse(std::bit_cast<InstanceRecord>(instance));
    const Float3 n = scene.groupNormal(group);
    const Float3 normal = normalizeOr(shared::row3(inverse.object_from_world_x) * n.x +
                                          shared::row3(inverse.object_from_world_y) * n.y +
                                          shared::row3(inverse.object_from_world_z) * n.z,
                                      {0, 1, 0});
    const Float3 away = shared::toEyeRelative(instance, view.eye, scene.view().groups()[group].sphere_center);
    const float cosine = -dot(normal, normalizeOr(away, {0, 0, 1}));
    if (facing == CutFacing::away)
        return cosine < 0.0f ? kAwayWeight : 1.0f;
    return kAwayWeight + (1 - kAwayWeight) * std::max(cosine, 0.0f);
}

shared::Instance instanceAt(const CutScene& scene, uint32_t instance)
{
    return std::bit_cast<shared::Instance>(scene.view().instances()[instance]);
}

} // namespace

Result<CutScene> CutScene::read(const PackView& view, std::span<const mesh::SourceMesh> sources)
{
    HEARTH_ASSIGN_OR_RETURN(const reference::PackGeometry geometry, reference::PackGeometry::decode(view));
    CutScene scene(view);
    for (uint32_t c = 0; c < view.clusters().size(); ++c)
        scene.clusters_.push_back(readCluster(geometry.cluster(c)));
    for (const GroupRecord& group : view.groups())
        scene.group_normals_.push_back(meanNormal(scene, group));
    scene.sampleErrors(sources);
    return scene;
}

void CutScene::sampleErrors(std::span<const mesh::SourceMesh> sources)
{
    of_cluster_.resize(view_->clusters().size());
    of_group_.resize(view_->groups().size());
    std::vector<ErrorSums> of_group(view_->groups().size());
    for (size_t m = 0; m < sources.size(); ++m)
    {
        const SurfaceDistance source(sources[m].positions, sources[m].indices);
        const Range range = view_->meshes()[m].clusters;
        for (uint32_t c = range.first; c < range.first + range.count; ++c)
        {
            const uint32_t refined = view_->clusters()[c].refined_group;
            if (refined == kInvalidIndex)
                continue;
            const ErrorSums sums = sampleCluster(clusters_[c], source);
            of_cluster_[c] = sums.error();
            of_group[refined].add(sums);
        }
    }
    for (size_t g = 0; g < of_group.size(); ++g)
        of_group_[g] = of_group[g].error();
}

std::vector<float> projectErrors(const CutScene& scene, const shared::FrameView& view, uint32_t instance,
                                 const CutRule& rule)
{
    const shared::Instance placed = instanceAt(scene, instance);
    const MeshRecord& mesh = scene.view().meshes()[placed.mesh];
    std::vector<float> pixels(scene.view().groups().size());
    // groups are stored coarse to fine: the finer ones come first here, and raise the coarser ones
    for (uint32_t g = mesh.groups.first + mesh.groups.count; g-- > mesh.groups.first;)
    {
        const GroupRecord& group = scene.view().groups()[g];
        if (group.error > shared::kMaxFiniteError)
        {
            pixels[g] = std::numeric_limits<float>::infinity();
            continue;
        }
        const float error = errorByRule(scene, g, rule.error);
        shared::ScreenError on_screen =
            shared::screenError(view, placed, group.sphere_center, group.sphere_radius, error);
        if (rule.distance == CutDistance::nearest)
            on_screen.distance = nearestVertex(scene, view, placed, group);
        pixels[g] =
            on_screen.pixels_m / on_screen.distance * facingWeight(scene, view, placed, g, rule.facing);
        for (uint32_t c = group.clusters.first; c < group.clusters.first + group.clusters.count; ++c)
            if (const uint32_t refined = scene.view().clusters()[c].refined_group; refined != kInvalidIndex)
                pixels[g] = std::max(pixels[g], pixels[refined]);
    }
    return pixels;
}

std::vector<reference::DrawnCluster> chooseClusters(const CutScene& scene, const shared::FrameView& view,
                                                    const CutRule& rule)
{
    const PackView& pack = scene.view();
    const auto bounds = shared::makeMeshBounds(pack.meshes(), pack.clusters());
    std::vector<reference::DrawnCluster> chosen;
    for (uint32_t i = 0; i < pack.instances().size(); ++i)
    {
        const shared::Instance instance = instanceAt(scene, i);
        const shared::InstanceState state = shared::decideInstance(
            view, instance, shared::makeInstanceInverse(pack.instances()[i]), bounds[instance.mesh]);
        if (state.visible == shared::kInstanceHidden)
            continue;
        const std::vector<float> pixels = projectErrors(scene, view, i, rule);
        const Range range = pack.meshes()[instance.mesh].clusters;
        for (uint32_t c = range.first; c < range.first + range.count; ++c)
        {
            const ClusterRecord& record = pack.clusters()[c];
            if (!(pixels[record.group] > rule.threshold) ||
                (record.refined_group != kInvalidIndex && pixels[record.refined_group] > rule.threshold))
                continue;
            const auto cluster = std::bit_cast<shared::Cluster>(record);
            if (shared::clusterInFrustum(view, instance, state, cluster) &&
                !(state.cone_valid != 0 && shared::coneFacesAway(view, state, cluster)))
                chosen.push_back({i, c});
        }
    }
    return chosen;
}

namespace
{

/// Counts the triangles of one instance's cut with and without groups.
class UngroupedCounter
{
public:
    UngroupedCounter(const CutScene& scene, const shared::FrameView& view, uint32_t instance,
                     const CutRule& rule)
        : scene_(scene), pixels_(projectErrors(scene, view, instance, rule)), threshold_(rule.threshold)
    {
        const shared::Instance placed = instanceAt(scene, instance);
        mesh_ = scene.view().meshes()[placed.mesh];
        finest_.assign(scene.view().groups().size(), 0.0);
        replacing_ = finest_;
        for (uint32_t c = mesh_.clusters.first; c < mesh_.clusters.first + mesh_.clusters.count; ++c)
            if (const ClusterRecord& cluster = scene.view().clusters()[c];
                cluster.refined_group != kInvalidIndex)
                replacing_[cluster.refined_group] += cluster.triangle_count;
    }

    /// Add to both counts.
    void count(double& ungrouped, double& grouped)
    {
        // fine to coarse: a group's clusters count after what they may be replaced by
        for (uint32_t g = mesh_.groups.first + mesh_.groups.count; g-- > mesh_.groups.first;)
        {
            const GroupRecord& group = scene_.view().groups()[g];
            for (uint32_t c = group.clusters.first; c < group.clusters.first + group.clusters.count; ++c)
            {
                const ClusterRecord& cluster = scene_.view().clusters()[c];
                const double own = cluster.triangle_count;
                const bool refines =
                    cluster.refined_group != kInvalidIndex && pixels_[cluster.refined_group] > threshold_;
                if (!refines && pixels_[g] > threshold_)
                    grouped += own;
                finest_[g] += alone(cluster, c);
            }
            if (group.error > shared::kMaxFiniteError)
                ungrouped += finest_[g];
        }
    }

private:
    double alone(const ClusterRecord& cluster, uint32_t index) const
    {
        const uint32_t refined = cluster.refined_group;
        if (refined == kInvalidIndex)
            return cluster.triangle_count;
        const SampledError& group = scene_.groupError(refined);
        const float own_pixels =
            group.max > 0 ? pixels_[refined] * (scene_.clusterError(index).max / group.max) : 0;
        if (!(own_pixels > threshold_))
            return cluster.triangle_count;
        return finest_[refined] * cluster.triangle_count / replacing_[refined];
    }

    const CutScene& scene_;
    std::vector<float> pixels_;
    float threshold_;
    MeshRecord mesh_{};
    std::vector<double> finest_;    ///< triangles drawn in the place of each group, its clusters chosen alone
    std::vector<double> replacing_; ///< triangles of the clusters that replace each group
};

} // namespace

double shareWithoutGroups(const CutScene& scene, const shared::FrameView& view, const CutRule& rule)
{
    double ungrouped = 0, grouped = 0;
    for (uint32_t i = 0; i < scene.view().instances().size(); ++i)
        UngroupedCounter(scene, view, i, rule).count(ungrouped, grouped);
    return grouped > 0 ? ungrouped / grouped : 1;
}

} // namespace hearth::bench

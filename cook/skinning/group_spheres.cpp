// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/skinning/group_spheres.h"

#include "cook/skinning/cluster_bounds.h"
#include "cook/skinning/middle_pose.h"
#include "formats/base/assert.h"
#include "formats/base/rounding.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <tbb/parallel_for.h>

namespace hearth::skinning
{

using namespace formats;
using animation_bounds::Box3d;

namespace
{

// Number of joints with the largest weights that are tried as anchors, besides the skin's first joint, mostly
// a root.
constexpr size_t kMaxAnchors = 6;

// Number of steps: more shrink a sphere by less than 1 % of its radius.
constexpr int kSphereSteps = 12;

// Margin as for the spheres of static groups: nesting stays monotone for a runtime in single precision.
constexpr double kMonotoneSlack = 1.0 + 1.0 / 262144.0;

struct WideSphere
{
    Double3 center;
    double radius = 0;
};

/// Bounding spheres of the vertices of a cluster in all poses; nothing if there are no bounds.
using VertexSpheres = std::optional<std::vector<WideSphere>>;

VertexSpheres computeVertexSpheres(const DeformedCluster& cluster, const Deformation& deformation,
                                   uint32_t anchor)
{
    const std::vector<MorphedVertex> vertices = morphedVertices(cluster, deformation.morph_weights);
    const std::optional<MiddlePose> pose = MiddlePose::in(anchor, cluster, deformation, vertices);
    if (!pose)
        return std::nullopt;
    std::vector<WideSphere> spheres;
    for (size_t v = 0; v < vertices.size(); ++v)
        spheres.push_back({pose->place(v), pose->slack(v)});
    return spheres;
}

void add(Box3d& box, const WideSphere& sphere)
{
    const Double3 r{sphere.radius, sphere.radius, sphere.radius};
    animation_bounds::add(box, sphere.center - r);
    animation_bounds::add(box, sphere.center + r);
}

/// Return half the diagonal of the box around all points that joints move, relative to a candidate for the
/// anchor.
double sizeRelativeTo(uint32_t anchor, const animation_bounds::SkinMotion& skin, std::span<const Box3d> reach)
{
    Box3d box;
    for (uint32_t joint = 0; joint < reach.size(); ++joint)
    {
        if (reach[joint][0].empty())
            continue;
        const animation_bounds::JointMotion* motion = skin.relative(anchor, joint);
        if (motion == nullptr)
            return std::numeric_limits<double>::infinity();
        const Double3 center = middle(reach[joint]);
        const double radius = motion->set().norm * length(half(reach[joint]));
        add(box, {transformPoint(motion->ball().center, center), motion->ball().slackAt(center) + radius});
    }
    return length(half(box));
}

uint32_t chooseAnchor(std::span<const DeformedCluster> clusters, const animation_bounds::SkinMotion& skin,
                      std::span<const Box3d> reach)
{
    std::vector<double> weights(skin.jointCount());
    for (const DeformedCluster& cluster : clusters)
        for (size_t i = 0; i < cluster.joints.size(); ++i)
            weights[cluster.joints[i]] += cluster.weights[i];
    std::vector<uint32_t> candidates(weights.size());
    for (uint32_t joint = 0; joint < candidates.size(); ++joint)
        candidates[joint] = joint;
    std::stable_sort(candidates.begin(), candidates.end(),
                     [&](uint32_t a, uint32_t b) { return weights[a] > weights[b]; });
    candidates.resize(std::min(candidates.size(), kMaxAnchors));
    candidates.push_back(0);
    std::vector<double> sizes(candidates.size());
    tbb::parallel_for(size_t{0}, candidates.size(),
                      [&](size_t i) { sizes[i] = sizeRelativeTo(candidates[i], skin, reach); });
    return candidates[static_cast<size_t>(std::min_element(sizes.begin(), sizes.end()) - sizes.begin())];
}

/// Return the radius of a sphere around a point that contains all spheres, and the index of the farthest
/// sphere.
std::pair<double, size_t> farthestFrom(Double3 center, std::span<const WideSphere> spheres)
{
    std::pair<double, size_t> farthest{0, 0};
    for (size_t i = 0; i < spheres.size(); ++i)
        if (const double reach = length(spheres[i].center - center) + spheres[i].radius;
            reach > farthest.first)
            farthest = {reach, i};
    return farthest;
}

/// Return a bounding sphere of spheres.
/// source  M. Badoiu, K. L. Clarkson, "Smaller core-sets for balls", 2003
Sphere boundingSphere(std::span<const WideSphere> spheres)
{
    HEARTH_ASSERT(!spheres.empty());
    Box3d box;
    for (const WideSphere& sphere : spheres)
        add(box, sphere);
    Double3 center = middle(box);
    Double3 best = center;
    double best_radius = std::numeric_limits<double>::infinity();
    for (int step = 1; step <= kSphereSteps; ++step)
    {
        const auto [radius, farthest] = farthestFrom(center, spheres);
        if (radius < best_radius)
        {
            best = center;
            best_radius = radius;
        }
        center = center + (spheres[farthest].center - center) * (0.3 / (step + 1));
    }
    const Float3 stored = narrow(best);
    return {stored, roundUp(farthestFrom(widen(stored), spheres).first * kMonotoneSlack)};
}

/// Compute nested spheres from fine to coarse: records are in the order coarse to fine, the groups of a set
/// together.
std::vector<Sphere> nestedSpheres(const MeshHierarchy& hierarchy,
                                  std::span<const VertexSpheres> vertex_spheres)
{
    std::vector<Sphere> spheres(hierarchy.groups.size());
    for (size_t end = hierarchy.groups.size(); end > 0;)
    {
        const size_t first = end - 1 - hierarchy.groups[end - 1].set_offset;
        std::vector<WideSphere> inside;
        for (size_t g = first; g < end; ++g)
        {
            const Range clusters = hierarchy.groups[g].clusters;
            for (uint32_t c = clusters.first; c < clusters.first + clusters.count; ++c)
            {
                const uint32_t local = c - hierarchy.first_cluster;
                const std::vector<WideSphere>& places = *vertex_spheres[local];
                inside.insert(inside.end(), places.begin(), places.end());
                if (const uint32_t refined = hierarchy.clusters[local].refined_group;
                    refined != kInvalidIndex)
                {
                    const Sphere& sphere = spheres[refined - hierarchy.first_group];
                    inside.push_back({widen(sphere.center), double{sphere.radius}});
                }
            }
        }
        const Sphere sphere = boundingSphere(inside);
        for (; end > first; --end)
            spheres[end - 1] = sphere;
    }
    return spheres;
}

} // namespace

AnchoredBounds computeAnchoredBounds(const MeshHierarchy& hierarchy,
                                     std::span<const DeformedCluster> clusters,
                                     const Deformation& deformation, std::span<const Box3d> reach)
{
    AnchoredBounds bounds;
    if (deformation.skin != nullptr)
        bounds.anchor = chooseAnchor(clusters, *deformation.skin, reach);
    std::vector<VertexSpheres> vertex_spheres(clusters.size());
    tbb::parallel_for(size_t{0}, clusters.size(),
                      [&](size_t i)
                      { vertex_spheres[i] = computeVertexSpheres(clusters[i], deformation, bounds.anchor); });
    if (std::any_of(vertex_spheres.begin(), vertex_spheres.end(), [](const VertexSpheres& r) { return !r; }))
    {
        const Float3 far{kUnbounded, kUnbounded, kUnbounded};
        bounds.box = {-far, far};
        bounds.spheres.assign(hierarchy.groups.size(), {{}, kUnbounded});
        return bounds;
    }
    Box3d box;
    for (const VertexSpheres& places : vertex_spheres)
        for (const WideSphere& place : *places)
            add(box, place);
    bounds.box = roundOutwards(box);
    bounds.spheres = nestedSpheres(hierarchy, vertex_spheres);
    return bounds;
}

} // namespace hearth::skinning

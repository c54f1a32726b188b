// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/skinning/cluster_bounds.h"

#include "cook/skinning/deformed_cone.h"
#include "cook/skinning/rounding.h"

#include <algorithm>
#include <limits>

namespace hearth::skinning
{

using motion::Box3d;
using motion::Interval;

namespace
{

// How many of the heaviest joints are tried as the main bone: a fourth has never been the best one (bench of the sample
// character and the skinned assets).
constexpr size_t kMostCandidates = 3;

/// The joints that move a vertex, heaviest first.
std::vector<uint32_t> influencingJoints(const DeformedCluster& cluster)
{
    std::vector<std::pair<double, uint32_t>> sums;
    for (size_t i = 0; i < cluster.joints.size(); ++i)
    {
        if (!(cluster.weights[i] > 0))
            continue;
        const auto found = std::find_if(sums.begin(), sums.end(),
                                        [&](const auto& sum) { return sum.second == cluster.joints[i]; });
        if (found == sums.end())
            sums.emplace_back(cluster.weights[i], cluster.joints[i]);
        else
            found->first += cluster.weights[i];
    }
    std::sort(sums.begin(), sums.end(),
              [](const auto& a, const auto& b)
              { return a.first != b.first ? a.first > b.first : a.second < b.second; });
    std::vector<uint32_t> joints;
    for (const auto& sum : sums)
        joints.push_back(sum.second);
    return joints;
}

/// Half the surface of a box: what a view sees of it on average.
double area(const Box3d& box)
{
    const Double3 h = half(box);
    return h.x * h.y + h.y * h.z + h.z * h.x;
}

struct MainBone
{
    uint32_t joint = 0;
    std::optional<Box3d> box;
};

void tryJoint(uint32_t joint, const DeformedCluster& cluster, const Deformation& deformation,
              std::span<const MorphedVertex> vertices, MainBone& best)
{
    const std::optional<Box3d> box = boxIn(joint, cluster, deformation, vertices);
    if (box && (!best.box || area(*box) < area(*best.box)))
        best = {joint, box};
}

MainBone mainBone(std::span<const uint32_t> heaviest_first, const DeformedCluster& cluster,
                  const Deformation& deformation, std::span<const MorphedVertex> vertices)
{
    if (deformation.skin == nullptr)
        return {0, boxIn(0, cluster, deformation, vertices)};
    MainBone best{heaviest_first.front(), std::nullopt};
    for (const uint32_t joint : heaviest_first.first(std::min(kMostCandidates, heaviest_first.size())))
        tryJoint(joint, cluster, deformation, vertices, best);
    for (uint32_t joint = 0; joint < deformation.skin->jointCount() && !best.box; ++joint)
        tryJoint(joint, cluster, deformation, vertices, best);
    return best;
}

} // namespace

std::optional<Box3d> boxIn(uint32_t main, const DeformedCluster& cluster, const Deformation& deformation,
                           std::span<const MorphedVertex> vertices)
{
    Box3d box;
    for (size_t v = 0; v < vertices.size(); ++v)
    {
        const MorphedVertex& vertex = vertices[v];
        Box3d places;
        const double own = deformation.skin == nullptr ? 1.0 : weightOf(cluster, v, main);
        const double middle[3] = {vertex.middle.x, vertex.middle.y, vertex.middle.z};
        const double half[3] = {vertex.half.x, vertex.half.y, vertex.half.z};
        for (size_t axis = 0; axis < 3; ++axis)
            places[axis] = {own * (middle[axis] - half[axis]), own * (middle[axis] + half[axis])};
        for (size_t i = v * cluster.influences; i < (v + 1) * cluster.influences; ++i)
            if (cluster.weights[i] > 0 && cluster.joints[i] != main)
            {
                const motion::JointMotion* motion = deformation.skin->relative(main, cluster.joints[i]);
                if (motion == nullptr)
                    return std::nullopt;
                motion->addPlaces(vertex.middle, vertex.half, cluster.weights[i], places);
            }
        for (size_t axis = 0; axis < 3; ++axis)
        {
            box[axis].add(places[axis].low);
            box[axis].add(places[axis].high);
        }
    }
    return box;
}

DeformedBounds boundsOf(const DeformedCluster& cluster, const Deformation& deformation)
{
    DeformedBounds bounds{};
    bounds.joints = influencingJoints(cluster);
    const std::vector<MorphedVertex> vertices = morphedVertices(cluster, deformation.morph_weights);
    const MainBone main = mainBone(bounds.joints, cluster, deformation, vertices);
    bounds.record.joint = static_cast<uint16_t>(main.joint);
    if (deformation.skin != nullptr)
    {
        std::erase(bounds.joints, main.joint);
        bounds.joints.insert(bounds.joints.begin(), main.joint);
    }
    const Box3 box =
        main.box ? roundedOut(*main.box)
                 : Box3{{-kUnbounded, -kUnbounded, -kUnbounded}, {kUnbounded, kUnbounded, kUnbounded}};
    bounds.record.box_min = box.min;
    bounds.record.box_max = box.max;
    const StoredCone cone =
        main.box ? coneIn(main.joint, cluster, deformation, vertices, box.center()) : StoredCone{};
    bounds.record.cone_axis = cone.axis;
    bounds.record.cone_cutoff = cone.cutoff;
    bounds.record.cone_back = cone.back;
    return bounds;
}

} // namespace hearth::skinning

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/skinning/cluster_bounds.h"

#include "cook/skinning/deformed_cone.h"
#include "cook/skinning/rounding.h"
#include "cook/skinning/tight_box.h"

#include <algorithm>
#include <limits>

#include <tbb/parallel_for.h>

namespace hearth::skinning
{

using motion::Box3d;
using motion::Interval;

namespace
{

// How many of the heaviest joints are tried as the main bone: a fourth has never been the best one (bench of the sample
// character and the skinned assets).
constexpr size_t kMostCandidates = 3;

// Tightening boxes may cost so much, in influences of vertices of about 10 ns: all loose clusters of a mesh share it.
constexpr size_t kWorkOfMesh = 40'000'000;
constexpr size_t kMostWork = 8'000'000; ///< of one cluster

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

/// A cluster's main bone and box, before the loose ones are tightened.
struct Draft
{
    std::vector<uint32_t> joints; ///< that move it, heaviest first
    MainBone main;
    bool loose = false;
};

Draft draftOf(const DeformedCluster& cluster, const Deformation& deformation)
{
    const std::vector<MorphedVertex> vertices = morphedVertices(cluster, deformation.morph_weights);
    Draft draft;
    draft.joints = influencingJoints(cluster);
    draft.main = mainBone(draft.joints, cluster, deformation, vertices);
    draft.loose = draft.main.box && draft.joints.size() > 1 && deformation.regions != nullptr &&
                  isLoose(*draft.main.box, draft.main.joint, cluster, deformation, vertices);
    return draft;
}

DeformedBounds finished(const Draft& draft, const DeformedCluster& cluster, const Deformation& deformation,
                        size_t work)
{
    const std::vector<MorphedVertex> vertices = morphedVertices(cluster, deformation.morph_weights);
    const uint32_t main = draft.main.joint;
    DeformedBounds bounds{};
    bounds.joints = draft.joints;
    if (deformation.skin != nullptr)
    {
        std::erase(bounds.joints, main);
        bounds.joints.insert(bounds.joints.begin(), main);
    }
    Box3 box{{-kUnbounded, -kUnbounded, -kUnbounded}, {kUnbounded, kUnbounded, kUnbounded}};
    StoredCone cone;
    if (draft.main.box)
    {
        box = roundedOut(draft.loose ? tightened(*draft.main.box, main, cluster, deformation, vertices, work)
                                     : *draft.main.box);
        cone = coneIn(main, cluster, deformation, vertices, box.center());
    }
    bounds.record.joint = static_cast<uint16_t>(main);
    bounds.record.box_min = box.min;
    bounds.record.box_max = box.max;
    bounds.record.cone_axis = cone.axis;
    bounds.record.cone_cutoff = cone.cutoff;
    bounds.record.cone_back = cone.back;
    return bounds;
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

std::vector<DeformedBounds> boundsOf(std::span<const DeformedCluster> clusters,
                                     const Deformation& deformation)
{
    std::vector<Draft> drafts(clusters.size());
    tbb::parallel_for(size_t{0}, drafts.size(),
                      [&](size_t i) { drafts[i] = draftOf(clusters[i], deformation); });
    const auto loose = static_cast<size_t>(
        std::count_if(drafts.begin(), drafts.end(), [](const Draft& draft) { return draft.loose; }));
    const size_t work = std::min(kMostWork, kWorkOfMesh / std::max(loose, size_t{1}));
    std::vector<DeformedBounds> bounds(clusters.size());
    tbb::parallel_for(size_t{0}, drafts.size(),
                      [&](size_t i) { bounds[i] = finished(drafts[i], clusters[i], deformation, work); });
    return bounds;
}

} // namespace hearth::skinning

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/skinning/cluster_bounds.h"

#include "cook/skinning/box_search.h"
#include "cook/skinning/deformed_cone.h"
#include "cook/skinning/rounding.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <tbb/parallel_for.h>

namespace hearth::skinning
{

using animation_bounds::Box3d;
using animation_bounds::Interval;

namespace
{

// Number of the heaviest joints that are tried as the main bone: a fourth has never been the best one (bench
// of the sample character and the skinned assets).
constexpr size_t kMaxCandidates = 3;

// Work for tightening the boxes of all loose clusters of a mesh, in influences of vertices along one axis, of
// about 17 ns each. A quarter of it makes boxes of characters of 60 joints a fifth larger.
constexpr size_t kMeshWork = 400'000'000;
constexpr size_t kMaxClusterWork = 10'500'000; ///< of one cluster in the last round

// Minimum share of a cluster. A smaller share has no effect, so meshes with very many loose clusters keep
// their boxes.
constexpr size_t kMinClusterWork = 2'500'000;

// Number of rounds in which work is distributed; later rounds distribute the unused work.
constexpr size_t kRounds = 3;

/// Return the joints that move a vertex, heaviest first.
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

/// Return half the surface area of a box, proportional to its mean projected area.
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
    const std::optional<Box3d> box = computeClusterBox(joint, cluster, deformation, vertices);
    if (box && (!best.box || area(*box) < area(*best.box)))
        best = {joint, box};
}

MainBone mainBone(std::span<const uint32_t> heaviest_first, const DeformedCluster& cluster,
                  const Deformation& deformation, std::span<const MorphedVertex> vertices)
{
    if (deformation.skin == nullptr)
        return {0, computeClusterBox(0, cluster, deformation, vertices)};
    MainBone best{heaviest_first.front(), std::nullopt};
    for (const uint32_t joint : heaviest_first.first(std::min(kMaxCandidates, heaviest_first.size())))
        tryJoint(joint, cluster, deformation, vertices, best);
    for (uint32_t joint = 0; joint < deformation.skin->jointCount() && !best.box; ++joint)
        tryJoint(joint, cluster, deformation, vertices, best);
    return best;
}

/// Return the largest displacement along an axis with all morph weights at 1 or -1.
float morphReach(const DeformedCluster& cluster)
{
    double reach = 0;
    for (size_t v = 0; v < cluster.positions.size(); ++v)
    {
        Double3 sum;
        for (const MorphDeltas& morph : cluster.morphs)
        {
            const Double3 delta = widen(morph.positions[v]);
            sum = sum + Double3{std::abs(delta.x), std::abs(delta.y), std::abs(delta.z)};
        }
        reach = std::max({reach, sum.x, sum.y, sum.z});
    }
    return reach == 0 ? 0.0f
                      : std::nextafter(static_cast<float>(reach), std::numeric_limits<float>::infinity());
}

/// Main bone and box of a cluster, before loose boxes are tightened.
struct Draft
{
    std::vector<uint32_t> joints; ///< joints that move it, heaviest first
    MainBone main;
    std::optional<BoxSearch> search; ///< set for a loose box
};

Draft makeDraft(const DeformedCluster& cluster, const Deformation& deformation)
{
    const std::vector<MorphedVertex> vertices = morphedVertices(cluster, deformation.morph_weights);
    Draft draft;
    draft.joints = influencingJoints(cluster);
    draft.main = mainBone(draft.joints, cluster, deformation, vertices);
    if (draft.main.box && draft.joints.size() > 1 && deformation.regions != nullptr)
    {
        BoxSearch search(*draft.main.box, draft.main.joint, cluster, deformation, vertices);
        if (search.isLoose())
            draft.search = std::move(search);
    }
    return draft;
}

/// Tighten loose boxes. All get the same share of the work; unused work goes to the others.
void tighten(std::vector<Draft>& drafts)
{
    size_t remaining_work = kMeshWork;
    for (size_t round = 0; round < kRounds; ++round)
    {
        std::vector<BoxSearch*> searches;
        for (Draft& draft : drafts)
            if (draft.search && !draft.search->done())
                searches.push_back(&*draft.search);
        if (searches.empty() || remaining_work / searches.size() < kMinClusterWork)
            return;
        const size_t share = std::min(kMaxClusterWork, remaining_work / searches.size()) / (kRounds - round);
        std::vector<size_t> work(searches.size());
        tbb::parallel_for(size_t{0}, searches.size(), [&](size_t i) { work[i] = searches[i]->run(share); });
        remaining_work -= std::min(remaining_work, std::accumulate(work.begin(), work.end(), size_t{0}));
    }
}

DeformedBounds finishBounds(const Draft& draft, const DeformedCluster& cluster,
                            const Deformation& deformation)
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
        box = roundOutwards(draft.search ? draft.search->box() : *draft.main.box);
        cone = computeCone(main, cluster, deformation, vertices, box.center());
    }
    bounds.record.joint = static_cast<uint16_t>(main);
    bounds.record.box_min = box.min;
    bounds.record.box_max = box.max;
    bounds.record.cone_axis = cone.axis;
    bounds.record.cone_cutoff = cone.cutoff;
    bounds.record.cone_back = cone.back;
    bounds.record.morph_reach = morphReach(cluster);
    return bounds;
}

} // namespace

std::optional<Box3d> computeClusterBox(uint32_t main, const DeformedCluster& cluster,
                                       const Deformation& deformation,
                                       std::span<const MorphedVertex> vertices)
{
    Box3d box;
    for (size_t v = 0; v < vertices.size(); ++v)
    {
        const MorphedVertex& vertex = vertices[v];
        Box3d places;
        const double own = deformation.skin == nullptr ? 1.0 : jointWeight(cluster, v, main);
        const double middle[3] = {vertex.middle.x, vertex.middle.y, vertex.middle.z};
        const double half[3] = {vertex.half.x, vertex.half.y, vertex.half.z};
        for (size_t axis = 0; axis < 3; ++axis)
            places[axis] = {own * (middle[axis] - half[axis]), own * (middle[axis] + half[axis])};
        for (size_t i = v * cluster.influences; i < (v + 1) * cluster.influences; ++i)
            if (cluster.weights[i] > 0 && cluster.joints[i] != main)
            {
                const animation_bounds::JointMotion* motion =
                    deformation.skin->relative(main, cluster.joints[i]);
                if (motion == nullptr)
                    return std::nullopt;
                motion->addPositionBox(vertex.middle, vertex.half, cluster.weights[i], places);
            }
        for (size_t axis = 0; axis < 3; ++axis)
        {
            box[axis].add(places[axis].low);
            box[axis].add(places[axis].high);
        }
    }
    return box;
}

std::vector<DeformedBounds> computeClusterBounds(std::span<const DeformedCluster> clusters,
                                                 const Deformation& deformation)
{
    std::vector<Draft> drafts(clusters.size());
    tbb::parallel_for(size_t{0}, drafts.size(),
                      [&](size_t i) { drafts[i] = makeDraft(clusters[i], deformation); });
    tighten(drafts);
    std::vector<DeformedBounds> bounds(clusters.size());
    tbb::parallel_for(size_t{0}, drafts.size(),
                      [&](size_t i) { bounds[i] = finishBounds(drafts[i], clusters[i], deformation); });
    return bounds;
}

} // namespace hearth::skinning

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/skinning/cluster_bounds.h"

#include "cook/skinning/box_search.h"
#include "cook/skinning/cluster_frame.h"
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

// Work for tightening the boxes of a mesh, in influences of vertices along one axis, of about 10 ns each: it
// grows with the number of clusters, in large meshes with that of the loose ones.
constexpr size_t kMinMeshWork = 50'000'000;
constexpr size_t kClusterWork = 1'500'000;
constexpr size_t kLargeMeshWork = 400'000'000;
constexpr size_t kLooseClusterWork = 300'000;
constexpr size_t kMaxClusterWork = 10'500'000; ///< of one cluster in the last round

// Volume after a round relative to the volume before it, from which a cluster gets no more work: its joints
// are too far apart for the work that a mesh may spend.
constexpr double kStuckVolume = 0.95;

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

/// Compute the boxes of a cluster's vertices with this joint as the main bone; nothing if it has no bounds.
std::optional<std::vector<Box3d>> computeVertexBoxes(uint32_t main, const DeformedCluster& cluster,
                                                     const Deformation& deformation,
                                                     std::span<const MorphedVertex> vertices)
{
    std::vector<Box3d> boxes;
    for (size_t v = 0; v < vertices.size(); ++v)
    {
        const MorphedVertex& vertex = vertices[v];
        Box3d& places = boxes.emplace_back();
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
    }
    return boxes;
}

Box3d unite(std::span<const Box3d> boxes)
{
    Box3d all;
    for (const Box3d& box : boxes)
        for (size_t axis = 0; axis < 3; ++axis)
        {
            all[axis].add(box[axis].low);
            all[axis].add(box[axis].high);
        }
    return all;
}

/// Frame of a cluster's box, and the box of the motion that remains.
struct FramedBox
{
    ClusterFrame frame;
    DeformedCluster remainder;
    std::optional<Box3d> box; ///< in the main bone; nothing without bounds
    Double3 distance;         ///< of vertices in the frame from their places in the box, by axis

    Box3d inFrame(Box3d of_main) const
    {
        of_main[0].grow(distance.x);
        of_main[1].grow(distance.y);
        of_main[2].grow(distance.z);
        return of_main;
    }
};

FramedBox frameBox(ClusterFrame frame, const DeformedCluster& cluster, const Deformation& deformation,
                   std::span<const MorphedVertex> vertices)
{
    FramedBox framed{std::move(frame), {}, std::nullopt, {}};
    framed.remainder = framed.frame.remainder(cluster);
    const auto boxes = computeVertexBoxes(framed.frame.main(), framed.remainder, deformation, vertices);
    if (!boxes)
        return framed;
    framed.box = unite(*boxes);
    for (size_t v = 0; v < boxes->size(); ++v)
    {
        const Double3 distance = framed.frame.distance(vertices[v].middle, (*boxes)[v]);
        framed.distance = {std::max(framed.distance.x, distance.x), std::max(framed.distance.y, distance.y),
                           std::max(framed.distance.z, distance.z)};
    }
    return framed;
}

void tryJoint(uint32_t joint, const DeformedCluster& cluster, const Deformation& deformation,
              std::span<const MorphedVertex> vertices, FramedBox& best)
{
    const auto propose = [&](ClusterFrame frame)
    {
        FramedBox framed = frameBox(std::move(frame), cluster, deformation, vertices);
        if (framed.box && (!best.box || area(framed.inFrame(*framed.box)) < area(best.inFrame(*best.box))))
            best = std::move(framed);
    };
    propose(ClusterFrame(joint));
    if (ClusterFrame frame(joint, cluster, deformation); !frame.shares().empty())
        propose(std::move(frame));
}

FramedBox chooseFrame(std::span<const uint32_t> heaviest_first, const DeformedCluster& cluster,
                      const Deformation& deformation, std::span<const MorphedVertex> vertices)
{
    if (deformation.skin == nullptr)
        return frameBox(ClusterFrame(0), cluster, deformation, vertices);
    FramedBox best{ClusterFrame(heaviest_first.front()), {}, std::nullopt, {}};
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

/// Frame and box of a cluster, before loose boxes are tightened.
struct Draft
{
    std::vector<uint32_t> joints; ///< joints that move it, heaviest first
    FramedBox framed{ClusterFrame(0), {}, std::nullopt, {}};
    std::optional<BoxSearch> search; ///< set for a loose box
};

Draft makeDraft(const DeformedCluster& cluster, const Deformation& deformation)
{
    const std::vector<MorphedVertex> vertices = morphedVertices(cluster, deformation.morph_weights);
    Draft draft;
    draft.joints = influencingJoints(cluster);
    draft.framed = chooseFrame(draft.joints, cluster, deformation, vertices);
    const FramedBox& framed = draft.framed;
    if (framed.box && draft.joints.size() > 1 && deformation.regions != nullptr)
    {
        BoxSearch search(*framed.box, framed.frame.main(), framed.remainder, deformation, vertices);
        if (search.isLoose())
            draft.search = std::move(search);
    }
    return draft;
}

/// Return the work that all loose clusters of a mesh may spend.
size_t meshWork(std::span<const Draft> drafts)
{
    const auto loose = std::count_if(drafts.begin(), drafts.end(),
                                     [](const Draft& draft) { return draft.search.has_value(); });
    return std::max(std::min(kMinMeshWork + kClusterWork * drafts.size(), kLargeMeshWork),
                    kLooseClusterWork * static_cast<size_t>(loose));
}

/// Tighten loose boxes. All get the same share of the work; unused work goes to the others.
void tighten(std::vector<Draft>& drafts)
{
    size_t remaining_work = meshWork(drafts);
    for (size_t round = 0; round < kRounds; ++round)
    {
        std::vector<BoxSearch*> searches;
        for (Draft& draft : drafts)
            if (draft.search && !draft.search->done())
                searches.push_back(&*draft.search);
        if (searches.empty())
            return;
        const size_t share = std::min(kMaxClusterWork, remaining_work / searches.size()) / (kRounds - round);
        std::vector<size_t> work(searches.size());
        tbb::parallel_for(size_t{0}, searches.size(),
                          [&](size_t i)
                          {
                              const double before = searches[i]->relativeVolume();
                              work[i] = searches[i]->run(share);
                              if (work[i] > 0 && searches[i]->relativeVolume() > kStuckVolume * before)
                                  searches[i]->giveUp();
                          });
        remaining_work -= std::min(remaining_work, std::accumulate(work.begin(), work.end(), size_t{0}));
    }
}

/// Return the entries of chunk DJNT: the main bone, the other joints of the frame, all others.
std::vector<uint32_t> listJoints(const ClusterFrame& frame, std::span<const uint32_t> joints)
{
    std::vector<uint32_t> list{formats::clusterJoint(frame.main(), 0)};
    for (const FrameShare& share : frame.shares())
        list.push_back(formats::clusterJoint(share.joint, share.share));
    for (const uint32_t joint : joints)
        if (std::none_of(list.begin(), list.end(),
                         [&](uint32_t entry) { return formats::jointIndex(entry) == joint; }))
            list.push_back(formats::clusterJoint(joint, 0));
    return list;
}

DeformedBounds finishBounds(const Draft& draft, const DeformedCluster& cluster,
                            const Deformation& deformation)
{
    const std::vector<MorphedVertex> vertices = morphedVertices(cluster, deformation.morph_weights);
    const FramedBox& framed = draft.framed;
    const uint32_t main = framed.frame.main();
    DeformedBounds bounds{};
    if (deformation.skin != nullptr)
        bounds.joints = listJoints(framed.frame, draft.joints);
    Box3 box{{-kUnbounded, -kUnbounded, -kUnbounded}, {kUnbounded, kUnbounded, kUnbounded}};
    StoredCone cone;
    if (framed.box)
    {
        box = roundOutwards(framed.inFrame(draft.search ? draft.search->box() : *framed.box));
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

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/core/deformation_weights.h"

#include "formats/base/assert.h"
#include "formats/base/double3.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace hearth::clusters
{

namespace
{

// More rows cost more than they gain: a group's vertices seldom have more joints, and the error measures all
// of them anyway.
constexpr size_t kMaxJoints = 12;
constexpr size_t kMaxMorphs = 4;

// Joints without relative motion in any clip count as if they moved by this part of the group: a game may
// pose them.
constexpr double kMinJointLength = 0.1;

// Joints with unbounded motion count as if they turned over.
constexpr double kUnboundedTurn = 2;

/// Return the joints of a group's vertices with the sums of their weights, largest sum first.
std::vector<std::pair<double, uint32_t>> jointSums(const mesh::SourceMesh& vertices,
                                                   std::span<const VertexId> group)
{
    std::map<uint32_t, double> sums;
    for (const VertexId id : group)
        for (size_t set = 0; set < vertices.joint_sets.size(); ++set)
        {
            const uint32_t vertex = toIndex(id);
            const Float4 w = vertices.weight_sets[set][vertex];
            const std::array<float, 4> weights{w.x, w.y, w.z, w.w};
            for (size_t i = 0; i < 4; ++i)
                if (weights[i] > 0)
                    sums[vertices.joint_sets[set][vertex].joint[i]] += double{weights[i]};
        }
    std::vector<std::pair<double, uint32_t>> ordered;
    for (const auto& [joint, sum] : sums)
        ordered.push_back({sum, joint});
    std::stable_sort(ordered.begin(), ordered.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    return ordered;
}

/// Bound the distance that a joint moves the group's positions relative to the main joint, as a mean over the
/// positions.
double jointLength(const PreparedMesh& mesh, const GroupMesh& group, uint32_t main, uint32_t joint)
{
    if (mesh.motion == nullptr || mesh.motion->skin == nullptr)
        return 0;
    const auto departure = mesh.motion->skin->departure(main, joint);
    if (!departure || !std::isfinite(departure->rotation) || !std::isfinite(departure->shift))
        return kUnboundedTurn;
    double sum = 0;
    for (const VertexId vertex : group.vertex_of_wedge)
        sum += hearth::length(widen(mesh.positions()[vertex]) - departure->pivot);
    const double mean = sum / static_cast<double>(group.vertex_of_wedge.size());
    return (departure->rotation * mean + departure->shift) / group.scale;
}

void chooseMorphWeights(const PreparedMesh& mesh, GroupMesh& group)
{
    std::vector<std::pair<float, uint32_t>> moves;
    for (uint32_t target = 0; target < mesh.vertices.morph_targets.size(); ++target)
    {
        const IdSpan<VertexId, const Float3> deltas(mesh.vertices.morph_targets[target].positions);
        float most = 0;
        for (const VertexId vertex : group.vertex_of_wedge)
            most = std::max(most, hearth::length(deltas[vertex]));
        const bool known = mesh.motion != nullptr && target < mesh.motion->max_morph_weights.size();
        const float weight = known ? mesh.motion->max_morph_weights[target] : 1.0f;
        if (most * weight > 0)
            moves.push_back({most * weight, target});
    }
    std::stable_sort(moves.begin(), moves.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    moves.resize(std::min(moves.size(), kMaxMorphs));
    for (const auto& [most, target] : moves)
    {
        const bool known = mesh.motion != nullptr && target < mesh.motion->max_morph_weights.size();
        const float weight = known ? mesh.motion->max_morph_weights[target] : 1.0f;
        group.weights.morphs.push_back({target, static_cast<float>(double{weight} / group.scale)});
    }
}

} // namespace

void chooseDeformationWeights(const PreparedMesh& mesh, GroupMesh& group)
{
    HEARTH_ASSERT(group.scale > 0 && !group.vertex_of_wedge.empty());
    const auto joints = jointSums(mesh.vertices, group.vertex_of_wedge);
    if (!joints.empty())
        group.weights.main_joint = joints.front().second;
    for (size_t i = 1; i < std::min(joints.size(), kMaxJoints + 1); ++i)
    {
        const uint32_t joint = joints[i].second;
        const double length = jointLength(mesh, group, group.weights.main_joint, joint);
        group.weights.joints.push_back({joint, static_cast<float>(std::max(length, kMinJointLength))});
    }
    chooseMorphWeights(mesh, group);
    HEARTH_ASSERT(group.weights.joints.size() <= kMaxJoints && group.weights.morphs.size() <= kMaxMorphs);
}

} // namespace hearth::clusters

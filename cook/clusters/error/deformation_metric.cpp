// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/error/deformation_metric.h"

#include "formats/base/assert.h"

#include <algorithm>
#include <cmath>

namespace hearth::clusters
{

namespace
{

/// Maximum joints of a vertex: two sets.
constexpr size_t kMaxVertexInfluences = 8;

/// Maximum joints of the triangles of two points.
constexpr size_t kMaxPairJoints = 6 * kMaxVertexInfluences;

double component(const Float4& weights, size_t i)
{
    return double{i == 0 ? weights.x : i == 1 ? weights.y : i == 2 ? weights.z : weights.w};
}

/// Difference of two points in one joint's terms.
struct JointDifference
{
    uint32_t joint;
    double weight = 0;
    Double3 moved; ///< of weight * position
};

/// Differences for all joints of the vertices of either point's triangle.
class JointDifferences
{
public:
    void add(const DeformedPoint& point, double sign)
    {
        for (size_t k = 0; k < 3; ++k)
            for (const auto& influence : point.surface->influences(point.wedges[k]))
            {
                JointDifference& difference = findOrAdd(influence.joint);
                const double weight = sign * point.parts[k] * influence.weight;
                difference.weight += weight;
                difference.moved = difference.moved + point.surface->place(point.wedges[k]) * weight;
            }
    }

    std::span<const JointDifference> all() const { return std::span(differences_).first(count_); }

private:
    JointDifference& findOrAdd(uint32_t joint)
    {
        for (size_t i = 0; i < count_; ++i)
            if (differences_[i].joint == joint)
                return differences_[i];
        HEARTH_ASSERT(count_ < kMaxPairJoints);
        differences_[count_] = {joint, 0, {}};
        return differences_[count_++];
    }

    std::array<JointDifference, kMaxPairJoints> differences_;
    size_t count_ = 0;
};

Double3 interpolatePosition(const DeformedPoint& point)
{
    Double3 place;
    for (size_t k = 0; k < 3; ++k)
        place = place + point.surface->place(point.wedges[k]) * point.parts[k];
    return place;
}

/// Return the sum over the triangle's vertices of part * weight of `joint` * delta of `target`.
Double3 weightedDelta(const DeformedPoint& point, uint32_t joint, size_t target)
{
    Double3 sum;
    for (size_t k = 0; k < 3; ++k)
        for (const auto& influence : point.surface->influences(point.wedges[k]))
            if (influence.joint == joint)
                sum = sum +
                      point.surface->deltas(point.wedges[k])[target] * (point.parts[k] * influence.weight);
    return sum;
}

Double3 interpolateDelta(const DeformedPoint& point, size_t target)
{
    Double3 sum;
    for (size_t k = 0; k < 3; ++k)
        sum = sum + point.surface->deltas(point.wedges[k])[target] * point.parts[k];
    return sum;
}

} // namespace

void DeformedSurface::add(Float3 place, const mesh::SourceMesh& source, uint32_t vertex, double scale)
{
    HEARTH_ASSERT(vertex < source.vertexCount() && scale > 0);
    HEARTH_ASSERT(places_.empty() || delta_count_ == source.morph_targets.size());
    places_.push_back(widen(place));
    for (size_t set = 0; set < source.joint_sets.size(); ++set)
        for (size_t i = 0; i < 4; ++i)
            if (const double weight = component(source.weight_sets[set][vertex], i); weight > 0)
                influences_.push_back({source.joint_sets[set][vertex].joint[i], weight});
    first_influence_.push_back(influences_.size());
    delta_count_ = source.morph_targets.size();
    for (const mesh::MorphTarget& target : source.morph_targets)
        deltas_.push_back(widen(target.positions[vertex]) * (1 / scale));
}

DeformationMetric::DeformationMetric(Double3 center, double scale, const MeshMotion& motion)
    : center_(center), scale_(scale), motion_(motion)
{
    HEARTH_ASSERT(scale > 0);
}

const DeformationMetric::IdentityDeviation& DeformationMetric::departure(uint32_t main, uint32_t joint)
{
    std::vector<IdentityDeviation>& row = departures_[main];
    if (row.size() <= joint)
        row.resize(joint + size_t{1});
    IdentityDeviation& departure = row[joint];
    if (departure.state != IdentityDeviation::State::unknown)
        return departure;
    departure.state = IdentityDeviation::State::bounded;
    if (motion_.skin == nullptr || main == joint)
        return departure;
    const std::optional<animation_bounds::IdentityDeviation> found = motion_.skin->departure(main, joint);
    if (!found || !std::isfinite(found->rotation) || !std::isfinite(found->shift))
    {
        departure.state = IdentityDeviation::State::unbounded;
        return departure;
    }
    departure.pivot = (found->pivot - center_) * (1 / scale_);
    departure.rotation = found->rotation;
    departure.shift = found->shift / scale_;
    return departure;
}

std::optional<uint32_t> DeformationMetric::mainJoint(const DeformedPoint& point,
                                                     std::span<const DeformedPoint> others)
{
    JointDifferences own;
    own.add(point, 1);
    std::vector<JointDifference> candidates(own.all().begin(), own.all().end());
    if (candidates.empty())
        return 0u;
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const JointDifference& a, const JointDifference& b) { return a.weight > b.weight; });
    std::vector<uint32_t> joints;
    const auto addJoints = [&](const DeformedPoint& of)
    {
        for (const WedgeId wedge : of.wedges)
            for (const auto& influence : of.surface->influences(wedge))
                if (std::find(joints.begin(), joints.end(), influence.joint) == joints.end())
                    joints.push_back(influence.joint);
    };
    addJoints(point);
    for (const DeformedPoint& other : others)
        addJoints(other);
    const auto boundsAll = [&](uint32_t main)
    {
        return std::all_of(joints.begin(), joints.end(),
                           [&](uint32_t joint)
                           { return departure(main, joint).state == IdentityDeviation::State::bounded; });
    };
    for (const JointDifference& candidate : candidates)
        if (boundsAll(candidate.joint))
            return candidate.joint;
    for (uint32_t joint = 0; motion_.skin != nullptr && joint < motion_.skin->jointCount(); ++joint)
        if (boundsAll(joint))
            return joint;
    return std::nullopt;
}

double DeformationMetric::between(const DeformedPoint& a, const DeformedPoint& b, uint32_t main)
{
    HEARTH_RUNTIME_ASSERT(a.surface->deltas(a.wedges[0]).size() == b.surface->deltas(b.wedges[0]).size());
    double sum = length(interpolatePosition(a) - interpolatePosition(b));
    JointDifferences differences;
    differences.add(a, 1);
    differences.add(b, -1);
    for (const JointDifference& difference : differences.all())
    {
        if (difference.joint == main)
            continue;
        const IdentityDeviation& d = departure(main, difference.joint);
        sum += d.rotation * length(difference.moved - d.pivot * difference.weight) +
               d.shift * std::abs(difference.weight);
    }
    return sum + morphTerm(a, b, main);
}

double DeformationMetric::morphTerm(const DeformedPoint& a, const DeformedPoint& b, uint32_t main)
{
    const size_t targets = a.surface->deltas(a.wedges[0]).size();
    double sum = 0;
    for (size_t target = 0; target < targets; ++target)
    {
        double difference = length(interpolateDelta(a, target) - interpolateDelta(b, target));
        JointDifferences joints;
        joints.add(a, 1);
        joints.add(b, -1);
        for (const JointDifference& of : joints.all())
            if (of.joint != main)
                difference += departure(main, of.joint).rotation *
                              length(weightedDelta(a, of.joint, target) - weightedDelta(b, of.joint, target));
        const double max_weight =
            target < motion_.max_morph_weights.size() ? double{motion_.max_morph_weights[target]} : 1.0;
        sum += max_weight * difference;
    }
    return sum;
}

} // namespace hearth::clusters

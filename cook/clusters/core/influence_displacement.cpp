// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/core/influence_displacement.h"

#include "formats/base/assert.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <unordered_map>

namespace hearth::clusters
{

namespace
{

struct JointChange
{
    uint16_t joint;
    double all = 0;  ///< weight before
    double kept = 0; ///< weight now
    double difference() const { return all - kept; }
};

/// Joints of one vertex, each once, with their weights before and now.
class JointChanges
{
public:
    JointChanges(const mesh::SourceMesh& all, const mesh::SourceMesh& kept, size_t vertex)
    {
        add(all, vertex, &JointChange::all);
        add(kept, vertex, &JointChange::kept);
        normalize(&JointChange::all);
        normalize(&JointChange::kept);
    }

    bool lostAny() const
    {
        return std::any_of(changes_.begin(), changes_.end(),
                           [](const JointChange& change) { return change.all > 0 && change.kept == 0; });
    }
    const std::vector<JointChange>& list() const { return changes_; }

private:
    void add(const mesh::SourceMesh& mesh, size_t vertex, double JointChange::*weight)
    {
        for (size_t set = 0; set < mesh.joint_sets.size(); ++set)
        {
            const Float4 w = mesh.weight_sets[set][vertex];
            const float weights[4] = {w.x, w.y, w.z, w.w};
            for (size_t i = 0; i < 4; ++i)
                if (weights[i] > 0)
                    findOrAdd(mesh.joint_sets[set][vertex].joint[i]).*weight += double{weights[i]};
        }
    }

    void normalize(double JointChange::*weight)
    {
        double sum = 0;
        for (const JointChange& change : changes_)
            sum += change.*weight;
        for (JointChange& change : changes_)
            change.*weight /= sum;
    }

    JointChange& findOrAdd(uint16_t joint)
    {
        for (JointChange& change : changes_)
            if (change.joint == joint)
                return change;
        return changes_.emplace_back(JointChange{joint});
    }

    std::vector<JointChange> changes_;
};

/// Bound the displacement by morph targets on each axis.
Double3 morphReach(const mesh::SourceMesh& mesh, size_t vertex, const MeshMotion& motion)
{
    Double3 reach;
    for (size_t target = 0; target < mesh.morph_targets.size(); ++target)
    {
        const double most =
            target < motion.max_morph_weights.size() ? double{motion.max_morph_weights[target]} : 1.0;
        const Double3 delta = widen(mesh.morph_targets[target].positions[vertex]);
        reach = reach + Double3{std::abs(delta.x), std::abs(delta.y), std::abs(delta.z)} * most;
    }
    return reach;
}

/// Bounds the displacement of single vertices.
class VertexDisplacement
{
public:
    enum class Search : uint8_t
    {
        quick,
        tight, ///< visits the hulls of the joints' relative motions, which takes longer
    };

    VertexDisplacement(const mesh::SourceMesh& mesh, const MeshMotion& motion) : mesh_(mesh), motion_(motion)
    {
    }

    /// Bound the displacement of a vertex. Weight goes from joints that lost some to joints that gained,
    /// shortest distances first: any transport plan gives a bound.
    std::optional<double> operator()(const JointChanges& changes, size_t vertex, Search search)
    {
        struct Transfer
        {
            size_t from, to;
            double length;
        };
        const std::vector<JointChange>& list = changes.list();
        std::vector<Transfer> transfers;
        std::vector<double> remaining;
        for (const JointChange& change : list)
            remaining.push_back(std::abs(change.difference()));
        for (size_t from = 0; from < list.size(); ++from)
            for (size_t to = 0; to < list.size(); ++to)
                if (list[from].difference() > 0 && list[to].difference() < 0)
                {
                    const auto length = jointDistance(list, list[from].joint, list[to].joint, vertex, search);
                    if (!length)
                        return std::nullopt;
                    transfers.push_back({from, to, *length});
                }
        std::stable_sort(transfers.begin(), transfers.end(),
                         [](const Transfer& a, const Transfer& b) { return a.length < b.length; });
        double sum = 0;
        for (const Transfer& transfer : transfers)
        {
            const double sent = std::min(remaining[transfer.from], remaining[transfer.to]);
            remaining[transfer.from] -= sent;
            remaining[transfer.to] -= sent;
            sum += sent * transfer.length;
        }
        return sum;
    }

private:
    /// Bound the distance between the positions that two joints give the vertex; over a third joint if
    /// neither bounds it relative to the other.
    std::optional<double> jointDistance(std::span<const JointChange> joints, uint32_t a, uint32_t b,
                                        size_t vertex, Search search)
    {
        const std::optional<double> there = relativeDistance(a, b, vertex, search),
                                    back = relativeDistance(b, a, vertex, search);
        if (there && back)
            return std::min(*there, *back);
        if (there || back)
            return there ? there : back;
        std::optional<double> least;
        for (const JointChange& hub : joints)
        {
            const auto to_a = relativeDistance(hub.joint, a, vertex, search),
                       to_b = relativeDistance(hub.joint, b, vertex, search);
            if (to_a && to_b)
                least = std::min(least.value_or(*to_a + *to_b), *to_a + *to_b);
        }
        return least;
    }

    /// Bound the distance that `joint` moves the vertex relative to `main`. Distance is convex: its maximum
    /// is at a corner of the hull.
    std::optional<double> relativeDistance(uint32_t main, uint32_t joint, size_t vertex, Search search)
    {
        const std::optional<animation_bounds::IdentityDeviation>& departure = findDeparture(main, joint);
        if (!departure)
            return std::nullopt;
        const Double3 place = widen(mesh_.positions[vertex]);
        const double morphed = departure->rotation * length(morphReach(mesh_, vertex, motion_));
        const double quick = departure->rotation * length(place - departure->pivot) + departure->shift;
        if (search == Search::quick || main == joint)
            return quick + morphed;
        const animation_bounds::MatrixSet& set = motion_.skin->relative(main, joint)->set();
        double farthest = 0;
        for (const Affine3d& corner : set.hull)
            farthest = std::max(farthest, length(transformPoint(corner, place) - place));
        return std::min(quick, farthest + set.linear_slack * length(place - set.pivot) + set.point_slack) +
               morphed;
    }

    const std::optional<animation_bounds::IdentityDeviation>& findDeparture(uint32_t main, uint32_t joint)
    {
        const auto [entry, is_new] = departures_.try_emplace(uint64_t{main} << 32 | joint);
        if (is_new)
            entry->second =
                main == joint ? animation_bounds::IdentityDeviation{} : motion_.skin->departure(main, joint);
        return entry->second;
    }

    const mesh::SourceMesh& mesh_;
    const MeshMotion& motion_;
    std::unordered_map<uint64_t, std::optional<animation_bounds::IdentityDeviation>> departures_;
};

} // namespace

std::optional<double> influenceDisplacement(const mesh::SourceMesh& all, const mesh::SourceMesh& kept,
                                            const MeshMotion& motion)
{
    HEARTH_ASSERT(motion.skin != nullptr);
    HEARTH_ASSERT(!all.joint_sets.empty() && all.joint_sets.front().size() == kept.vertexCount());
    using Search = VertexDisplacement::Search;
    struct Candidate
    {
        size_t vertex;
        double quick;
    };
    VertexDisplacement displacement(kept, motion);
    std::vector<Candidate> candidates;
    for (size_t v = 0; v < kept.vertexCount(); ++v)
    {
        const JointChanges changes(all, kept, v);
        if (!changes.lostAny())
            continue;
        const std::optional<double> quick = displacement(changes, v, Search::quick);
        if (!quick)
            return std::nullopt;
        candidates.push_back({v, *quick});
    }
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.quick > b.quick; });
    double most = 0;
    for (const Candidate& candidate : candidates)
    {
        if (candidate.quick <= most)
            break;
        const auto tight =
            displacement(JointChanges(all, kept, candidate.vertex), candidate.vertex, Search::tight);
        HEARTH_ASSERT(tight.has_value());
        most = std::max(most, std::min(candidate.quick, *tight));
    }
    return most;
}

} // namespace hearth::clusters

// Half-edge collapses ordered by quadric error; see quadric.h for the papers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/simplify/simplify.h"

#include "cook/clusters/simplify/collapse_heap.h"
#include "cook/clusters/simplify/quadric.h"
#include "cook/clusters/simplify/star_mesh.h"
#include "cook/clusters/simplify/thinning.h"
#include "cook/clusters/simplify/triangle_flip.h"
#include "cook/clusters/simplify/wedge_map.h"
#include "formats/base/assert.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace hearth::clusters
{

namespace
{

// Collapses without jumps that end within this factor of the target are good enough.
constexpr double kTargetTolerance = 1.1;

struct Candidate
{
    float cost;
    PositionId target;
    /// Else the cost is a lower bound, until the wedges without an edge along the collapse have targets.
    bool exact;

    bool operator<(const Candidate& b) const { return cost != b.cost ? cost < b.cost : target < b.target; }
};

class Collapser
{
public:
    explicit Collapser(const GroupMesh& group)
        : group_(group),
          mesh_(group),
          wedges_(group, mesh_),
          quadrics_(computeQuadrics(group)),
          version_(group.positions.size(), 0),
          best_target_(group.positions.size(), kInvalid),
          outdated_(group.positions.size(), 0),
          target_(group.positions.size()),
          edge_planes_added_(group.positions.size(), 0),
          wedge_blocked_(group.positions.size(), 0),
          is_target_(group.positions.size(), 0)
    {
        for (const PositionId position : target_.ids())
            target_[position] = position;
    }

    size_t triangleCount() const { return mesh_.aliveCount(); }

    /// Collapse until `target_triangles` are left or no collapse is valid. `permissive` is for a second pass:
    /// it only reconsiders positions whose wedges blocked a collapse.
    void collapseUntil(size_t target_triangles, bool permissive)
    {
        begin(permissive);
        while (mesh_.aliveCount() > target_triangles && !heap_.empty())
            step();
    }

    /// Collapse until the cost is reached. Returns the target number of triangles; nothing if collapses run
    /// out before it is known.
    std::optional<size_t> collapseUntil(const CostStop& stop)
    {
        begin(false);
        size_t target = stop.min_triangles;
        bool too_costly = false;
        while (mesh_.aliveCount() > target && !heap_.empty())
        {
            if (!too_costly && nextCost() > stop.cost)
            {
                too_costly = true;
                target =
                    std::max(target, roundToFullClusters(std::min(mesh_.aliveCount(), stop.max_triangles)));
            }
            else
                step();
        }
        return too_costly || mesh_.aliveCount() <= target ? std::optional(target) : std::nullopt;
    }

    std::vector<CollapseStep> costsUntil(size_t target_triangles)
    {
        begin(false);
        std::vector<CollapseStep> steps;
        double cost = 0;
        while (mesh_.aliveCount() > target_triangles && !heap_.empty())
        {
            cost = std::max(cost, nextCost());
            const size_t before = mesh_.aliveCount();
            step();
            if (mesh_.aliveCount() < before)
                steps.push_back({cost, mesh_.aliveCount()});
        }
        return steps;
    }

    bool pruneIslands(size_t target_triangles);

    SimplifiedGroup result();

private:
    void begin(bool permissive)
    {
        wedges_.permissive = permissive;
        heap_.clear();
        for (const PositionId position : target_.ids())
            if (target_[position] == position && group_.locked[position] == 0 &&
                (!permissive || wedge_blocked_[position] != 0))
                evaluate(position);
    }
    /// Return the cost of the next collapse, in object space: no later one costs less.
    double nextCost() const
    {
        const double scale2 = group_.scale * group_.scale;
        return double{heap_.front().cost()} * scale2 * scale2;
    }
    void addEdgePlanes(PositionId position);
    void gather(PositionId position)
    {
        if (!mesh_.gatherFan(position))
            mesh_.gather(position);
    }
    void evaluate(PositionId position)
    {
        gather(position);
        evaluateGathered(position);
    }
    template <typename Visit>
    void forEachOfFan(PositionId position, Visit visit) const;
    float cost(PositionId from, PositionId to) const;
    void gatherCandidates(PositionId position, bool along_seams);
    void push(PositionId position, Candidate candidate);
    std::optional<Candidate> nextCandidate(PositionId position);
    void evaluateGathered(PositionId position);
    void evaluateValid(PositionId position, float popped_cost);
    bool flipsTriangle(PositionId from, PositionId to);
    bool valid(PositionId from, PositionId to)
    {
        return mesh_.satisfiesLinkCondition(from, to) && !flipsTriangle(from, to);
    }
    void step();
    void updateNeighbours(PositionId center);

    const GroupMesh& group_;
    StarMesh mesh_;
    WedgeMap wedges_; ///< of the gathered position
    Quadrics quadrics_;
    IdVector<PositionId, uint32_t> version_;       ///< heap entries with another version are stale
    IdVector<PositionId, PositionId> best_target_; ///< target of the heap entry, or kInvalid
    IdVector<PositionId, uint8_t> outdated_;       ///< 1 if the cost in the heap dates from before a collapse
    IdVector<PositionId, PositionId> target_;      ///< next position for removed ones
    IdVector<PositionId, uint8_t> edge_planes_added_; ///< 1 if addEdgePlanes was called
    IdVector<PositionId, uint8_t> wedge_blocked_; ///< 1 if wedges without an edge along it blocked a collapse
    IdVector<PositionId, uint8_t> is_target_;     ///< 1 for positions that others collapsed to
    CollapseHeap heap_;
    Growth growth_;

    // scratch
    std::vector<Candidate> candidates_;
    std::vector<PositionId> around_;
};

/// Add planes that hold open borders, edges of more than two triangles, and seams at the gathered position.
/// Each end of an edge adds its own when its collapses are first evaluated.
void Collapser::addEdgePlanes(PositionId position)
{
    edge_planes_added_[position] = 1;
    const Float3 place = group_.positions[position];
    const auto hold = [&](PositionId end, PositionId tip)
    {
        const Spoke& spoke = *mesh_.spokeTo(end);
        const bool regular = spoke.regular(mesh_.layers());
        if (regular && spoke.out.from == spoke.in.from && spoke.out.to == spoke.in.to)
            return;
        quadrics_.position[position].add(edgeQuadric(group_.positions[end] - place,
                                                     group_.positions[tip] - place,
                                                     regular ? kSeamWeight : kBorderWeight));
    };
    for (const StarCorner corner : mesh_.star(position))
    {
        const PositionId next = mesh_.positionIdAt(nextCorner(corner));
        const PositionId previous = mesh_.positionIdAt(previousCorner(corner));
        hold(next, previous);
        hold(previous, next);
    }
}

/// Return the quadric error of the collapse that wedges_ describes. Wedges without an edge along it count
/// with the smallest error of any attributes.
float Collapser::cost(PositionId from, PositionId to) const
{
    const Float3 t = group_.positions[to] - group_.positions[from];
    const LaneVector t_lanes = splat(t);
    Lanes attribute_error{};
    for (const WedgeMove& move : wedges_.moves())
        attribute_error += quadrics_.attributeError(group_, move, t_lanes);
    if (!wedges_.complete())
        for (const WedgeId wedge : mesh_.wedges())
            if (!wedges_.has(wedge))
                attribute_error -= quadrics_.maxAttributeGain(group_, wedge, t_lanes);
    return std::max(quadrics_.position[from].at(t) + sumOfLanes(attribute_error), 0.0f);
}

/// Call `visit` with each collapse of the gathered fan, with the last one up to four times.
template <typename Visit>
void Collapser::forEachOfFan(PositionId position, Visit visit) const
{
    if (mesh_.degree(position) <= 2)
        return;
    const Float3 place = group_.positions[position];
    const auto fan = mesh_.fan();
    for (size_t first = 0; first < fan.size(); first += kLanes)
    {
        // unused lanes repeat the last end
        const auto end = [&](size_t i) { return fan[std::min(first + i, fan.size() - 1)]; };
        const std::array<FanEnd, kLanes> ends{end(0), end(1), end(2), end(3)};
        const auto to = [&](size_t i) { return group_.positions[ends[i].position] - place; };
        const std::array<Float3, kLanes> t{to(0), to(1), to(2), to(3)};
        const LaneVector t_lanes{{t[0].x, t[1].x, t[2].x, t[3].x},
                                 {t[0].y, t[1].y, t[2].y, t[3].y},
                                 {t[0].z, t[1].z, t[2].z, t[3].z}};
        const Lanes costs = maximum(
            quadrics_.errorsOfFour(group_, position, mesh_.fanWedge(),
                                   {ends[0].wedge, ends[1].wedge, ends[2].wedge, ends[3].wedge}, t_lanes),
            Lanes{});
        for (size_t i = 0; i < kLanes; ++i)
            if (mesh_.degree(ends[i].position) > 2)
                visit(Candidate{costs[i], ends[i].position, true});
    }
}

/// Collect all collapses of the gathered position that respect borders and wedges in candidates_.
/// along_seams  if a candidate keeps two wedges along it, leave out those that keep fewer
void Collapser::gatherCandidates(PositionId position, bool along_seams)
{
    candidates_.clear();
    wedge_blocked_[position] = 0;
    if (mesh_.plain())
    {
        edge_planes_added_[position] = 1;
        forEachOfFan(position, [&](const Candidate& candidate) { candidates_.push_back(candidate); });
        return;
    }
    const auto ring = mesh_.ring();
    if (std::all_of(ring.begin(), ring.end(), [&](const Spoke& s) { return mesh_.emptiesStar(position, s); }))
        return;
    if (edge_planes_added_[position] == 0)
        addEdgePlanes(position);
    // an edge connects two charts at most
    if (!wedges_.permissive && mesh_.layers() == 1 && wedges_.hasMoreThanTwoCharts())
    {
        wedge_blocked_[position] = 1;
        return;
    }
    const auto irregular =
        std::count_if(ring.begin(), ring.end(), [&](const Spoke& s) { return !s.regular(mesh_.layers()); });
    if (irregular != 0 && irregular != 2)
        return;
    const auto possible = [&](const Spoke& spoke)
    { return (irregular == 0 || !spoke.regular(mesh_.layers())) && !mesh_.emptiesStar(position, spoke); };
    along_seams =
        along_seams && std::any_of(ring.begin(), ring.end(),
                                   [&](const Spoke& spoke) { return possible(spoke) && spoke.onSeam(); });
    for (const Spoke& spoke : ring)
    {
        if (!possible(spoke) || (along_seams && !spoke.onSeam()))
            continue;
        if (wedges_.mapAlong(position, spoke))
            candidates_.push_back({cost(position, spoke.position), spoke.position, wedges_.complete()});
        else
            wedge_blocked_[position] = 1;
    }
}

void Collapser::push(PositionId position, Candidate candidate)
{
    best_target_[position] = candidate.target;
    heap_.push({candidate.cost, position, candidate.target, version_[position]});
}

/// Remove the cheapest candidate from the list and return it; nullopt if the list is empty.
std::optional<Candidate> Collapser::nextCandidate(PositionId position)
{
    while (!candidates_.empty())
    {
        const auto cheapest = std::min_element(candidates_.begin(), candidates_.end());
        if (cheapest->exact)
        {
            const Candidate candidate = *cheapest;
            *cheapest = candidates_.back();
            candidates_.pop_back();
            return candidate;
        }
        wedges_.mapAlong(position, *mesh_.spokeTo(cheapest->target));
        wedges_.mapRemaining(cheapest->target);
        cheapest->cost = cost(position, cheapest->target);
        cheapest->exact = true;
    }
    return std::nullopt;
}

/// Push the cheapest collapse of the gathered position to the heap; its validity is tested when it is popped.
void Collapser::evaluateGathered(PositionId position)
{
    ++version_[position];
    outdated_[position] = 0;
    best_target_[position] = kInvalid;
    if (mesh_.plain())
    {
        wedge_blocked_[position] = 0;
        edge_planes_added_[position] = 1;
        Candidate best{std::numeric_limits<float>::infinity(), kInvalid, true};
        forEachOfFan(position, [&](const Candidate& candidate) { best = std::min(best, candidate); });
        if (best.target != kInvalid)
            push(position, best);
        return;
    }
    gatherCandidates(position, wedges_.permissive);
    if (const auto candidate = nextCandidate(position))
        push(position, *candidate);
}

/// Push the cheapest valid collapse of the gathered position to the heap.
void Collapser::evaluateValid(PositionId position, float popped_cost)
{
    ++version_[position];
    outdated_[position] = 0;
    best_target_[position] = kInvalid;
    gatherCandidates(position, false);
    while (auto candidate = nextCandidate(position))
        if (valid(position, candidate->target))
        {
            candidate->cost = std::max(candidate->cost, popped_cost);
            push(position, *candidate);
            return;
        }
}

/// Tests all triangles: few flip, and a branch on the removed ones would be unpredictable.
bool Collapser::flipsTriangle(PositionId from, PositionId to)
{
    uint32_t turned = 0;
    for (const StarCorner corner : mesh_.star(from))
    {
        const PositionId next = mesh_.positionIdAt(nextCorner(corner));
        const PositionId previous = mesh_.positionIdAt(previousCorner(corner));
        const bool turns = moveFlipsTriangle(group_.positions[next], group_.positions[previous],
                                             group_.positions[from], group_.positions[to]);
        turned |= static_cast<uint32_t>(turns) & static_cast<uint32_t>(next != to) &
                  static_cast<uint32_t>(previous != to);
    }
    return turned != 0;
}

/// Update the positions around `center` after a collapse to it. Its own cost has probably risen and is
/// evaluated again when popped, like that of positions whose target is gone. Positions without a candidate
/// may have one now.
void Collapser::updateNeighbours(PositionId center)
{
    outdated_[center] = 1;
    around_.clear();
    const auto note = [&](PositionId position)
    {
        if (best_target_[position] == kInvalid && group_.locked[position] == 0)
            around_.push_back(position);
    };
    note(center);
    for (const StarCorner corner : mesh_.star(center))
    {
        note(mesh_.positionIdAt(nextCorner(corner)));
        note(mesh_.positionIdAt(previousCorner(corner)));
    }
    std::sort(around_.begin(), around_.end());
    around_.erase(std::unique(around_.begin(), around_.end()), around_.end());
    for (const PositionId position : around_)
        evaluate(position);
}

void Collapser::step()
{
    const HeapEntry entry = heap_.pop();
    if (entry.version() != version_[entry.position()])
        return;
    gather(entry.position());
    if (outdated_[entry.position()] != 0 || mesh_.degree(entry.target()) == 0)
    {
        evaluateGathered(entry.position());
        return;
    }
    if (!wedges_.mapTo(entry.position(), entry.target()) || !valid(entry.position(), entry.target()))
    {
        evaluateValid(entry.position(), entry.cost());
        return;
    }
    wedges_.mapRemaining(entry.target());
    if (group_.locked[entry.target()] == 0) // quadrics of locked positions are not used
        quadrics_.move(group_, entry.position(), entry.target(), wedges_.moves());
    mesh_.collapse(entry.position(), entry.target(), wedges_.moves());
    target_[entry.position()] = entry.target();
    is_target_[entry.target()] = 1;
    ++version_[entry.position()];
    updateNeighbours(entry.target());
}

bool Collapser::pruneIslands(size_t target_triangles)
{
    Thinning thinning = thinIslands(group_, mesh_, target_triangles, target_);
    growth_ = std::move(thinning.growth);
    return thinning.pruned;
}

SimplifiedGroup Collapser::result()
{
    SimplifiedGroup result;
    result.source_triangle = mesh_.aliveTriangles();
    result.corners.reserve(mesh_.aliveCount() * 3);
    result.materials.reserve(mesh_.aliveCount());
    for (const TriangleId triangle : result.source_triangle)
    {
        for (const StarCorner corner : StarMesh::triangleCorners(triangle))
            result.corners.push_back(mesh_.wedgeAt(corner));
        result.materials.push_back(group_.materials[triangle]);
    }
    result.target_of_position.resize(target_.size());
    for (const PositionId position : target_.ids())
    {
        PositionId target = position;
        while (target != kPruned && target_[target] != target)
            target = target_[target];
        result.target_of_position[position] = target;
    }
    for (const PositionId position : target_.ids())
    {
        const bool left = target_[position] == position, free = group_.locked[position] == 0,
                   asked = edge_planes_added_[position] != 0;
        const bool may_move = left & free & asked & !group_.positions_fixed;
        is_target_[position] &= may_move ? 1 : 0;
    }
    result.placement = optimizePlacement(group_, mesh_, quadrics_, is_target_);
    growIslands(group_, growth_, result.placement);
    return result;
}

/// True if no locked position is removed or moved.
[[maybe_unused]] bool lockedStay(const GroupMesh& group, const SimplifiedGroup& simplified)
{
    const auto positions = group.locked.ids();
    return std::all_of(positions.begin(), positions.end(),
                       [&](PositionId position)
                       {
                           return group.locked[position] == 0 ||
                                  (simplified.target_of_position[position] == position &&
                                   simplified.placement.modified[position] == 0);
                       });
}

} // namespace

std::vector<CollapseStep> collapseCosts(const GroupMesh& group, size_t least)
{
    HEARTH_ASSERT(least > 0);
    std::vector<CollapseStep> steps = Collapser(group).costsUntil(least);
    HEARTH_RUNTIME_ASSERT(std::is_sorted(steps.begin(), steps.end(),
                                         [](const CollapseStep& a, const CollapseStep& b)
                                         { return a.cost < b.cost; }));
    return steps;
}

SimplifiedGroup simplifyGroup(const GroupMesh& group, size_t target_triangles, size_t max_triangles,
                              const std::optional<CostStop>& stop)
{
    HEARTH_ASSERT(target_triangles > 0 && group.triangleCount() > 0);
    HEARTH_ASSERT(group.locked.size() == group.positions.size());
    HEARTH_ASSERT(!stop || (stop->min_triangles > 0 && stop->min_triangles <= stop->max_triangles));
    Collapser collapser(group);
    bool permissive = false;
    bool pruned = false;
    if (stop)
        target_triangles = collapser.collapseUntil(*stop).value_or(target_triangles);
    else
        collapser.collapseUntil(target_triangles, false);
    const auto near_target =
        std::min(static_cast<size_t>(static_cast<double>(target_triangles) * kTargetTolerance),
                 std::max(max_triangles, target_triangles));
    if (collapser.triangleCount() > near_target)
    {
        const size_t before = collapser.triangleCount();
        collapser.collapseUntil(target_triangles, true);
        permissive = collapser.triangleCount() < before;
    }
    if (collapser.triangleCount() > near_target)
        pruned = collapser.pruneIslands(target_triangles);
    SimplifiedGroup result = collapser.result();
    result.permissive = permissive;
    result.pruned = pruned;
    HEARTH_ASSERT(result.triangleCount() > 0 && result.triangleCount() <= group.triangleCount());
    HEARTH_ASSERT(result.materials.size() == result.triangleCount() &&
                  result.source_triangle.size() == result.triangleCount());
    HEARTH_RUNTIME_ASSERT(lockedStay(group, result));
    return result;
}

} // namespace hearth::clusters

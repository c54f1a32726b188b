// Half-edge collapses ordered by quadric error; see quadric.h for the papers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/simplify/simplify.h"

#include "cook/clusters/simplify/collapse_heap.h"
#include "cook/clusters/simplify/quadric.h"
#include "cook/clusters/simplify/star_mesh.h"
#include "cook/clusters/simplify/thinning.h"
#include "cook/clusters/simplify/turning.h"
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

constexpr uint32_t kNoPosition = 0xFFFFFFFFu;

// Strict collapses that end within this of the target are good enough.
constexpr double kNearTarget = 1.1;

struct Candidate
{
    float cost;
    uint32_t target;
    bool exact; ///< else the cost is a lower bound, for as long as the wedges without a way have no goals

    bool operator<(const Candidate& b) const { return cost != b.cost ? cost < b.cost : target < b.target; }
};

class Collapser
{
public:
    explicit Collapser(const GroupMesh& group)
        : group_(group),
          mesh_(group),
          wedges_(group, mesh_),
          quadrics_(initialQuadrics(group)),
          version_(group.positions.size(), 0),
          best_target_(group.positions.size(), kNoPosition),
          outdated_(group.positions.size(), 0),
          target_(group.positions.size()),
          edges_held_(group.positions.size(), 0),
          wedge_blocked_(group.positions.size(), 0),
          grown_(group.positions.size(), 0)
    {
        for (uint32_t p = 0; p < target_.size(); ++p)
            target_[p] = p;
    }

    size_t triangleCount() const { return mesh_.aliveCount(); }

    /// Collapse until so many triangles are left or nothing more can go. `permissive` is for a second time: only the
    /// positions that wedges held back have anything new to offer.
    void collapseUntil(size_t target_triangles, bool permissive)
    {
        begin(permissive);
        while (mesh_.aliveCount() > target_triangles && !heap_.empty())
            step();
    }

    /// The same for a cost. Returns the triangles that it went for; nothing where nothing more can go before that is known.
    std::optional<size_t> collapseUntil(const CostStop& stop)
    {
        begin(false);
        size_t target = stop.least;
        bool dear = false;
        while (mesh_.aliveCount() > target && !heap_.empty())
        {
            if (!dear && nextCost() > stop.cost)
            {
                dear = true;
                target = std::max(target, fullClusters(std::min(mesh_.aliveCount(), stop.most)));
            }
            else
                step();
        }
        return dear || mesh_.aliveCount() <= target ? std::optional(target) : std::nullopt;
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

    Simplified result();

private:
    void begin(bool permissive)
    {
        wedges_.permissive = permissive;
        heap_.clear();
        for (uint32_t p = 0; p < target_.size(); ++p)
            if (target_[p] == p && group_.locked[p] == 0 && (!permissive || wedge_blocked_[p] != 0))
                evaluate(p);
    }
    /// Of what is in front of the heap, in object space: no later step costs less.
    double nextCost() const
    {
        const double scale2 = group_.scale * group_.scale;
        return double{heap_.front().cost()} * scale2 * scale2;
    }
    void holdEdges(uint32_t position);
    void gather(uint32_t position)
    {
        if (!mesh_.gatherFan(position))
            mesh_.gather(position);
    }
    void evaluate(uint32_t position)
    {
        gather(position);
        evaluateGathered(position);
    }
    template <typename Visit>
    void forEachOfFan(uint32_t position, Visit visit) const;
    float cost(uint32_t from, uint32_t to) const;
    void gatherCandidates(uint32_t position, bool along_seams);
    void push(uint32_t position, Candidate candidate);
    std::optional<Candidate> nextCandidate(uint32_t position);
    void evaluateGathered(uint32_t position);
    void evaluateValid(uint32_t position, float popped_cost);
    bool turnsOver(uint32_t from, uint32_t to);
    bool valid(uint32_t from, uint32_t to) { return mesh_.linkHolds(from, to) && !turnsOver(from, to); }
    void step();
    void noteAround(uint32_t center);

    const GroupMesh& group_;
    StarMesh mesh_;
    WedgeMap wedges_; ///< of the gathered position
    Quadrics quadrics_;
    std::vector<uint32_t> version_;      ///< heap entries with another version are stale
    std::vector<uint32_t> best_target_;  ///< of the entry in the heap, or kNoPosition
    std::vector<uint8_t> outdated_;      ///< 1 where the cost in the heap is that of before a collapse
    std::vector<uint32_t> target_;       ///< of removed positions, the next one
    std::vector<uint8_t> edges_held_;    ///< 1 where holdEdges was
    std::vector<uint8_t> wedge_blocked_; ///< 1 where wedges without a way ruled out a collapse
    std::vector<uint8_t> grown_;         ///< 1 for positions that others went to
    CollapseHeap heap_;
    Growth growth_;

    // scratch
    std::vector<Candidate> candidates_;
    std::vector<uint32_t> around_;
};

/// Planes that hold open borders, edges of more than two triangles, and seams at the gathered position. Each end of an
/// edge takes its own, when it is first asked where it could go.
void Collapser::holdEdges(uint32_t position)
{
    edges_held_[position] = 1;
    const Float3 place = group_.positions[position];
    const auto hold = [&](uint32_t end, uint32_t tip)
    {
        const Spoke& spoke = *mesh_.spokeTo(end);
        const bool regular = spoke.regular(mesh_.layers());
        if (regular && spoke.out.from == spoke.in.from && spoke.out.to == spoke.in.to)
            return;
        quadrics_.position[position].add(edgeQuadric(group_.positions[end] - place,
                                                     group_.positions[tip] - place,
                                                     regular ? kSeamWeight : kBorderWeight));
    };
    for (const Corner corner : mesh_.star(position))
    {
        const uint32_t next = mesh_.positionAt(nextCorner(corner));
        const uint32_t previous = mesh_.positionAt(previousCorner(corner));
        hold(next, previous);
        hold(previous, next);
    }
}

/// Quadric error of the collapse that wedges_ describes. Wedges without a way count with the least error that any
/// attributes could give them.
float Collapser::cost(uint32_t from, uint32_t to) const
{
    const Float3 t = group_.positions[to] - group_.positions[from];
    const LaneVector t_lanes = allLanes(t);
    Lanes attribute_error{};
    for (const WedgeMove& move : wedges_.moves())
        attribute_error += quadrics_.attributeError(group_, move, t_lanes);
    if (!wedges_.complete())
        for (const uint32_t wedge : mesh_.wedges())
            if (!wedges_.has(wedge))
                attribute_error -= quadrics_.mostGain(group_, wedge, t_lanes);
    return std::max(quadrics_.position[from].at(t) + sumOfLanes(attribute_error), 0.0f);
}

/// Calls `visit` with each collapse of the gathered fan, with the last up to four times.
template <typename Visit>
void Collapser::forEachOfFan(uint32_t position, Visit visit) const
{
    if (mesh_.degree(position) <= 2)
        return;
    const Float3 place = group_.positions[position];
    const auto fan = mesh_.fan();
    for (size_t first = 0; first < fan.size(); first += kLanes)
    {
        // behind the last, that again
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

/// All collapses of the gathered position that respect borders and wedges, into candidates_.
/// along_seams  where one of them keeps two wedges on their way, those that keep fewer are left out
void Collapser::gatherCandidates(uint32_t position, bool along_seams)
{
    candidates_.clear();
    wedge_blocked_[position] = 0;
    if (mesh_.plain())
    {
        edges_held_[position] = 1;
        forEachOfFan(position, [&](const Candidate& candidate) { candidates_.push_back(candidate); });
        return;
    }
    const auto ring = mesh_.ring();
    if (std::all_of(ring.begin(), ring.end(), [&](const Spoke& s) { return mesh_.emptiesStar(position, s); }))
        return;
    if (edges_held_[position] == 0)
        holdEdges(position);
    // an edge is the way of two charts at most
    if (!wedges_.permissive && mesh_.layers() == 1 && wedges_.moreChartsThanTwo())
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

void Collapser::push(uint32_t position, Candidate candidate)
{
    best_target_[position] = candidate.target;
    heap_.push({candidate.cost, position, candidate.target, version_[position]});
}

/// Take the cheapest candidate out of the list; nullopt if it is empty.
std::optional<Candidate> Collapser::nextCandidate(uint32_t position)
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
        wedges_.mapRest(cheapest->target);
        cheapest->cost = cost(position, cheapest->target);
        cheapest->exact = true;
    }
    return std::nullopt;
}

/// Put the cheapest collapse of the gathered position into the heap; whether it is valid is seen when it comes out.
void Collapser::evaluateGathered(uint32_t position)
{
    ++version_[position];
    outdated_[position] = 0;
    best_target_[position] = kNoPosition;
    if (mesh_.plain())
    {
        wedge_blocked_[position] = 0;
        edges_held_[position] = 1;
        Candidate best{std::numeric_limits<float>::infinity(), kNoPosition, true};
        forEachOfFan(position, [&](const Candidate& candidate) { best = std::min(best, candidate); });
        if (best.target != kNoPosition)
            push(position, best);
        return;
    }
    gatherCandidates(position, wedges_.permissive);
    if (const auto candidate = nextCandidate(position))
        push(position, *candidate);
}

/// The same with the cheapest valid collapse.
void Collapser::evaluateValid(uint32_t position, float popped_cost)
{
    ++version_[position];
    outdated_[position] = 0;
    best_target_[position] = kNoPosition;
    gatherCandidates(position, false);
    while (auto candidate = nextCandidate(position))
        if (valid(position, candidate->target))
        {
            candidate->cost = std::max(candidate->cost, popped_cost);
            push(position, *candidate);
            return;
        }
}

/// All triangles are asked, because hardly ever one turns over, and which ones go cannot be foretold.
bool Collapser::turnsOver(uint32_t from, uint32_t to)
{
    uint32_t turned = 0;
    for (const Corner corner : mesh_.star(from))
    {
        const uint32_t next = mesh_.positionAt(nextCorner(corner));
        const uint32_t previous = mesh_.positionAt(previousCorner(corner));
        const bool turns = turnsTriangle(group_.positions[next], group_.positions[previous],
                                         group_.positions[from], group_.positions[to]);
        turned |= static_cast<uint32_t>(turns) & static_cast<uint32_t>(next != to) &
                  static_cast<uint32_t>(previous != to);
    }
    return turned != 0;
}

/// After a collapse to `center`. Its own cost has risen, most likely, and is asked for again when it comes out of the
/// heap, like that of those that wanted to go where nothing is any more. Those that had nowhere to go may have now.
void Collapser::noteAround(uint32_t center)
{
    outdated_[center] = 1;
    around_.clear();
    const auto note = [&](uint32_t position)
    {
        if (best_target_[position] == kNoPosition && group_.locked[position] == 0)
            around_.push_back(position);
    };
    note(center);
    for (const Corner corner : mesh_.star(center))
    {
        note(mesh_.positionAt(nextCorner(corner)));
        note(mesh_.positionAt(previousCorner(corner)));
    }
    std::sort(around_.begin(), around_.end());
    around_.erase(std::unique(around_.begin(), around_.end()), around_.end());
    for (const uint32_t position : around_)
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
    wedges_.mapRest(entry.target());
    if (group_.locked[entry.target()] == 0) // nobody asks for those of locked positions
        quadrics_.move(group_, entry.position(), entry.target(), wedges_.moves());
    mesh_.collapse(entry.position(), entry.target(), wedges_.moves());
    target_[entry.position()] = entry.target();
    grown_[entry.target()] = 1;
    ++version_[entry.position()];
    noteAround(entry.target());
}

bool Collapser::pruneIslands(size_t target_triangles)
{
    Thinning thinning = thinIslands(group_, mesh_, target_triangles, target_);
    growth_ = std::move(thinning.growth);
    return thinning.pruned;
}

Simplified Collapser::result()
{
    Simplified result;
    result.source_triangle = mesh_.aliveTriangles();
    result.corners.reserve(mesh_.aliveCount() * 3);
    result.materials.reserve(mesh_.aliveCount());
    for (const uint32_t t : result.source_triangle)
    {
        for (const Corner corner : StarMesh::cornersOf(t))
            result.corners.push_back(mesh_.wedgeAt(corner));
        result.materials.push_back(group_.materials[t]);
    }
    result.target_of_position.resize(target_.size());
    for (uint32_t p = 0; p < target_.size(); ++p)
    {
        uint32_t target = p;
        while (target != kPruned && target_[target] != target)
            target = target_[target];
        result.target_of_position[p] = target;
    }
    for (uint32_t p = 0; p < target_.size(); ++p)
    {
        const bool left = target_[p] == p, free = group_.locked[p] == 0, asked = edges_held_[p] != 0;
        const bool may_move = left & free & asked & !group_.keeps_places;
        grown_[p] &= may_move ? 1 : 0;
    }
    result.placement = placeOptimally(group_, mesh_, quadrics_, grown_);
    growIslands(group_, growth_, result.placement);
    return result;
}

} // namespace

std::vector<CollapseStep> collapseCosts(const GroupMesh& group, size_t least)
{
    return Collapser(group).costsUntil(least);
}

Simplified simplifyGroup(const GroupMesh& group, size_t target_triangles, size_t most_triangles,
                         const std::optional<CostStop>& stop)
{
    HEARTH_ASSERT(target_triangles > 0);
    Collapser collapser(group);
    bool permissive = false;
    bool pruned = false;
    if (stop)
        target_triangles = collapser.collapseUntil(*stop).value_or(target_triangles);
    else
        collapser.collapseUntil(target_triangles, false);
    const auto near_target =
        std::min(static_cast<size_t>(static_cast<double>(target_triangles) * kNearTarget),
                 std::max(most_triangles, target_triangles));
    if (collapser.triangleCount() > near_target)
    {
        const size_t before = collapser.triangleCount();
        collapser.collapseUntil(target_triangles, true);
        permissive = collapser.triangleCount() < before;
    }
    if (collapser.triangleCount() > near_target)
        pruned = collapser.pruneIslands(target_triangles);
    Simplified result = collapser.result();
    result.permissive = permissive;
    result.pruned = pruned;
    return result;
}

} // namespace hearth::clusters

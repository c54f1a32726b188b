// Half-edge collapses ordered by quadric error; see quadric.h for the papers. Link condition: T. K. Dey,
// H. Edelsbrunner, S. Guha, D. V. Nekhayev, "Topology preserving edge contraction", 1999.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/simplify.h"

#include "cook/clusters/islands.h"
#include "cook/clusters/quadric.h"
#include "formats/assert.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hearth::clusters
{

namespace
{

constexpr uint32_t kNoPosition = 0xFFFFFFFFu;

// A collapse may turn a triangle by up to 75 degrees.
constexpr float kMinTurnCosine = 0.25f;

// Height of a triangle against its longest side below which its area is mostly rounding.
constexpr float kNeedle = 1e-4f;

// Where the surface is flat all collapses cost nothing: then short edges of small areas go first.
constexpr float kLengthWeight = 1e-6f;

// Strict collapses that end within this of the target are good enough.
constexpr double kNearTarget = 1.1;

/// A neighbour of a position and how the triangles between them run.
struct Spoke
{
    uint32_t position;
    uint32_t out_count; ///< triangles with the edge center -> position
    uint32_t in_count;  ///< triangles with the edge position -> center

    bool regular(uint32_t layers) const { return out_count == layers && in_count == layers; }
};

/// How many sheets lie on each other around a position: 1 but for faces that the source has twice.
uint32_t layerCount(std::span<const Spoke> ring)
{
    uint32_t layers = std::numeric_limits<uint32_t>::max();
    for (const Spoke& spoke : ring)
        layers = std::min({layers, std::max(spoke.out_count, spoke.in_count)});
    return layers;
}

/// Where a wedge of the removed position goes.
struct WedgeMove
{
    uint32_t from;
    uint32_t to;
};

struct Candidate
{
    float cost;
    uint32_t target;
};

struct HeapEntry
{
    float cost;
    uint32_t position;
    uint32_t target;
    uint32_t version;

    // std heaps keep the greatest in front
    bool operator<(const HeapEntry& b) const
    {
        return cost != b.cost ? cost > b.cost : position > b.position;
    }
};

class Collapser
{
public:
    explicit Collapser(const GroupMesh& group)
        : group_(group),
          quadrics_(initialQuadrics(group)),
          corners_(group.corners),
          alive_(group.triangleCount(), 1),
          alive_count_(group.triangleCount()),
          stars_(group.positions.size()),
          version_(group.positions.size(), 0),
          best_target_(group.positions.size(), kNoPosition),
          target_(group.positions.size()),
          mark_(group.positions.size(), 0)
    {
        for (uint32_t p = 0; p < target_.size(); ++p)
            target_[p] = p;
        buildStars();
    }

    size_t triangleCount() const { return alive_count_; }

    void collapseUntil(size_t target_triangles, bool permissive)
    {
        permissive_ = permissive;
        heap_.clear();
        for (uint32_t p = 0; p < target_.size(); ++p)
            if (target_[p] == p)
                evaluate(p);
        while (alive_count_ > target_triangles && !heap_.empty())
            step();
    }

    bool pruneIslands(size_t target_triangles);

    Simplified result() const;

private:
    struct Star
    {
        uint32_t first = 0;
        uint32_t count = 0;
    };

    uint32_t positionAt(size_t corner) const { return group_.position_of_wedge[corners_[corner]]; }

    std::span<const uint32_t> star(uint32_t position) const
    {
        return std::span(star_items_).subspan(stars_[position].first, stars_[position].count);
    }

    /// The corner of `triangle` at `position`.
    size_t cornerOf(uint32_t triangle, uint32_t position) const
    {
        const size_t first = size_t{triangle} * 3;
        return positionAt(first) == position       ? first
               : positionAt(first + 1) == position ? first + 1
                                                   : first + 2;
    }
    static size_t nextCorner(size_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }
    static size_t previousCorner(size_t corner) { return corner % 3 == 0 ? corner + 2 : corner - 1; }

    bool contains(uint32_t triangle, uint32_t position) const
    {
        const size_t first = size_t{triangle} * 3;
        return positionAt(first) == position || positionAt(first + 1) == position ||
               positionAt(first + 2) == position;
    }

    void buildStars();
    void pruneStar(uint32_t position);
    void gatherRing(uint32_t center);
    void gatherWedges(uint32_t center);
    bool mapWedges(uint32_t from, uint32_t to);
    uint32_t nearestWedge(uint32_t wedge, uint32_t position) const;
    float cost(uint32_t from, uint32_t to) const;
    void gatherCandidates(uint32_t position);
    void evaluate(uint32_t position);
    void evaluateValid(uint32_t position, float popped_cost);
    bool linkHolds(uint32_t from, uint32_t to);
    bool turnsOver(uint32_t from, uint32_t to) const;
    bool valid(uint32_t from, uint32_t to) { return linkHolds(from, to) && !turnsOver(from, to); }
    void push(uint32_t position, Candidate candidate);
    void step();
    void collapse(uint32_t from, uint32_t to);
    void moveQuadrics(uint32_t from, uint32_t to);
    void evaluateAround(uint32_t removed, uint32_t center);

    const GroupMesh& group_;
    Quadrics quadrics_;
    std::vector<uint32_t> corners_;
    std::vector<uint8_t> alive_;
    size_t alive_count_;
    std::vector<Star> stars_; ///< triangles around each position; may name dead ones until pruneStar
    std::vector<uint32_t> star_items_;
    std::vector<uint32_t> version_;     ///< heap entries with another version are stale
    std::vector<uint32_t> best_target_; ///< of the entry in the heap, or kNoPosition
    std::vector<uint32_t> target_;      ///< of removed positions, the next one
    std::vector<HeapEntry> heap_;
    bool permissive_ = false;

    // scratch
    std::vector<uint32_t> mark_;
    uint32_t mark_value_ = 0;
    std::vector<Spoke> ring_;
    std::vector<uint32_t> wedges_;
    std::vector<WedgeMove> moves_;
    std::vector<Candidate> candidates_;
};

void Collapser::buildStars()
{
    for (size_t corner = 0; corner < corners_.size(); ++corner)
        ++stars_[positionAt(corner)].count;
    uint32_t first = 0;
    for (Star& star : stars_)
    {
        star.first = first;
        first += star.count;
        star.count = 0;
    }
    star_items_.resize(corners_.size());
    star_items_.reserve(corners_.size() * 3);
    for (size_t corner = 0; corner < corners_.size(); ++corner)
    {
        Star& star = stars_[positionAt(corner)];
        star_items_[star.first + star.count++] = static_cast<uint32_t>(corner / 3);
    }
}

/// Forget the dead triangles around a position.
void Collapser::pruneStar(uint32_t position)
{
    Star& star = stars_[position];
    uint32_t kept = 0;
    for (uint32_t i = 0; i < star.count; ++i)
        if (const uint32_t triangle = star_items_[star.first + i]; alive_[triangle] != 0)
            star_items_[star.first + kept++] = triangle;
    star.count = kept;
}

/// The neighbours of `center`, each once, into ring_. mark_ of a neighbour is mark_value_ + its place in ring_.
void Collapser::gatherRing(uint32_t center)
{
    mark_value_ += static_cast<uint32_t>(ring_.size());
    ring_.clear();
    if (mark_value_ > std::numeric_limits<uint32_t>::max() / 2)
    {
        std::fill(mark_.begin(), mark_.end(), 0u);
        mark_value_ = 0;
    }
    ++mark_value_;
    const auto spokeOf = [&](uint32_t position) -> Spoke&
    {
        const uint32_t place = mark_[position] - mark_value_;
        if (place < ring_.size() && ring_[place].position == position)
            return ring_[place];
        mark_[position] = mark_value_ + static_cast<uint32_t>(ring_.size());
        return ring_.emplace_back(Spoke{position, 0, 0});
    };
    for (const uint32_t triangle : star(center))
    {
        const size_t corner = cornerOf(triangle, center);
        ++spokeOf(positionAt(nextCorner(corner))).out_count;
        ++spokeOf(positionAt(previousCorner(corner))).in_count;
    }
}

/// The wedges that triangles use at `center`, each once, into wedges_.
void Collapser::gatherWedges(uint32_t center)
{
    wedges_.clear();
    for (const uint32_t triangle : star(center))
    {
        const uint32_t wedge = corners_[cornerOf(triangle, center)];
        if (std::find(wedges_.begin(), wedges_.end(), wedge) == wedges_.end())
            wedges_.push_back(wedge);
    }
}

uint32_t Collapser::nearestWedge(uint32_t wedge, uint32_t position) const
{
    uint32_t best = kNoPosition;
    float best_distance = std::numeric_limits<float>::infinity();
    const uint32_t count = group_.attribute_count;
    for (const uint32_t triangle : star(position))
    {
        const uint32_t other = corners_[cornerOf(triangle, position)];
        float distance = 0;
        for (uint32_t i = 0; i < count; ++i)
        {
            const float d = group_.attributes[other * count + i] - group_.attributes[wedge * count + i];
            distance += d * d;
        }
        if (best == kNoPosition || distance < best_distance || (distance == best_distance && other < best))
        {
            best = other;
            best_distance = distance;
        }
    }
    return best;
}

/// Find where the wedges of `from` (in wedges_) go if it collapses to `to`, into moves_; false if one cannot.
bool Collapser::mapWedges(uint32_t from, uint32_t to)
{
    moves_.clear();
    for (const uint32_t triangle : star(from))
    {
        if (!contains(triangle, to))
            continue;
        const uint32_t wedge = corners_[cornerOf(triangle, from)];
        const uint32_t goal = corners_[cornerOf(triangle, to)];
        const auto known =
            std::find_if(moves_.begin(), moves_.end(), [&](WedgeMove m) { return m.from == wedge; });
        if (known == moves_.end())
            moves_.push_back({wedge, goal});
        else if (known->to != goal && !permissive_)
            return false;
    }
    if (moves_.size() == wedges_.size())
        return true;
    if (!permissive_)
        return false;
    for (const uint32_t wedge : wedges_)
        if (std::none_of(moves_.begin(), moves_.end(), [&](WedgeMove m) { return m.from == wedge; }))
            moves_.push_back({wedge, nearestWedge(wedge, to)});
    return true;
}

/// Quadric error of the collapse that moves_ describes.
float Collapser::cost(uint32_t from, uint32_t to) const
{
    const Float3 t = group_.positions[to] - group_.positions[from];
    float error = quadrics_.position[from].at(t);
    float weight = 0;
    const uint32_t count = group_.attribute_count;
    for (const WedgeMove& move : moves_)
    {
        const float wedge_weight = quadrics_.wedge_weight[move.from];
        weight += wedge_weight;
        for (uint32_t i = 0; i < count; ++i)
        {
            const float delta =
                group_.attributes[move.to * count + i] - group_.attributes[move.from * count + i];
            const AttributeGradient& g = quadrics_.gradients[move.from * count + i];
            error += delta * (wedge_weight * delta - 2 * (dot(g.gradient, t) + g.offset));
        }
    }
    return std::max(error, 0.0f) + kLengthWeight * weight * dot(t, t);
}

/// All collapses of a position that respect borders and wedges, into candidates_.
void Collapser::gatherCandidates(uint32_t position)
{
    candidates_.clear();
    if (group_.locked[position] != 0)
        return;
    pruneStar(position);
    gatherRing(position);
    gatherWedges(position);
    const uint32_t layers = layerCount(ring_);
    const auto irregular =
        std::count_if(ring_.begin(), ring_.end(), [&](const Spoke& s) { return !s.regular(layers); });
    if (irregular != 0 && irregular != 2)
        return;
    for (const Spoke& spoke : ring_)
    {
        if (irregular == 2 && spoke.regular(layers))
            continue;
        if (mapWedges(position, spoke.position))
            candidates_.push_back({cost(position, spoke.position), spoke.position});
    }
}

void Collapser::push(uint32_t position, Candidate candidate)
{
    best_target_[position] = candidate.target;
    heap_.push_back({candidate.cost, position, candidate.target, version_[position]});
    std::push_heap(heap_.begin(), heap_.end());
}

bool cheaper(const Candidate& a, const Candidate& b)
{
    return a.cost != b.cost ? a.cost < b.cost : a.target < b.target;
}

/// Put the cheapest collapse of a position into the heap; whether it is valid is seen when it comes out.
void Collapser::evaluate(uint32_t position)
{
    ++version_[position];
    best_target_[position] = kNoPosition;
    gatherCandidates(position);
    if (!candidates_.empty())
        push(position, *std::min_element(candidates_.begin(), candidates_.end(), cheaper));
}

/// The same with the cheapest valid collapse.
void Collapser::evaluateValid(uint32_t position, float popped_cost)
{
    ++version_[position];
    best_target_[position] = kNoPosition;
    gatherCandidates(position);
    std::vector<Candidate> sorted = candidates_;
    std::sort(sorted.begin(), sorted.end(), cheaper);
    for (Candidate candidate : sorted)
        if (valid(position, candidate.target))
        {
            candidate.cost = std::max(candidate.cost, popped_cost);
            push(position, candidate);
            return;
        }
}

/// Link condition: the only common neighbours of the two positions are the tips of their common triangles, and no
/// triangle that is moved comes to lie on another. And no star that is touched becomes empty.
bool Collapser::linkHolds(uint32_t from, uint32_t to)
{
    gatherRing(from);
    size_t common_triangles = 0;
    for (const uint32_t triangle : star(from))
        common_triangles += contains(triangle, to) ? 1u : 0u;
    pruneStar(to);
    if (common_triangles == 0 || common_triangles == star(from).size() || common_triangles == star(to).size())
        return false;

    // neighbours of both, each counted once: `used` is cleared in the ring where one is found
    size_t common_neighbours = 0;
    const auto place = [&](uint32_t position) -> Spoke*
    {
        const uint32_t i = mark_[position] - mark_value_;
        return i < ring_.size() && ring_[i].position == position ? &ring_[i] : nullptr;
    };
    for (const uint32_t triangle : star(to))
        for (size_t k = 0; k < 3; ++k)
        {
            const uint32_t position = positionAt(size_t{triangle} * 3 + k);
            Spoke* spoke = position == to ? nullptr : place(position);
            if (spoke != nullptr && (spoke->out_count | spoke->in_count) != 0)
            {
                ++common_neighbours;
                spoke->out_count = spoke->in_count = 0;
            }
        }
    size_t tips = 0;
    for (const uint32_t triangle : star(from))
    {
        if (contains(triangle, to))
        {
            for (size_t k = 0; k < 3; ++k)
            {
                const uint32_t position = positionAt(size_t{triangle} * 3 + k);
                if (position == from || position == to)
                    continue;
                // the first triangle with this tip finds it marked common; mark it as counted
                Spoke* spoke = place(position);
                if (spoke->out_count == 0)
                {
                    spoke->out_count = 1;
                    ++tips;
                }
                pruneStar(position);
                if (star(position).size() <= 1)
                    return false;
            }
        }
    }
    if (tips != common_neighbours)
        return false;

    // a moved triangle whose far edge lies between two common neighbours may meet one that is there already
    for (const uint32_t triangle : star(from))
    {
        if (contains(triangle, to))
            continue;
        const size_t corner = cornerOf(triangle, from);
        const uint32_t a = positionAt(nextCorner(corner));
        const uint32_t b = positionAt(previousCorner(corner));
        for (const uint32_t other : star(to))
            if (contains(other, a) && contains(other, b))
                return false;
    }
    return true;
}

bool Collapser::turnsOver(uint32_t from, uint32_t to) const
{
    const Float3 old_place = group_.positions[from];
    const Float3 new_place = group_.positions[to];
    for (const uint32_t triangle : star(from))
    {
        if (contains(triangle, to))
            continue;
        const size_t corner = cornerOf(triangle, from);
        const Float3 a = group_.positions[positionAt(nextCorner(corner))];
        const Float3 b = group_.positions[positionAt(previousCorner(corner))];
        const Float3 old_normal = cross(a - old_place, b - old_place);
        const Float3 new_normal = cross(a - new_place, b - new_place);
        const float old_area2 = dot(old_normal, old_normal);
        const float new_area2 = dot(new_normal, new_normal);
        const float longest2 = std::max(
            {dot(a - new_place, a - new_place), dot(b - new_place, b - new_place), dot(a - b, a - b)});
        const bool needle = !(new_area2 > kNeedle * kNeedle * longest2 * longest2);
        if (!(new_area2 > 0) || (needle && new_area2 < old_area2) ||
            dot(old_normal, new_normal) < kMinTurnCosine * std::sqrt(old_area2 * new_area2))
            return true;
    }
    return false;
}

void Collapser::moveQuadrics(uint32_t from, uint32_t to)
{
    const Float3 t = group_.positions[to] - group_.positions[from];
    PositionQuadric moved = quadrics_.position[from];
    const uint32_t count = group_.attribute_count;
    for (const WedgeMove& move : moves_)
    {
        const float weight = quadrics_.wedge_weight[move.from];
        quadrics_.wedge_weight[move.to] += weight;
        for (uint32_t i = 0; i < count; ++i)
        {
            const float delta =
                group_.attributes[move.to * count + i] - group_.attributes[move.from * count + i];
            const AttributeGradient g = quadrics_.gradients[move.from * count + i];
            AttributeGradient& goal = quadrics_.gradients[move.to * count + i];
            moved.c += delta * (weight * delta - 2 * g.offset);
            moved.b -= g.gradient * delta;
            goal.gradient += g.gradient;
            goal.offset += g.offset + dot(g.gradient, t) - weight * delta;
        }
    }
    quadrics_.position[to].addMoved(moved, t);
}

void Collapser::collapse(uint32_t from, uint32_t to)
{
    moveQuadrics(from, to);
    target_[from] = to;
    ++version_[from];
    const auto first = static_cast<uint32_t>(star_items_.size());
    for (uint32_t i = 0; i < stars_[to].count; ++i)
        if (const uint32_t triangle = star_items_[stars_[to].first + i];
            alive_[triangle] != 0 && !contains(triangle, from))
            star_items_.push_back(triangle);
    for (uint32_t i = 0; i < stars_[from].count; ++i)
    {
        const uint32_t triangle = star_items_[stars_[from].first + i];
        if (alive_[triangle] == 0)
            continue;
        if (contains(triangle, to))
        {
            alive_[triangle] = 0;
            --alive_count_;
            continue;
        }
        uint32_t& wedge = corners_[cornerOf(triangle, from)];
        wedge = std::find_if(moves_.begin(), moves_.end(), [&](WedgeMove m) { return m.from == wedge; })->to;
        star_items_.push_back(triangle);
    }
    stars_[to] = {first, static_cast<uint32_t>(star_items_.size()) - first};
}

/// After `removed` went to `center`: new collapses for the center, for those that wanted to go to `removed`, and for
/// those that had none.
void Collapser::evaluateAround(uint32_t removed, uint32_t center)
{
    gatherRing(center);
    std::vector<uint32_t> around;
    for (const Spoke& spoke : ring_)
    {
        pruneStar(spoke.position);
        if (best_target_[spoke.position] == removed || best_target_[spoke.position] == kNoPosition)
            around.push_back(spoke.position);
    }
    evaluate(center);
    for (const uint32_t position : around)
        evaluate(position);
}

void Collapser::step()
{
    std::pop_heap(heap_.begin(), heap_.end());
    const HeapEntry entry = heap_.back();
    heap_.pop_back();
    if (entry.version != version_[entry.position] || target_[entry.position] != entry.position)
        return;
    pruneStar(entry.position);
    gatherWedges(entry.position);
    if (!mapWedges(entry.position, entry.target) || !valid(entry.position, entry.target))
    {
        evaluateValid(entry.position, entry.cost);
        return;
    }
    collapse(entry.position, entry.target);
    evaluateAround(entry.position, entry.target);
}

/// Remove whole islands that touch no locked position, the smallest first. Keeps at least one triangle.
bool Collapser::pruneIslands(size_t target_triangles)
{
    std::vector<uint32_t> triangles;
    std::vector<uint32_t> positions;
    for (uint32_t t = 0; t < alive_.size(); ++t)
        if (alive_[t] != 0)
        {
            triangles.push_back(t);
            for (size_t k = 0; k < 3; ++k)
                positions.push_back(positionAt(size_t{t} * 3 + k));
        }
    const std::vector<uint32_t> island_of = islandOfTriangles(positions, group_.positions.size());

    struct Island
    {
        Box3 box;
        bool locked = false;
        std::vector<uint32_t> triangles;
    };
    std::vector<Island> islands(group_.positions.size());
    for (size_t i = 0; i < triangles.size(); ++i)
    {
        Island& island = islands[island_of[i]];
        island.triangles.push_back(triangles[i]);
        for (size_t k = 0; k < 3; ++k)
        {
            const uint32_t position = positions[i * 3 + k];
            island.box.add(group_.positions[position]);
            island.locked |= group_.locked[position] != 0;
        }
    }
    std::erase_if(islands, [](const Island& island) { return island.triangles.empty() || island.locked; });
    std::stable_sort(islands.begin(), islands.end(),
                     [](const Island& a, const Island& b)
                     { return length(a.box.max - a.box.min) < length(b.box.max - b.box.min); });
    bool pruned = false;
    for (const Island& island : islands)
    {
        if (alive_count_ <= target_triangles || alive_count_ == island.triangles.size())
            break;
        for (const uint32_t triangle : island.triangles)
        {
            alive_[triangle] = 0;
            for (size_t k = 0; k < 3; ++k)
                target_[positionAt(size_t{triangle} * 3 + k)] = kPruned;
        }
        alive_count_ -= island.triangles.size();
        pruned = true;
    }
    return pruned;
}

Simplified Collapser::result() const
{
    Simplified result;
    result.corners.reserve(alive_count_ * 3);
    result.materials.reserve(alive_count_);
    for (size_t t = 0; t < alive_.size(); ++t)
        if (alive_[t] != 0)
        {
            result.corners.insert(result.corners.end(),
                                  {corners_[t * 3], corners_[t * 3 + 1], corners_[t * 3 + 2]});
            result.materials.push_back(group_.materials[t]);
            result.source_triangle.push_back(static_cast<uint32_t>(t));
        }
    result.target_of_position.resize(target_.size());
    for (uint32_t p = 0; p < target_.size(); ++p)
    {
        uint32_t target = p;
        while (target != kPruned && target_[target] != target)
            target = target_[target];
        result.target_of_position[p] = target;
    }
    return result;
}

} // namespace

Simplified simplifyGroup(const GroupMesh& group, size_t target_triangles)
{
    HEARTH_ASSERT(target_triangles > 0);
    Collapser collapser(group);
    bool permissive = false;
    bool pruned = false;
    collapser.collapseUntil(target_triangles, false);
    const auto near_target = static_cast<size_t>(static_cast<double>(target_triangles) * kNearTarget);
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

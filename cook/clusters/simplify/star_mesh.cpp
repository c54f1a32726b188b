// Link condition: T. K. Dey, H. Edelsbrunner, S. Guha, D. V. Nekhayev, "Topology preserving edge
// contraction", 1999.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/simplify/star_mesh.h"

#include "cook/clusters/core/set_hash.h"
#include "formats/base/assert.h"

#include <algorithm>
#include <limits>

namespace hearth::clusters
{

StarMesh::StarMesh(const GroupMesh& group)
    : position_id_of_corner_(group.triangleCount() * 4),
      wedge_of_corner_(group.triangleCount() * 4),
      alive_(group.triangleCount(), 1),
      alive_count_(group.triangleCount()),
      stars_(group.positions.size()),
      hash_of_wedge_(group.vertex_of_wedge.size()),
      mark_(group.positions.size(), 0)
{
    HEARTH_ASSERT(group.position_id_of_wedge.size() == group.vertex_of_wedge.size());
    for (const WedgeId wedge : hash_of_wedge_.ids())
        hash_of_wedge_[wedge] = hashNumber(toIndex(wedge));
    for (const TriangleId triangle : alive_.ids())
    {
        const std::array<StarCorner, 3> corners = triangleCorners(triangle);
        const std::array<WedgeId, 3> wedges = group.corners.triangle(triangle);
        for (size_t k = 0; k < 3; ++k)
        {
            const PositionId position = group.position_id_of_wedge[wedges[k]];
            wedge_of_corner_[corners[k]] = wedges[k];
            position_id_of_corner_[corners[k]] = position;
            ++stars_[position].alive;
        }
    }
    uint32_t first = 0;
    for (Star& star : stars_)
    {
        star.first = first;
        first += star.alive;
    }
    // a collapse appends the new star: about six triangles for two that are removed
    star_items_.reserve(group.corners.size() * 3);
    star_items_.resize(group.corners.size());
    for (const TriangleId triangle : alive_.ids())
        for (const StarCorner corner : triangleCorners(triangle))
        {
            Star& star = stars_[position_id_of_corner_[corner]];
            star_items_[star.first + star.count++] = corner;
        }
}

IdVector<TriangleId, TriangleId> StarMesh::aliveTriangles() const
{
    std::vector<TriangleId> alive(alive_.size());
    size_t count = 0;
    for (const TriangleId triangle : alive_.ids())
    {
        alive[count] = triangle;
        count += alive_[triangle];
    }
    alive.resize(count);
    return IdVector<TriangleId, TriangleId>(std::move(alive));
}

std::span<const StarCorner> StarMesh::star(PositionId position)
{
    Star& star = stars_[position];
    StarCorner* items = star_items_.data() + star.first;
    if (star.count != star.alive)
    {
        uint32_t kept = 0;
        for (uint32_t i = 0; i < star.count; ++i)
        {
            items[kept] = items[i];
            kept += alive_[cornerTriangle(items[i])];
        }
        star.count = kept;
    }
    return {items, star.count};
}

void StarMesh::clearGathered()
{
    mark_value_ += static_cast<uint32_t>(ring_.size()) + fan_size_ + 1;
    if (mark_value_ > std::numeric_limits<uint32_t>::max() / 2)
    {
        std::fill(mark_.begin(), mark_.end(), 0u);
        mark_value_ = 1;
    }
    ring_.clear();
    fan_size_ = 0;
}

bool StarMesh::gatherFan(PositionId center)
{
    clearGathered();
    const auto corners = star(center);
    if (corners.empty())
        return false;
    if (fan_.size() < corners.size())
        fan_.resize(corners.size() * 2);
    fan_wedge_ = wedge_of_corner_[corners.front()];
    // if the outgoing and incoming wedges are equal as sets, so are the sums of their hashes
    uint64_t difference = 0;
    bool plain = true;
    FanEnd* end = fan_.data();
    uint32_t mark = mark_value_;
    for (const StarCorner corner : corners)
    {
        const StarCorner next = nextCorner(corner);
        *end = {position_id_of_corner_[next], wedge_of_corner_[next]};
        uint32_t& mark_of_end = mark_[end->position];
        // marks of other positions are smaller
        plain &= wedge_of_corner_[corner] == fan_wedge_ && mark_of_end < mark_value_;
        difference += hash_of_wedge_[end->wedge] - hash_of_wedge_[wedge_of_corner_[previousCorner(corner)]];
        mark_of_end = mark++;
        ++end;
    }
    fan_size_ = static_cast<uint32_t>(corners.size());
    if (plain && difference == 0)
        return true;
    clearGathered();
    return false;
}

void StarMesh::gather(PositionId center)
{
    clearGathered();
    wedges_.clear();
    const auto findOrAddSpoke = [&](PositionId position) -> Spoke&
    {
        const uint32_t place = mark_[position] - mark_value_;
        if (place < ring_.size())
            return ring_[place];
        mark_[position] = mark_value_ + static_cast<uint32_t>(ring_.size());
        return ring_.emplace_back(Spoke{.position = position});
    };
    for (const StarCorner corner : star(center))
    {
        const StarCorner next = nextCorner(corner);
        const StarCorner previous = previousCorner(corner);
        const WedgeId wedge = wedge_of_corner_[corner];
        Spoke& out = findOrAddSpoke(position_id_of_corner_[next]);
        ++out.out_count;
        out.out = {wedge, wedge_of_corner_[next]};
        Spoke& in = findOrAddSpoke(position_id_of_corner_[previous]);
        ++in.in_count;
        in.in = {wedge, wedge_of_corner_[previous]};
        if (std::find(wedges_.begin(), wedges_.end(), wedge) == wedges_.end())
            wedges_.push_back(wedge);
    }
    layers_ = std::numeric_limits<uint32_t>::max();
    for (const Spoke& spoke : ring_)
        layers_ = std::min(layers_, std::max(spoke.out_count, spoke.in_count));
}

/// Test the link condition around a plain fan, without branches that depend on the stars except the last.
bool StarMesh::satisfiesLinkConditionInFan(PositionId from, PositionId to)
{
    const uint32_t size = fan_size_;
    const auto star_from = star(from);
    const auto star_to = star(to);
    // one triangle runs from here to there, and one back
    PositionId tip_out{}, tip_in{};
    for (const StarCorner corner : star_from)
    {
        const PositionId next = position_id_of_corner_[nextCorner(corner)];
        const PositionId previous = position_id_of_corner_[previousCorner(corner)];
        tip_out = next == to ? previous : tip_out;
        tip_in = previous == to ? next : tip_in;
    }
    // the tips must be the only common neighbours
    uint32_t others = 0;
    for (const StarCorner corner : star_to)
        for (const PositionId p :
             {position_id_of_corner_[nextCorner(corner)], position_id_of_corner_[previousCorner(corner)]})
            others += static_cast<uint32_t>(mark_[p] >= mark_value_) & static_cast<uint32_t>(p != tip_out) &
                      static_cast<uint32_t>(p != tip_in);
    if (others != 0 || star_to.size() <= 2 || size <= 2 || degree(tip_out) <= 1 || degree(tip_in) <= 1)
        return false;
    // the third triangle of a fan of three may coincide with an existing one
    return size > 3 || std::none_of(star_to.begin(), star_to.end(),
                                    [&](StarCorner corner) {
                                        return has(cornerTriangle(corner), tip_out) &&
                                               has(cornerTriangle(corner), tip_in);
                                    });
}

bool StarMesh::satisfiesLinkCondition(PositionId from, PositionId to)
{
    HEARTH_RUNTIME_ASSERT(from != to);
    if (plain())
        return satisfiesLinkConditionInFan(from, to);
    const auto star_from = star(from);
    const auto star_to = star(to);
    uint32_t common = 0;
    tips_.clear();
    for (const StarCorner corner : star_from)
    {
        const PositionId next = position_id_of_corner_[nextCorner(corner)];
        const PositionId previous = position_id_of_corner_[previousCorner(corner)];
        if (next != to && previous != to)
            continue;
        ++common;
        if (const PositionId tip = next == to ? previous : next; !isTip(tip))
            tips_.push_back(tip);
    }
    if (common == 0 || common == star_from.size() || common == star_to.size())
        return false;

    // the tips of the common triangles must be the only common neighbours
    for (const StarCorner corner : star_to)
        for (const StarCorner far : {nextCorner(corner), previousCorner(corner)})
            if (const PositionId p = position_id_of_corner_[far]; gathered(p) && !isTip(p))
                return false;
    for (const PositionId tip : tips_)
        if (degree(tip) <= 1)
            return false;

    // a moved triangle whose far edge joins two tips may coincide with an existing one
    for (const StarCorner corner : star_from)
    {
        const PositionId a = position_id_of_corner_[nextCorner(corner)];
        const PositionId b = position_id_of_corner_[previousCorner(corner)];
        if (a == to || b == to || !isTip(a) || !isTip(b))
            continue;
        for (const StarCorner other : star_to)
            if (has(cornerTriangle(other), a) && has(cornerTriangle(other), b))
                return false;
    }
    return true;
}

void StarMesh::collapse(PositionId from, PositionId to, std::span<const WedgeMove> moves)
{
    HEARTH_RUNTIME_ASSERT(from != to && degree(from) > 0 && degree(to) > 0);
    // collected without a branch, which would be unpredictable
    const auto star_from = star(from);
    removed_.resize(star_from.size());
    size_t removed_count = 0;
    for (const StarCorner corner : star_from)
    {
        removed_[removed_count] = cornerTriangle(corner);
        removed_count += has(cornerTriangle(corner), to) ? 1u : 0u;
    }
    for (size_t i = 0; i < removed_count; ++i)
        remove(removed_[i]);
    const size_t first = star_items_.size();
    star_items_.resize(first + stars_[to].count + stars_[from].count);
    StarCorner* end = star_items_.data() + first;
    const auto copyStar = [&](const Star& star)
    {
        for (uint32_t i = star.first; i < star.first + star.count; ++i)
        {
            *end = star_items_[i];
            end += alive_[cornerTriangle(*end)];
        }
    };
    copyStar(stars_[to]);
    const StarCorner* const moved = end;
    copyStar(stars_[from]);
    for (const StarCorner corner : std::span(moved, end))
    {
        WedgeId& wedge = wedge_of_corner_[corner];
        position_id_of_corner_[corner] = to;
        wedge = std::find_if(moves.begin(), moves.end(), [&](WedgeMove m) { return m.from == wedge; })->to;
    }
    const auto count = static_cast<uint32_t>(end - star_items_.data() - static_cast<ptrdiff_t>(first));
    star_items_.resize(first + count);
    stars_[to] = {static_cast<uint32_t>(first), count, count};
    stars_[from] = {};
    HEARTH_RUNTIME_ASSERT(count > 0);
}

void StarMesh::remove(TriangleId triangle)
{
    HEARTH_RUNTIME_ASSERT(alive_[triangle] != 0);
    alive_[triangle] = 0;
    --alive_count_;
    for (const StarCorner corner : triangleCorners(triangle))
        --stars_[position_id_of_corner_[corner]].alive;
}

} // namespace hearth::clusters

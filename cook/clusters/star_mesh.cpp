// Link condition: T. K. Dey, H. Edelsbrunner, S. Guha, D. V. Nekhayev, "Topology preserving edge contraction", 1999.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/star_mesh.h"

#include <algorithm>
#include <limits>

namespace hearth::clusters
{

StarMesh::StarMesh(const GroupMesh& group)
    : triangles_(group.triangleCount()),
      alive_(group.triangleCount(), 1),
      alive_count_(group.triangleCount()),
      stars_(group.positions.size()),
      mark_(group.positions.size(), 0)
{
    for (size_t corner = 0; corner < group.corners.size(); ++corner)
    {
        const uint32_t wedge = group.corners[corner];
        const uint32_t position = group.position_of_wedge[wedge];
        triangles_[corner / 3].wedge[corner % 3] = wedge;
        triangles_[corner / 3].position[corner % 3] = position;
        ++stars_[position].count;
    }
    uint32_t first = 0;
    for (Star& star : stars_)
    {
        star.first = first;
        first += star.count;
        star.count = 0;
    }
    // a collapse appends the star that it makes: about six triangles for two that go
    star_items_.reserve(group.corners.size() * 3);
    star_items_.resize(group.corners.size());
    for (uint32_t t = 0; t < triangles_.size(); ++t)
        for (const uint32_t position : triangles_[t].position)
            star_items_[stars_[position].first + stars_[position].count++] = t;
}

std::span<const uint32_t> StarMesh::star(uint32_t position)
{
    Star& star = stars_[position];
    uint32_t* items = star_items_.data() + star.first;
    uint32_t kept = 0;
    for (uint32_t i = 0; i < star.count; ++i)
        if (alive_[items[i]] != 0)
            items[kept++] = items[i];
    star.count = kept;
    return {items, kept};
}

void StarMesh::gather(uint32_t center)
{
    mark_value_ += static_cast<uint32_t>(ring_.size()) + 1;
    if (mark_value_ > std::numeric_limits<uint32_t>::max() / 2)
    {
        std::fill(mark_.begin(), mark_.end(), 0u);
        mark_value_ = 1;
    }
    ring_.clear();
    wedges_.clear();
    const auto spokeOf = [&](uint32_t position) -> Spoke&
    {
        const uint32_t place = mark_[position] - mark_value_;
        if (place < ring_.size() && ring_[place].position == position)
            return ring_[place];
        mark_[position] = mark_value_ + static_cast<uint32_t>(ring_.size());
        return ring_.emplace_back(Spoke{.position = position});
    };
    for (const uint32_t t : star(center))
    {
        const Triangle& triangle = triangles_[t];
        const size_t at = triangle.cornerAt(center);
        const size_t next = at == 2 ? 0 : at + 1;
        const size_t previous = at == 0 ? 2 : at - 1;
        const uint32_t wedge = triangle.wedge[at];
        Spoke& out = spokeOf(triangle.position[next]);
        ++out.out_count;
        out.out = {wedge, triangle.wedge[next]};
        Spoke& in = spokeOf(triangle.position[previous]);
        ++in.in_count;
        in.in = {wedge, triangle.wedge[previous]};
        if (std::find(wedges_.begin(), wedges_.end(), wedge) == wedges_.end())
            wedges_.push_back(wedge);
    }
}

uint32_t StarMesh::layers() const
{
    uint32_t layers = std::numeric_limits<uint32_t>::max();
    for (const Spoke& spoke : ring_)
        layers = std::min(layers, std::max(spoke.out_count, spoke.in_count));
    return layers;
}

bool StarMesh::linkHolds(uint32_t from, uint32_t to)
{
    const auto star_from = star(from);
    const auto star_to = star(to);
    tips_.clear();
    size_t common_triangles = 0;
    for (const uint32_t t : star_from)
    {
        const Triangle& triangle = triangles_[t];
        if (!triangle.has(to))
            continue;
        ++common_triangles;
        for (const uint32_t p : triangle.position)
            if (p != from && p != to && std::find(tips_.begin(), tips_.end(), p) == tips_.end())
                tips_.push_back(p);
    }
    if (common_triangles == 0 || common_triangles == star_from.size() || common_triangles == star_to.size())
        return false;

    // the tips of the common triangles are the only common neighbours
    const auto isTip = [&](uint32_t p) { return std::find(tips_.begin(), tips_.end(), p) != tips_.end(); };
    for (const uint32_t t : star_to)
        for (const uint32_t p : triangles_[t].position)
            if (p != to && spokeTo(p) != nullptr && !isTip(p))
                return false;
    for (const uint32_t tip : tips_)
        if (star(tip).size() <= common_triangles && star(tip).size() <= 1)
            return false;

    // a moved triangle with its far edge between two tips may meet one that is there already
    for (const uint32_t t : star_from)
    {
        const Triangle& triangle = triangles_[t];
        if (triangle.has(to))
            continue;
        const size_t at = triangle.cornerAt(from);
        const uint32_t a = triangle.position[(at + 1) % 3];
        const uint32_t b = triangle.position[(at + 2) % 3];
        if (isTip(a) && isTip(b))
            for (const uint32_t other : star_to)
                if (triangles_[other].has(a) && triangles_[other].has(b))
                    return false;
    }
    return true;
}

void StarMesh::collapse(uint32_t from, uint32_t to, std::span<const WedgeMove> moves)
{
    const Star old_to = stars_[to];
    const Star old_from = stars_[from];
    const auto first = static_cast<uint32_t>(star_items_.size());
    for (uint32_t i = 0; i < old_to.count; ++i)
        if (const uint32_t t = star_items_[old_to.first + i]; alive_[t] != 0 && !triangles_[t].has(from))
            star_items_.push_back(t);
    for (uint32_t i = 0; i < old_from.count; ++i)
    {
        const uint32_t t = star_items_[old_from.first + i];
        Triangle& triangle = triangles_[t];
        if (alive_[t] == 0)
            continue;
        if (triangle.has(to))
        {
            remove(t);
            continue;
        }
        const size_t at = triangle.cornerAt(from);
        triangle.position[at] = to;
        triangle.wedge[at] = std::find_if(moves.begin(), moves.end(),
                                          [&](WedgeMove m) { return m.from == triangle.wedge[at]; })
                                 ->to;
        star_items_.push_back(t);
    }
    stars_[to] = {first, static_cast<uint32_t>(star_items_.size()) - first};
    stars_[from] = {};
}

void StarMesh::remove(uint32_t triangle)
{
    alive_[triangle] = 0;
    --alive_count_;
}

} // namespace hearth::clusters

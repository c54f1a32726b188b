// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/topology/boundary_loops.h"

#include "formats/base/double3.h"
#include "formats/base/index.h"

#include <algorithm>

namespace hearth::topology
{

namespace
{

/// Edge of one triangle, and the end of it where a path goes on.
struct Step
{
    uint32_t half_edge = kInvalidIndex;
    uint32_t pivot = 0; ///< position id
};

class Walker
{
public:
    Walker(const Surface& surface, const Edges& edges)
        : surface_(surface),
          edges_(edges),
          is_boundary_(surface.corners.size(), false),
          is_walked_(surface.corners.size(), false)
    {
        for (const Edge& edge : edges.edges)
            if (edge.count == 1)
                is_boundary_[edges.half_edges[edge.first]] = true;
    }

    bool isNew(uint32_t half_edge) const { return is_boundary_[half_edge] && !is_walked_[half_edge]; }

    BoundaryLoop walk(uint32_t half_edge)
    {
        const uint32_t from = surface_.corners[half_edge];
        const uint32_t to = surface_.corners[nextHalfEdge(half_edge)];
        BoundaryLoop loop;
        loop.positions = {from, to};
        is_walked_[half_edge] = true;
        loop.is_closed = walkOn({half_edge, to}, loop.positions);
        if (loop.is_closed)
            loop.positions.pop_back(); // the start again
        else
        {
            std::vector<uint32_t> before;
            walkOn({half_edge, from}, before);
            loop.positions.insert(loop.positions.begin(), before.rbegin(), before.rend());
        }
        loop.length = measure(loop);
        return loop;
    }

private:
    /// Append the positions behind the step's. Returns whether the path comes back to where it started.
    bool walkOn(Step step, std::vector<uint32_t>& positions)
    {
        while (true)
        {
            const uint32_t next = turn(step);
            if (next == kInvalidIndex)
                return false;
            if (is_walked_[next])
                return true;
            is_walked_[next] = true;
            const uint32_t start = surface_.corners[next];
            const uint32_t end = surface_.corners[nextHalfEdge(next)];
            step = {next, start == step.pivot ? end : start};
            positions.push_back(step.pivot);
        }
    }

    /// Turn around the pivot through the fan of the step's triangle, to its other boundary.
    /// kInvalidIndex if an edge of more than two triangles ends the fan.
    uint32_t turn(Step step) const
    {
        uint32_t half_edge = step.half_edge;
        while (true)
        {
            half_edge = surface_.corners[half_edge] == step.pivot ? previousHalfEdge(half_edge)
                                                                  : nextHalfEdge(half_edge);
            if (is_boundary_[half_edge])
                return half_edge;
            half_edge = edges_.opposite[half_edge];
            if (half_edge == kInvalidIndex)
                return kInvalidIndex;
        }
    }

    double measure(const BoundaryLoop& loop) const
    {
        double sum = 0;
        for (size_t i = 0; i < loop.edgeCount(); ++i)
        {
            const Float3 from = surface_.positions[loop.positions[i]];
            const Float3 to = surface_.positions[loop.positions[(i + 1) % loop.positions.size()]];
            sum += length(widen(to) - widen(from));
        }
        return sum;
    }

    const Surface& surface_;
    const Edges& edges_;
    std::vector<bool> is_boundary_;
    std::vector<bool> is_walked_;
};

} // namespace

std::vector<BoundaryLoop> findBoundaryLoops(const Surface& surface, const Edges& edges)
{
    Walker walker(surface, edges);
    std::vector<BoundaryLoop> loops;
    for (uint32_t half_edge = 0; half_edge < surface.corners.size(); ++half_edge)
        if (walker.isNew(half_edge))
            loops.push_back(walker.walk(half_edge));
    std::stable_sort(loops.begin(), loops.end(),
                     [](const BoundaryLoop& a, const BoundaryLoop& b) { return a.length > b.length; });
    return loops;
}

} // namespace hearth::topology

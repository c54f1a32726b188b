// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/surfaces/boundary.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <algorithm>
#include <numeric>
#include <unordered_map>
#include <unordered_set>

namespace hearth
{

namespace
{

using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<>;

/// Half-edge k of a triangle runs from its corner k to the next one.
struct HalfEdge
{
    uint64_t ends;   ///< lower position id, higher one
    uint32_t corner; ///< where it starts
    bool ascends;    ///< from the lower to the higher id
};

uint64_t makeEnds(uint32_t from, uint32_t to)
{
    return uint64_t{std::min(from, to)} << 32 | std::max(from, to);
}

uint32_t nextCorner(uint32_t corner)
{
    return corner % 3 == 2 ? corner - 2 : corner + 1;
}

/// Union-find over the corners of triangles.
class CornerSets
{
public:
    explicit CornerSets(size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }

    uint32_t find(uint32_t corner)
    {
        while (parent_[corner] != corner)
            corner = parent_[corner] = parent_[parent_[corner]];
        return corner;
    }
    void unite(uint32_t a, uint32_t b)
    {
        a = find(a);
        b = find(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<uint32_t> parent_;
};

std::vector<uint32_t> withoutDegenerate(std::span<const uint32_t> triangles)
{
    std::vector<uint32_t> kept;
    kept.reserve(triangles.size());
    for (size_t t = 0; t < triangles.size(); t += 3)
    {
        const uint32_t a = triangles[t], b = triangles[t + 1], c = triangles[t + 2];
        if (a != b && b != c && c != a)
            kept.insert(kept.end(), {a, b, c});
    }
    return kept;
}

std::vector<HalfEdge> sortedHalfEdges(std::span<const uint32_t> triangles)
{
    std::vector<HalfEdge> half_edges;
    half_edges.reserve(triangles.size());
    for (uint32_t corner = 0; corner < triangles.size(); ++corner)
    {
        const uint32_t from = triangles[corner], to = triangles[nextCorner(corner)];
        half_edges.push_back({makeEnds(from, to), corner, from < to});
    }
    std::sort(half_edges.begin(), half_edges.end(),
              [](const HalfEdge& a, const HalfEdge& b)
              { return a.ends != b.ends ? a.ends < b.ends : a.corner < b.corner; });
    return half_edges;
}

/// Surface that is taken apart where it is no manifold.
struct Manifold
{
    CornerSets vertices; ///< corners of one vertex
    std::unordered_set<uint64_t> complex_edges;

    bool isComplex(uint32_t from, uint32_t to) const { return complex_edges.contains(makeEnds(from, to)); }
};

Manifold takeApart(std::span<const HalfEdge> half_edges, Boundary& boundary)
{
    Manifold manifold{CornerSets(half_edges.size()), {}};
    for (size_t i = 0, end = 0; i < half_edges.size(); i = end)
    {
        int64_t balance = 0;
        for (end = i; end < half_edges.size() && half_edges[end].ends == half_edges[i].ends; ++end)
            balance += half_edges[end].ascends ? 1 : -1;
        const uint64_t ends = half_edges[i].ends;
        if (end - i == 2 && balance == 0)
        {
            const uint32_t a = half_edges[i].corner, b = half_edges[i + 1].corner;
            manifold.vertices.unite(a, nextCorner(b));
            manifold.vertices.unite(b, nextCorner(a));
        }
        else if (end - i > 1)
        {
            const PositionEdge edge{static_cast<uint32_t>(ends >> 32), static_cast<uint32_t>(ends)};
            boundary.complex_edges.push_back(edge);
            manifold.complex_edges.insert(ends);
            if (balance != 0 || (end - i) % 2 != 0)
                boundary.other_open_edges.push_back(edge);
        }
    }
    return manifold;
}

/// Give the triangles to OpenMesh. Returns the position id of each of its vertices.
std::vector<uint32_t> fillMesh(std::span<const uint32_t> triangles, CornerSets& vertices, HalfEdgeMesh& mesh,
                               uint64_t& refused)
{
    std::vector<uint32_t> position_of_vertex;
    std::vector<HalfEdgeMesh::VertexHandle> vertex_of_corner(triangles.size());
    for (uint32_t corner = 0; corner < triangles.size(); ++corner)
        if (vertices.find(corner) == corner)
        {
            vertex_of_corner[corner] = mesh.add_vertex({});
            position_of_vertex.push_back(triangles[corner]);
        }
    for (uint32_t corner = 0; corner < triangles.size(); corner += 3)
    {
        const auto vertex = [&](uint32_t k) { return vertex_of_corner[vertices.find(corner + k)]; };
        if (!mesh.add_face(vertex(0), vertex(1), vertex(2)).is_valid())
            ++refused;
    }
    return position_of_vertex;
}

} // namespace

Boundary findBoundary(std::span<const uint32_t> all_triangles)
{
    Boundary boundary;
    const std::vector<uint32_t> triangles = withoutDegenerate(all_triangles);
    Manifold manifold = takeApart(sortedHalfEdges(triangles), boundary);
    if (!boundary.complex_edges.empty())
    {
        boundary.positions = triangles;
        std::sort(boundary.positions.begin(), boundary.positions.end());
        boundary.positions.erase(std::unique(boundary.positions.begin(), boundary.positions.end()),
                                 boundary.positions.end());
    }
    HalfEdgeMesh mesh;
    const std::vector<uint32_t> positions =
        fillMesh(triangles, manifold.vertices, mesh, boundary.refused_triangles);
    std::vector<bool> walked(mesh.n_halfedges(), false);
    const auto index = [](auto handle) { return static_cast<size_t>(handle.idx()); };
    for (const auto start : mesh.halfedges())
    {
        if (!mesh.is_boundary(start) || walked[index(start)])
            continue;
        BoundaryLoop loop;
        bool complex = false;
        for (HalfEdgeMesh::HalfedgeHandle h = start; !walked[index(h)]; h = mesh.next_halfedge_handle(h))
        {
            walked[index(h)] = true;
            const uint32_t from = positions[index(mesh.from_vertex_handle(h))];
            const uint32_t to = positions[index(mesh.to_vertex_handle(h))];
            loop.positions.push_back(from);
            complex |= manifold.isComplex(from, to);
        }
        if (!complex)
        {
            boundary.loops.push_back(std::move(loop));
            continue;
        }
        for (size_t i = 0; i < loop.positions.size(); ++i)
        {
            const uint32_t from = loop.positions[i], to = loop.positions[(i + 1) % loop.positions.size()];
            if (!manifold.isComplex(from, to))
                boundary.other_open_edges.push_back({from, to});
        }
    }
    return boundary;
}

namespace
{

/// True if a closed path passes some positions of another one, and nothing else, in their order.
bool isPartOfCycle(std::span<const uint32_t> part, std::span<const uint32_t> cycle)
{
    for (size_t start = 0; start < cycle.size(); ++start)
    {
        if (cycle[start] != part[0])
            continue;
        size_t found = 1;
        for (size_t i = 1; i < cycle.size() && found < part.size(); ++i)
            found += cycle[(start + i) % cycle.size()] == part[found] ? 1 : 0;
        if (found == part.size())
            return true;
    }
    return false;
}

/// Loops of the source by the positions that they pass.
class SourceLoops
{
public:
    explicit SourceLoops(const Boundary& source) : source_(source), taken_(source.loops.size(), false)
    {
        for (uint32_t l = 0; l < source.loops.size(); ++l)
            for (const uint32_t position : source.loops[l].positions)
                loops_at_.emplace(position, l);
        for (const auto* edges : {&source.other_open_edges, &source.complex_edges})
            for (const PositionEdge& edge : *edges)
                others_.insert({edge.from, edge.to});
    }

    bool onLoop(uint32_t position) const { return loops_at_.contains(position); }
    bool onBoundary(uint32_t position) const { return onLoop(position) || others_.contains(position); }

    /// True if an open edge may end at a position: on the boundary, or where complex islands have moved.
    bool mayEndAt(uint32_t position) const
    {
        return onBoundary(position) ||
               (!source_.complex_edges.empty() &&
                !std::binary_search(source_.positions.begin(), source_.positions.end(), position));
    }

    /// Take a loop that the given one passes positions of. False if there is none.
    bool take(const BoundaryLoop& loop)
    {
        // a loop that is part of one of the source passes it with its first position too
        const auto [first, last] = loops_at_.equal_range(loop.positions.front());
        for (auto at = first; at != last; ++at)
            if (!taken_[at->second] && isPartOfCycle(loop.positions, source_.loops[at->second].positions))
            {
                taken_[at->second] = true;
                ++taken_count_;
                return true;
            }
        return false;
    }

    size_t leftCount() const { return taken_.size() - taken_count_; }

private:
    const Boundary& source_;
    std::vector<bool> taken_;
    size_t taken_count_ = 0;
    std::unordered_multimap<uint32_t, uint32_t> loops_at_;
    std::unordered_set<uint32_t> others_;
};

std::string describe(const BoundaryLoop& loop)
{
    return "boundary loop of " + std::to_string(loop.positions.size()) + " edges at position " +
           std::to_string(loop.positions.front());
}

} // namespace

std::string findCrack(const Boundary& source, const Boundary& simplified)
{
    if (simplified.refused_triangles != 0)
        return std::to_string(simplified.refused_triangles) + " triangles that OpenMesh refuses";
    SourceLoops loops(source);
    const bool is_manifold = source.complex_edges.empty();
    std::vector<const BoundaryLoop*> moved;
    for (const BoundaryLoop& loop : simplified.loops)
    {
        const auto& positions = loop.positions;
        const auto on_loops = std::count_if(positions.begin(), positions.end(),
                                            [&](uint32_t position) { return loops.onLoop(position); });
        if (on_loops > 0 && loops.take(loop))
            continue;
        if (on_loops <= static_cast<ptrdiff_t>(std::max<size_t>(positions.size() / 2, 2)))
            moved.push_back(&loop);
        else if (is_manifold || !std::all_of(positions.begin(), positions.end(),
                                             [&](uint32_t position) { return loops.onBoundary(position); }))
            return describe(loop) + " is no loop of the source";
    }
    if (is_manifold && moved.size() > loops.leftCount())
        return describe(*moved.front()) + " and " + std::to_string(moved.size() - 1) + " others for " +
               std::to_string(loops.leftCount()) + " loops of the source that are left";
    for (const PositionEdge& edge : simplified.other_open_edges)
        if (!loops.mayEndAt(edge.from) || !loops.mayEndAt(edge.to))
            return "open edge " + std::to_string(edge.from) + " -> " + std::to_string(edge.to);
    return "";
}

} // namespace hearth

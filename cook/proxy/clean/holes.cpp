// Walks the boundary in OpenMesh's half-edges.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/proxy/clean/holes.h"

#include "formats/base/assert.h"
#include "formats/base/disjoint_sets.h"
#include "formats/base/double3.h"
#include "formats/base/index.h"

#include <limits>
#include <optional>
#include <span>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

namespace hearth::proxy
{

namespace
{

using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<>;

constexpr size_t kMaxLoopEdges = 64;

// Share of its piece's area that the filling of a hole may have.
constexpr double kMaxFilledArea = 0.1;

/// Boundary loop: its vertices in the order in which triangles that fill it pass them.
struct Loop
{
    std::vector<uint32_t> vertices;
    uint32_t triangle = 0; ///< beside its first edge
};

/// Half-edges of a surface; vertices and triangles have the surface's numbers.
HalfEdgeMesh makeHalfEdges(const Surface& surface)
{
    HalfEdgeMesh mesh;
    mesh.reserve(surface.positions.size(), surface.indices.size(), surface.triangleCount());
    for (size_t v = 0; v < surface.positions.size(); ++v)
        mesh.add_vertex({});
    for (size_t i = 0; i < surface.indices.size(); i += 3)
    {
        const auto corner = [&](size_t k) { return mesh.vertex_handle(surface.indices[i + k]); };
        const auto face = mesh.add_face(corner(0), corner(1), corner(2));
        HEARTH_ASSERT(face.is_valid()); // the surface is a manifold
    }
    return mesh;
}

uint32_t toNumber(OpenMesh::BaseHandle handle)
{
    return static_cast<uint32_t>(handle.idx());
}

std::vector<Loop> findLoops(const HalfEdgeMesh& mesh)
{
    std::vector<Loop> loops;
    std::vector<bool> is_walked(mesh.n_halfedges(), false);
    for (const auto start : mesh.halfedges())
    {
        if (!start.is_boundary() || is_walked[toNumber(start)])
            continue;
        Loop loop;
        loop.triangle = toNumber(start.opp().face());
        for (auto h = start; !is_walked[toNumber(h)]; h = h.next())
        {
            is_walked[toNumber(h)] = true;
            loop.vertices.push_back(toNumber(h.from()));
        }
        loops.push_back(std::move(loop));
    }
    return loops;
}

double doubledArea(Float3 a, Float3 b, Float3 c)
{
    return length(cross(widen(b) - widen(a), widen(c) - widen(a)));
}

/// Triangulation of a loop.
struct Filling
{
    std::vector<std::array<uint32_t, 3>> triangles; ///< places in the loop
    double area = 0;
};

/// Find the triangulation of least area that needs no edge which the mesh has.
/// returns  nothing if each one does
std::optional<Filling> fill(const Surface& surface, const HalfEdgeMesh& mesh, const Loop& loop)
{
    const size_t n = loop.vertices.size();
    constexpr double kNever = std::numeric_limits<double>::infinity();
    const auto position = [&](size_t i) { return surface.positions[loop.vertices[i]]; };
    const auto isFree = [&](size_t i, size_t j)
    {
        const auto from = mesh.vertex_handle(loop.vertices[i]), to = mesh.vertex_handle(loop.vertices[j]);
        return j == i + 1 || (i == 0 && j == n - 1) || !mesh.find_halfedge(from, to).is_valid();
    };
    // the least area between places i and j, and the place that makes a triangle with them
    std::vector<double> least(n * n, 0);
    std::vector<uint32_t> third(n * n, 0);
    for (size_t span = 2; span < n; ++span)
        for (size_t i = 0; i + span < n; ++i)
        {
            const size_t j = i + span;
            double& area = least[i * n + j] = kNever;
            if (!isFree(i, j))
                continue;
            for (size_t k = i + 1; k < j; ++k)
            {
                const double sum = least[i * n + k] + least[k * n + j] +
                                   doubledArea(position(i), position(k), position(j)) / 2;
                if (sum < area)
                {
                    area = sum;
                    third[i * n + j] = static_cast<uint32_t>(k);
                }
            }
        }
    if (!(least[n - 1] < kNever))
        return std::nullopt;
    Filling filling{{}, least[n - 1]};
    std::vector<std::array<uint32_t, 2>> open{{0, static_cast<uint32_t>(n - 1)}};
    while (!open.empty())
    {
        const auto [i, j] = open.back();
        open.pop_back();
        if (j < i + 2)
            continue;
        const uint32_t k = third[i * n + j];
        filling.triangles.push_back({i, k, j});
        open.push_back({i, k});
        open.push_back({k, j});
    }
    return filling;
}

double findLength(const Surface& surface, std::span<const uint32_t> loop)
{
    double sum = 0;
    for (size_t i = 0; i < loop.size(); ++i)
        sum += double{length(surface.positions[loop[(i + 1) % loop.size()]] - surface.positions[loop[i]])};
    return sum;
}

/// Areas of the connected pieces of a surface.
class PieceAreas
{
public:
    explicit PieceAreas(const Surface& surface)
        : pieces_(surface.positions.size()), areas_(surface.positions.size(), 0)
    {
        for (size_t t = 0; t < surface.triangleCount(); ++t)
        {
            pieces_.unite(surface.indices[3 * t], surface.indices[3 * t + 1]);
            pieces_.unite(surface.indices[3 * t], surface.indices[3 * t + 2]);
        }
        for (size_t t = 0; t < surface.triangleCount(); ++t)
        {
            const auto [a, b, c] = surface.corners(t);
            areas_[pieces_.find(surface.indices[3 * t])] += doubledArea(a, b, c) / 2;
        }
    }
    double at(uint32_t vertex) { return areas_[pieces_.find(vertex)]; }

private:
    DisjointSets pieces_;
    std::vector<double> areas_;
};

} // namespace

HoleStatistics fillHoles(Surface& surface, float max_length)
{
    HoleStatistics statistics;
    HalfEdgeMesh mesh = makeHalfEdges(surface);
    PieceAreas areas(surface);
    for (const Loop& loop : findLoops(mesh))
    {
        ++statistics.open;
        if (loop.vertices.size() > kMaxLoopEdges || findLength(surface, loop.vertices) > double{max_length})
            continue;
        const std::optional<Filling> filling = fill(surface, mesh, loop);
        if (!filling || filling->area > kMaxFilledArea * areas.at(loop.vertices[0]))
            continue;
        const uint32_t material = surface.materials[loop.triangle];
        for (const auto& [i, k, j] : filling->triangles)
        {
            const std::array<uint32_t, 3> corners{loop.vertices[i], loop.vertices[k], loop.vertices[j]};
            const auto face = mesh.add_face(mesh.vertex_handle(corners[0]), mesh.vertex_handle(corners[1]),
                                            mesh.vertex_handle(corners[2]));
            HEARTH_ASSERT(face.is_valid());
            surface.add(corners, material);
        }
        ++statistics.filled;
        --statistics.open;
    }
    return statistics;
}

} // namespace hearth::proxy

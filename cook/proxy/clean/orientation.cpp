// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/proxy/clean/orientation.h"

#include "cook/mesh/interior_edges.h"
#include "cook/ray_scene/triangle_rays.h"
#include "cook/sampling/maps.h"
#include "cook/sampling/owen_sobol.h"
#include "formats/base/csr_lists.h"
#include "formats/base/double3.h"
#include "formats/base/index.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <span>

#include <tbb/parallel_for.h>

namespace hearth::proxy
{

namespace
{

// Rays of a mesh, at most; a shell has between two and 64 points, and 16 rays from each side of them.
constexpr size_t kMaxRays = size_t{1} << 22;
constexpr uint32_t kRaysOfSide = 16;
constexpr size_t kMinPoints = 2, kMaxPoints = 64;

// A shell is turned if rays from its back leave the mesh this many times as often as those from its
// front, and by this share of all.
constexpr double kClearlyMore = 2;
constexpr double kClearShare = 0.02;

// Distance of ray origins from the surface, over the diagonal: far above rounding, far below details.
constexpr float kOffset = 0x1p-14f;

/// Triangles that edges of exactly two triangles connect, in the order of their numbers.
struct Shell
{
    std::vector<uint32_t> triangles;
    uint32_t edges = 0; ///< of two triangles
    bool agreed = true; ///< all its triangles agreed from the start
    bool is_closed() const { return 2 * size_t{edges} == 3 * triangles.size(); }
};

/// Neighbour of a triangle at an edge.
struct Neighbour
{
    uint32_t triangle;
    bool agrees; ///< passes the edge in the opposite direction
};

/// True if a triangle passes an edge from a to b.
bool passes(const Surface& surface, uint32_t triangle, uint32_t a, uint32_t b)
{
    for (uint32_t h = 3 * triangle; h < 3 * triangle + 3; ++h)
        if (surface.indices[h] == a && surface.indices[nextHalfEdge(h)] == b)
            return true;
    return false;
}

std::vector<std::vector<Neighbour>> findNeighbours(const Surface& surface)
{
    std::vector<std::vector<Neighbour>> neighbours(surface.triangleCount());
    for (const mesh::InteriorEdge& edge : mesh::findInteriorEdges(surface.indices, surface.positions.size()))
    {
        const auto [first, second] = edge.triangles;
        const bool agree = passes(surface, first, edge.a, edge.b) != passes(surface, second, edge.a, edge.b);
        neighbours[first].push_back({second, agree});
        neighbours[second].push_back({first, agree});
    }
    return neighbours;
}

Float3 areaVector(const Surface& surface, uint32_t triangle)
{
    const auto [a, b, c] = surface.corners(triangle);
    return cross(b - a, c - a) * 0.5f;
}

/// Collects the shell of a triangle, and decides which of its triangles are to be turned so that all agree.
Shell collectShell(uint32_t start, const std::vector<std::vector<Neighbour>>& neighbours,
                   std::vector<int8_t>& turn_of_triangle, OrientationStatistics& statistics)
{
    Shell shell;
    size_t half_edges = 0, twisted = 0;
    shell.triangles.push_back(start);
    turn_of_triangle[start] = 0;
    for (size_t i = 0; i < shell.triangles.size(); ++i)
        for (const Neighbour& next : neighbours[shell.triangles[i]])
        {
            ++half_edges;
            shell.agreed = shell.agreed && next.agrees;
            const auto turn =
                static_cast<int8_t>(turn_of_triangle[shell.triangles[i]] ^ (next.agrees ? 0 : 1));
            if (turn_of_triangle[next.triangle] < 0)
            {
                turn_of_triangle[next.triangle] = turn;
                shell.triangles.push_back(next.triangle);
            }
            else
                twisted += turn_of_triangle[next.triangle] != turn ? 1 : 0;
        }
    shell.edges = static_cast<uint32_t>(half_edges / 2);
    statistics.twisted_edges += static_cast<uint32_t>(twisted / 2);
    std::sort(shell.triangles.begin(), shell.triangles.end());
    return shell;
}

/// Turn all of the shell's triangles over where that leaves more of its area as it was.
void keepMostArea(const Surface& surface, const Shell& shell, std::vector<int8_t>& turn_of_triangle)
{
    double area[2] = {0, 0};
    for (const uint32_t t : shell.triangles)
        area[turn_of_triangle[t]] += double{length(areaVector(surface, t))};
    if (area[1] > area[0])
        for (const uint32_t t : shell.triangles)
            turn_of_triangle[t] ^= 1;
}

void turn(Surface& surface, uint32_t triangle)
{
    std::swap(surface.indices[3 * triangle + 1], surface.indices[3 * triangle + 2]);
}

/// Counts of rays from both sides of a shell that leave the mesh.
struct Leaving
{
    uint64_t front = 0;
    uint64_t back = 0;
    uint64_t rays = 0; ///< of each side
};

Leaving countLeaving(const Surface& surface, const Shell& shell, const ray_scene::TriangleRays& rays,
                     size_t points, float offset)
{
    std::vector<double> sums;
    double sum = 0;
    for (const uint32_t t : shell.triangles)
        sums.push_back(sum += double{length(areaVector(surface, t))});
    Leaving leaving;
    if (!(sum > 0))
        return leaving;
    for (size_t i = 0; i < points; ++i)
    {
        const uint64_t seed = sampling::deriveSeed(shell.triangles[0], i);
        const double at = sum * (static_cast<double>(i) + 0.5) / static_cast<double>(points);
        const size_t place = std::min<size_t>(
            static_cast<size_t>(std::lower_bound(sums.begin(), sums.end(), at) - sums.begin()),
            sums.size() - 1);
        const uint32_t triangle = shell.triangles[place];
        const auto [a, b, c] = surface.corners(triangle);
        const Float3 vector = areaVector(surface, triangle);
        const float area = length(vector);
        if (!(area > 0))
            continue;
        const Float3 normal = vector * (1 / area);
        const auto square = [&](uint32_t ray, uint64_t of)
        {
            const sampling::SquarePoint point = sampling::owenSobol(ray, of);
            return Float2{sampling::unitFloat(point.x), sampling::unitFloat(point.y)};
        };
        const Float2 weights = sampling::trianglePoint(square(0, ~seed));
        const Float3 point = a + (b - a) * weights.x + (c - a) * weights.y;
        const sampling::Frame frame = sampling::frameAround(normal);
        for (uint32_t ray = 0; ray < kRaysOfSide; ++ray)
        {
            const Float3 local = sampling::cosineDirection(square(ray, seed));
            const auto leaves = [&](float side)
            {
                const Float3 direction = frame.fromLocal({local.x, local.y, local.z * side});
                return !rays.occluded(point + normal * (offset * side), direction,
                                      std::numeric_limits<float>::infinity());
            };
            leaving.front += leaves(1) ? 1 : 0;
            leaving.back += leaves(-1) ? 1 : 0;
            ++leaving.rays;
        }
    }
    return leaving;
}

bool facesInwards(const Leaving& leaving)
{
    const auto front = static_cast<double>(leaving.front), back = static_cast<double>(leaving.back);
    return back > kClearlyMore * front + kClearShare * static_cast<double>(leaving.rays);
}

/// Return the corners of all triangles.
std::vector<Float3> collectCorners(const Surface& surface)
{
    std::vector<Float3> corners;
    for (const uint32_t index : surface.indices)
        corners.push_back(surface.positions[index]);
    return corners;
}

} // namespace

OrientationStatistics orientShells(Surface& surface)
{
    OrientationStatistics statistics;
    const std::vector<std::vector<Neighbour>> neighbours = findNeighbours(surface);
    std::vector<int8_t> turn_of_triangle(surface.triangleCount(), -1);
    std::vector<Shell> shells;
    for (uint32_t t = 0; t < surface.triangleCount(); ++t)
        if (turn_of_triangle[t] < 0)
        {
            shells.push_back(collectShell(t, neighbours, turn_of_triangle, statistics));
            keepMostArea(surface, shells.back(), turn_of_triangle);
        }
    for (uint32_t t = 0; t < surface.triangleCount(); ++t)
        if (turn_of_triangle[t] == 1)
            turn(surface, t);

    std::vector<size_t> asked;
    for (size_t s = 0; s < shells.size(); ++s)
        if (shells[s].is_closed() || !shells[s].agreed)
            asked.push_back(s);
    std::vector<uint8_t> is_turned(shells.size(), 0);
    if (!asked.empty())
    {
        const ray_scene::TriangleRays rays(collectCorners(surface));
        const float offset = findDiagonal(surface) * kOffset;
        const size_t points = std::clamp(kMaxRays / (2 * kRaysOfSide * asked.size()), kMinPoints, kMaxPoints);
        tbb::parallel_for(size_t{0}, asked.size(),
                          [&](size_t i)
                          {
                              const Leaving leaving =
                                  countLeaving(surface, shells[asked[i]], rays, points, offset);
                              is_turned[asked[i]] = facesInwards(leaving) ? 1 : 0;
                          });
    }
    statistics.shells = static_cast<uint32_t>(shells.size());
    for (size_t s = 0; s < shells.size(); ++s)
    {
        statistics.flipped_shells += is_turned[s];
        for (const uint32_t t : shells[s].triangles)
        {
            if (is_turned[s] != 0)
                turn(surface, t);
            statistics.flipped_triangles += (turn_of_triangle[t] ^ is_turned[s]) != 0 ? 1 : 0;
        }
    }
    return statistics;
}

} // namespace hearth::proxy

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/cook/proxy/surfaces.h"

#include "formats/base/double3.h"
#include "formats/base/index.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

namespace hearth::test
{

using proxy::Surface;

namespace
{

using DirectedEdge = std::pair<uint32_t, uint32_t>;

std::map<DirectedEdge, size_t> countDirectedEdges(const Surface& surface)
{
    std::map<DirectedEdge, size_t> count;
    for (size_t t = 0; t < surface.triangleCount(); ++t)
        for (size_t k = 0; k < 3; ++k)
            ++count[{surface.indices[3 * t + k], surface.indices[3 * t + (k + 1) % 3]}];
    return count;
}

/// Count the fans at a vertex: triangles that edges at the vertex connect.
/// opposite  for each triangle at the vertex, its two other corners in order
size_t countFans(std::vector<DirectedEdge> opposite)
{
    size_t fans = 0;
    while (!opposite.empty())
    {
        ++fans;
        std::set<uint32_t> reached{opposite.back().first, opposite.back().second};
        opposite.pop_back();
        for (bool grows = true; grows;)
        {
            grows = false;
            for (size_t i = 0; i < opposite.size(); ++i)
                if (reached.contains(opposite[i].first) || reached.contains(opposite[i].second))
                {
                    reached.insert({opposite[i].first, opposite[i].second});
                    opposite.erase(opposite.begin() + static_cast<ptrdiff_t>(i));
                    grows = true;
                    break;
                }
        }
    }
    return fans;
}

} // namespace

Surface makeBox(Float3 low, Float3 high)
{
    Surface box;
    for (uint32_t corner = 0; corner < 8; ++corner)
        box.positions.push_back({(corner & 1) != 0 ? high.x : low.x, (corner & 2) != 0 ? high.y : low.y,
                                 (corner & 4) != 0 ? high.z : low.z});
    const uint32_t quads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                  {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (const auto& [a, b, c, d] : quads)
    {
        box.add({a, b, c}, 0);
        box.add({a, c, d}, 0);
    }
    return box;
}

Surface makeTorus(float radius, float thickness, uint32_t segments)
{
    Surface torus;
    const float step = 2 * std::numbers::pi_v<float> / static_cast<float>(segments);
    for (uint32_t i = 0; i < segments; ++i)
        for (uint32_t j = 0; j < segments; ++j)
        {
            const float u = step * static_cast<float>(i), v = step * static_cast<float>(j);
            const float r = radius + thickness * std::cos(v);
            torus.positions.push_back({r * std::cos(u), r * std::sin(u), thickness * std::sin(v)});
        }
    const auto vertex = [&](uint32_t i, uint32_t j) { return i % segments * segments + j % segments; };
    for (uint32_t i = 0; i < segments; ++i)
        for (uint32_t j = 0; j < segments; ++j)
        {
            torus.add({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)}, 0);
            torus.add({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)}, 0);
        }
    return torus;
}

Surface toSurface(const mesh::SourceMesh& mesh)
{
    Surface surface{mesh.positions, mesh.indices, mesh.triangle_materials};
    surface.materials.resize(mesh.triangleCount(), kInvalidIndex);
    weldByPosition(surface);
    return surface;
}

void append(Surface& surface, const Surface& other)
{
    const auto first = static_cast<uint32_t>(surface.positions.size());
    surface.positions.insert(surface.positions.end(), other.positions.begin(), other.positions.end());
    for (size_t t = 0; t < other.triangleCount(); ++t)
        surface.add({other.indices[3 * t] + first, other.indices[3 * t + 1] + first,
                     other.indices[3 * t + 2] + first},
                    other.materials[t]);
}

void turn(Surface& surface, size_t triangle)
{
    std::swap(surface.indices[3 * triangle], surface.indices[3 * triangle + 1]);
}

double signedVolume(const Surface& surface)
{
    double volume = 0;
    for (size_t t = 0; t < surface.triangleCount(); ++t)
    {
        const auto [a, b, c] = surface.corners(t);
        volume += dot(widen(a), cross(widen(b), widen(c))) / 6;
    }
    return volume;
}

std::string findDefect(const Surface& surface)
{
    std::vector<std::vector<DirectedEdge>> opposite(surface.positions.size());
    for (size_t t = 0; t < surface.triangleCount(); ++t)
        for (size_t k = 0; k < 3; ++k)
        {
            const uint32_t a = surface.indices[3 * t + k], b = surface.indices[3 * t + (k + 1) % 3],
                           c = surface.indices[3 * t + (k + 2) % 3];
            if (a == b)
                return "triangle " + std::to_string(t) + " names a vertex twice";
            opposite[a].emplace_back(b, c);
        }
    for (const auto& [edge, count] : countDirectedEdges(surface))
        if (count > 1)
            return "edge " + std::to_string(edge.first) + " " + std::to_string(edge.second) + " has " +
                   std::to_string(count) + " triangles that pass it the same way";
    for (size_t v = 0; v < opposite.size(); ++v)
        if (const size_t fans = countFans(opposite[v]); fans != 1)
            return "vertex " + std::to_string(v) + " has " + std::to_string(fans) + " fans";
    return "";
}

size_t countBoundaryEdges(const Surface& surface)
{
    const std::map<DirectedEdge, size_t> edges = countDirectedEdges(surface);
    return static_cast<size_t>(
        std::count_if(edges.begin(), edges.end(),
                      [&](const auto& edge) {
                          return !edges.contains({edge.first.second, edge.first.first});
                      }));
}

int64_t eulerCharacteristic(const Surface& surface)
{
    std::set<DirectedEdge> edges;
    for (const auto& [edge, count] : countDirectedEdges(surface))
        edges.insert(std::minmax(edge.first, edge.second));
    return static_cast<int64_t>(surface.positions.size()) - static_cast<int64_t>(edges.size()) +
           static_cast<int64_t>(surface.triangleCount());
}

} // namespace hearth::test

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/cook/proxy/surfaces.h"

#include "formats/base/double3.h"
#include "formats/base/index.h"
#include "tests/support/proxies/manifold.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

namespace hearth::test
{

using proxy::Surface;

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
    return findManifoldDefect(surface.positions.size(), surface.indices);
}

size_t countBoundaryEdges(const Surface& surface)
{
    return countOpenEdges(surface.indices);
}

int64_t eulerCharacteristic(const Surface& surface)
{
    std::set<std::pair<uint32_t, uint32_t>> edges;
    for (size_t t = 0; t < surface.triangleCount(); ++t)
        for (size_t k = 0; k < 3; ++k)
            edges.insert(std::minmax(surface.indices[3 * t + k], surface.indices[3 * t + (k + 1) % 3]));
    return static_cast<int64_t>(surface.positions.size()) - static_cast<int64_t>(edges.size()) +
           static_cast<int64_t>(surface.triangleCount());
}

} // namespace hearth::test

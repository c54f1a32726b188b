// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/wrap/wrap_mesh.h"

#include "cook/mesh/triangles.h"
#include "cook/mesh/weld.h"
#include "formats/base/disjoint_sets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <new>
#include <span>

namespace hearth::wrap
{

namespace
{

// Rounding rarely breaks a guarantee, and a larger offset then gives other triangles, farther away.
constexpr int kMaxTries = 4;
constexpr double kOffsetGrowth = 1.5;

/// Find the triangles that have an area and are no copy of an earlier one: CGAL's trees overflow the stack on
/// tens of thousands of equal triangles. Copies have the same corners in any order.
std::vector<uint32_t> findDistinctTriangles(const mesh::SourceMesh& mesh,
                                            std::span<const uint32_t> position_id_of_vertex)
{
    using Key = std::array<uint32_t, 4>; // corners in ascending order, then the triangle
    std::vector<Key> keys;
    for (uint32_t triangle = 0; triangle < mesh.triangleCount(); ++triangle)
    {
        const uint32_t* const vertices = &mesh.indices[3 * size_t{triangle}];
        if (mesh::isDegenerate(mesh.positions[vertices[0]], mesh.positions[vertices[1]],
                               mesh.positions[vertices[2]]))
            continue;
        Key& key =
            keys.emplace_back(Key{position_id_of_vertex[vertices[0]], position_id_of_vertex[vertices[1]],
                                  position_id_of_vertex[vertices[2]], triangle});
        std::sort(key.begin(), key.end() - 1);
    }
    std::ranges::sort(keys);
    const auto copies = std::ranges::unique(keys, [](const Key& a, const Key& b)
                                            { return std::equal(a.begin(), a.end() - 1, b.begin()); });
    keys.erase(copies.begin(), copies.end());
    std::vector<uint32_t> triangles;
    for (const Key& key : keys)
        triangles.push_back(key.back());
    std::ranges::sort(triangles);
    return triangles;
}

double diagonal(const Surface& surface)
{
    Double3 low = widen(surface.positions.front()), high = low;
    for (const Float3 position : surface.positions)
    {
        const Double3 p = widen(position);
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    return length(high - low);
}

bool hasCollapsedTriangle(const Surface& surface)
{
    for (size_t i = 0; i < surface.triangleCount(); ++i)
    {
        const std::array<Float3, 3> corners = surface.corners(i);
        if (mesh::isDegenerate(corners[0], corners[1], corners[2]))
            return true;
    }
    return false;
}

/// Return a point of each piece of a surface: a wrap that touches no triangle has all of a piece on one side.
std::vector<Float3> findPieces(const Surface& surface)
{
    DisjointSets pieces(surface.positions.size());
    for (size_t i = 0; i < surface.indices.size(); i += 3)
        for (size_t k = 1; k < 3; ++k)
            pieces.unite(surface.indices[i], surface.indices[i + k]);
    std::vector<Float3> points;
    for (uint32_t point = 0; point < surface.positions.size(); ++point)
        if (pieces.find(point) == point)
            points.push_back(surface.positions[point]);
    return points;
}

/// Return the guarantee that a wrap breaks once it is rounded; "" if it holds all.
std::string findFault(const Surface& wrap, const SourceTree& source)
{
    if (wrap.indices.empty())
        return "it is no surface";
    if (std::adjacent_find(wrap.positions.begin(), wrap.positions.end()) != wrap.positions.end() ||
        hasCollapsedTriangle(wrap))
        return "its triangles collapse";
    // without a limit of time: the wrap had one, and took longer
    if (findSelfIntersections(wrap, 1, std::numeric_limits<double>::infinity())->count > 0)
        return "it intersects itself";
    if (touchesSource(wrap, source))
        return "it touches the source";
    if (!containsPoints(wrap, findPieces(source.surface())))
        return "it leaves vertices of the source outside";
    return "";
}

mesh::SourceMesh makeMesh(Surface wrap, const mesh::SourceMesh& source, const SourceTree& tree,
                          const std::vector<uint32_t>& numbers)
{
    mesh::SourceMesh mesh;
    mesh.name = source.name;
    mesh.face_count = static_cast<uint32_t>(wrap.triangleCount());
    mesh.source_vertex_count = static_cast<uint32_t>(wrap.positions.size());
    uint32_t nearest = 0;
    for (size_t i = 0; i < wrap.triangleCount(); ++i)
    {
        const std::array<Float3, 3> corners = wrap.corners(i);
        const Double3 middle = (widen(corners[0]) + widen(corners[1]) + widen(corners[2])) * (1 / 3.);
        nearest = tree.findNearest(middle, nearest).triangle;
        mesh.triangle_materials.push_back(source.triangle_materials[numbers[nearest]]);
    }
    mesh.positions = std::move(wrap.positions);
    mesh.indices = std::move(wrap.indices);
    return mesh;
}

/// errors: as wrapMesh; `fail` makes them
template <typename Fail>
Result<mesh::SourceMesh> wrapSurface(const mesh::SourceMesh& source, const WrapOptions& options,
                                     const Fail& fail)
{
    std::vector<uint32_t> numbers;
    const Surface surface = makeSurface(source, &numbers);
    if (surface.indices.empty())
    {
        mesh::SourceMesh empty;
        empty.name = source.name;
        return empty;
    }
    const double size = diagonal(surface);
    // longer triangles in several boxes: CGAL's own choice
    const SourceTree tree(surface, 3 * options.alpha * size);
    double offset = options.offset * size;
    std::string fault;
    for (int i = 0; i < kMaxTries; ++i, offset *= kOffsetGrowth)
    {
        std::optional<Surface> wrap =
            computeAlphaWrap(tree, options.alpha * size, offset, options.max_seconds);
        if (!wrap)
            return fail(
                fmt::format("its wrap takes more than {:g} s of processor time", options.max_seconds));
        fault = findFault(*wrap, tree);
        if (fault.empty())
            return makeMesh(*std::move(wrap), source, tree, numbers);
    }
    return fail(fmt::format("{} once its positions are floats, with an offset of {:g} m and less", fault,
                            offset / kOffsetGrowth));
}

} // namespace

Surface makeSurface(const mesh::SourceMesh& mesh, std::vector<uint32_t>* numbers)
{
    const mesh::Weld weld = mesh::weldPositions(mesh.positions);
    std::vector<uint32_t> index_of_id(weld.position_count, kInvalidIndex);
    std::vector<uint32_t> triangles = findDistinctTriangles(mesh, weld.position_id_of_vertex);
    Surface surface;
    for (const uint32_t triangle : triangles)
        for (size_t corner = 0; corner < 3; ++corner)
        {
            const uint32_t vertex = mesh.indices[3 * size_t{triangle} + corner];
            uint32_t& index = index_of_id[weld.position_id_of_vertex[vertex]];
            if (index == kInvalidIndex)
            {
                index = static_cast<uint32_t>(surface.positions.size());
                surface.positions.push_back(mesh.positions[vertex]);
            }
            surface.indices.push_back(index);
        }
    if (numbers != nullptr)
        *numbers = std::move(triangles);
    return surface;
}

Result<mesh::SourceMesh> wrapMesh(const mesh::SourceMesh& source, const WrapOptions& options,
                                  const std::string& file, uint32_t mesh_index)
{
    const auto fail = [&](const std::string& detail) {
        return Error{Issue::wrap_failed, file, meshText(mesh_index, source.name), detail};
    };
    try
    {
        return wrapSurface(source, options, fail);
    }
    catch (const std::bad_alloc&)
    {
        return fail("its wrap needs more memory than --max-memory allows");
    }
}

std::string meshText(uint32_t mesh_index, const std::string& name)
{
    return fmt::format("mesh {} \"{}\"", mesh_index, name);
}

} // namespace hearth::wrap

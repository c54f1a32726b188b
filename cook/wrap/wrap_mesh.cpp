// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/wrap/wrap_mesh.h"

#include "cook/mesh/distinct_triangles.h"
#include "cook/mesh/triangles.h"
#include "cook/mesh/weld.h"
#include "cook/wrap/check.h"
#include "cook/wrap/decimate.h"
#include "cook/wrap/thread_time.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <new>

namespace hearth::wrap
{

namespace
{

// Rounding rarely breaks a guarantee, and a larger offset then gives other triangles, farther away.
constexpr int kMaxTries = 4;
constexpr double kOffsetGrowth = 1.5;

// Farther from the source fewer triangles are enough: the distance is doubled for a count, this often.
constexpr int kMaxDoublings = 4;

// Share of the error by which a wrap that is decimated lies farther away: without, triangles soon touch the
// source, and with more, corners get too far to be sharp.
constexpr double kClearance = 0.5;
// First step, of the distance, by which triangles of a decimated wrap are pushed away from the source.
constexpr double kFirstStep = 0.25;

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
    const double end = threadSeconds() + options.max_seconds;
    const double error = options.error * size, clearance = kClearance * error;
    double distance = options.offset * size + clearance;
    std::optional<Surface> best;
    std::string fault;
    for (int faults = 0, doublings = 0; faults < kMaxTries && doublings <= kMaxDoublings;)
    {
        std::optional<Surface> wrap =
            computeAlphaWrap(tree, options.alpha * size, distance, end - threadSeconds());
        if (wrap)
            fault = findFault(*wrap, tree).text;
        if (wrap && !fault.empty())
        {
            ++faults;
            distance *= kOffsetGrowth;
            continue;
        }
        if (wrap && options.decimates())
            wrap = decimateWrap(
                *wrap, tree,
                {error + clearance, options.triangles, kFirstStep * distance, end - threadSeconds()});
        if (!wrap)
            return fail(
                fmt::format("its wrap takes more than {:g} s of processor time", options.max_seconds));
        if (!best || wrap->triangleCount() < best->triangleCount())
            best = std::move(wrap);
        if (best->triangleCount() <= options.triangles)
            break;
        ++doublings;
        distance *= 2;
    }
    if (best)
        return makeMesh(*std::move(best), source, tree, numbers);
    return fail(fmt::format("{} once its positions are floats, with an offset of {:g} m and less", fault,
                            distance / kOffsetGrowth));
}

} // namespace

Surface makeSurface(const mesh::SourceMesh& mesh, std::vector<uint32_t>* numbers)
{
    const mesh::Weld weld = mesh::weldPositions(mesh.positions);
    std::vector<uint32_t> index_of_id(weld.position_count, kInvalidIndex);
    std::vector<uint32_t> with_area;
    Surface surface;
    for (uint32_t triangle = 0; triangle < mesh.triangleCount(); ++triangle)
    {
        const uint32_t* const vertices = &mesh.indices[3 * size_t{triangle}];
        if (mesh::isDegenerate(mesh.positions[vertices[0]], mesh.positions[vertices[1]],
                               mesh.positions[vertices[2]]))
            continue;
        for (int corner = 0; corner < 3; ++corner)
        {
            uint32_t& index = index_of_id[weld.position_id_of_vertex[vertices[corner]]];
            if (index == kInvalidIndex)
            {
                index = static_cast<uint32_t>(surface.positions.size());
                surface.positions.push_back(mesh.positions[vertices[corner]]);
            }
            surface.indices.push_back(index);
        }
        with_area.push_back(triangle);
    }
    // CGAL's trees overflow the stack on tens of thousands of equal triangles
    const std::vector<uint32_t> distinct = mesh::findDistinctTriangles(surface.indices);
    surface.indices = mesh::selectTriangles(surface.indices, distinct);
    if (numbers != nullptr)
        for (const uint32_t triangle : distinct)
            numbers->push_back(with_area[triangle]);
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

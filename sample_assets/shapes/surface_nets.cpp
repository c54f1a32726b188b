// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/shapes/surface_nets.h"

#include "sample_assets/shapes/parallel.h"
#include "sample_assets/shapes/sample_math.h"

namespace hearth::samples
{

namespace
{

struct Grid
{
    Float3 origin;
    float cell;
    std::array<size_t, 3> points; ///< along each axis
    std::vector<float> values;

    size_t index(size_t x, size_t y, size_t z) const { return (z * points[1] + y) * points[0] + x; }
    size_t stride(size_t axis) const { return axis == 0 ? 1 : axis == 1 ? points[0] : points[0] * points[1]; }
    Float3 position(size_t x, size_t y, size_t z) const
    {
        return origin + Float3{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)} * cell;
    }
};

Grid sample(const std::function<float(Float3)>& distance, const Box3& bounds, float cell)
{
    Grid grid{bounds.min, cell, {}, {}};
    for (int axis = 0; axis < 3; ++axis)
        grid.points[static_cast<size_t>(axis)] =
            static_cast<size_t>((bounds.max[axis] - bounds.min[axis]) / cell) + 2;
    grid.values.resize(grid.points[0] * grid.points[1] * grid.points[2]);
    parallelFor(grid.points[2],
                [&](size_t z)
                {
                    for (size_t y = 0; y < grid.points[1]; ++y)
                        for (size_t x = 0; x < grid.points[0]; ++x)
                            grid.values[grid.index(x, y, z)] = distance(grid.position(x, y, z));
                });
    return grid;
}

Float3 gradient(const std::function<float(Float3)>& distance, Float3 p, float step)
{
    return Float3{distance(p + Float3{step, 0, 0}) - distance(p - Float3{step, 0, 0}),
                  distance(p + Float3{0, step, 0}) - distance(p - Float3{0, step, 0}),
                  distance(p + Float3{0, 0, step}) - distance(p - Float3{0, 0, step})} /
           (2 * step);
}

/// Compute the mean of the points where the cell's twelve edges cross zero; false if none does.
bool cellVertex(const Grid& grid, size_t x, size_t y, size_t z, Float3& vertex)
{
    Float3 sum;
    float count = 0;
    for (size_t axis = 0; axis < 3; ++axis)
        for (size_t edge = 0; edge < 4; ++edge)
        {
            std::array<size_t, 3> corner{x, y, z};
            corner[(axis + 1) % 3] += edge & 1;
            corner[(axis + 2) % 3] += edge >> 1;
            const float a = grid.values[grid.index(corner[0], corner[1], corner[2])];
            const float b = grid.values[grid.index(corner[0], corner[1], corner[2]) + grid.stride(axis)];
            if ((a < 0) == (b < 0))
                continue;
            Float3 crossing = grid.position(corner[0], corner[1], corner[2]);
            crossing[static_cast<int>(axis)] += grid.cell * (a / (a - b));
            sum += crossing;
            count += 1;
        }
    if (count == 0)
        return false;
    vertex = sum / count;
    return true;
}

constexpr uint32_t kNoVertex = 0xFFFFFFFFu;

/// Add two triangles for the grid edge from (x, y, z) along `axis`, between the four cells around it.
void addQuad(const Grid& grid, const std::vector<uint32_t>& vertex_of_cell, size_t axis, size_t at,
             std::vector<uint32_t>& indices)
{
    const bool inside_first = grid.values[at] < 0;
    if (inside_first == (grid.values[at + grid.stride(axis)] < 0))
        return;
    const size_t u = grid.stride((axis + 1) % 3), v = grid.stride((axis + 2) % 3);
    const uint32_t quad[4] = {vertex_of_cell[at - u - v], vertex_of_cell[at - v], vertex_of_cell[at],
                              vertex_of_cell[at - u]};
    if (inside_first) // the surface faces along the axis
        indices.insert(indices.end(), {quad[0], quad[1], quad[2], quad[0], quad[2], quad[3]});
    else
        indices.insert(indices.end(), {quad[0], quad[2], quad[1], quad[0], quad[3], quad[2]});
}

} // namespace

TriangleMesh polygonise(const std::function<float(Float3)>& distance, const Box3& bounds, float cell)
{
    const Grid grid = sample(distance, bounds, cell);
    TriangleMesh mesh;
    std::vector<uint32_t> vertex_of_cell(grid.values.size(), kNoVertex);
    for (size_t z = 0; z + 1 < grid.points[2]; ++z)
        for (size_t y = 0; y + 1 < grid.points[1]; ++y)
            for (size_t x = 0; x + 1 < grid.points[0]; ++x)
            {
                Float3 vertex;
                if (!cellVertex(grid, x, y, z, vertex))
                    continue;
                vertex_of_cell[grid.index(x, y, z)] = static_cast<uint32_t>(mesh.positions.size());
                mesh.positions.push_back(vertex);
            }
    for (size_t z = 1; z + 1 < grid.points[2]; ++z)
        for (size_t y = 1; y + 1 < grid.points[1]; ++y)
            for (size_t x = 1; x + 1 < grid.points[0]; ++x)
                for (size_t axis = 0; axis < 3; ++axis)
                    addQuad(grid, vertex_of_cell, axis, grid.index(x, y, z), mesh.indices);

    mesh.normals.resize(mesh.positions.size());
    parallelFor(mesh.positions.size(),
                [&](size_t v)
                {
                    Float3& p = mesh.positions[v];
                    const float step = 0.1f * cell;
                    for (int iteration = 0; iteration < 2; ++iteration) // Newton's method towards zero
                    {
                        const Float3 slope = gradient(distance, p, step);
                        p -= slope * (distance(p) / std::max(dot(slope, slope), 0.25f));
                    }
                    mesh.normals[v] = normalize(gradient(distance, p, step));
                });
    return mesh;
}

} // namespace hearth::samples

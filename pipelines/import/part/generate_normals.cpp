// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/part/generate_normals.h"

#include "formats/base/csr_lists.h"
#include "formats/base/double3.h"
#include "pipelines/import/part/mesh_pieces.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

namespace hearth::import
{

namespace
{

/// Normal of a triangle, with direction and weight separate, so that huge and tiny triangles behave alike.
struct FaceNormal
{
    Double3 unit;    ///< zero where the triangle has no area
    double area = 0; ///< twice the area
};

FaceNormal faceNormal(Float3 a, Float3 b, Float3 c)
{
    const Double3 n = cross(widen(b) - widen(a), widen(c) - widen(a));
    const double area = length(n);
    if (!(area > 0))
        return {};
    return {{n.x / area, n.y / area, n.z / area}, area};
}

std::vector<FaceNormal> faceNormals(const mesh::SourceMesh& mesh)
{
    std::vector<FaceNormal> normals(mesh.triangleCount());
    for (size_t triangle = 0; triangle < normals.size(); ++triangle)
    {
        const uint32_t* corner = mesh.indices.data() + triangle * 3;
        normals[triangle] =
            faceNormal(mesh.positions[corner[0]], mesh.positions[corner[1]], mesh.positions[corner[2]]);
    }
    return normals;
}

/// Return a point index for each vertex. Vertices at the same position share a point, so that an unindexed
/// triangle soup is smooth too.
std::vector<uint32_t> computePointIds(const mesh::SourceMesh& mesh)
{
    const auto& p = mesh.positions;
    std::vector<uint32_t> order(p.size());
    std::iota(order.begin(), order.end(), 0u);
    tbb::parallel_sort(order.begin(), order.end(),
                       [&](uint32_t a, uint32_t b)
                       { return std::tie(p[a].x, p[a].y, p[a].z, a) < std::tie(p[b].x, p[b].y, p[b].z, b); });
    std::vector<uint32_t> point_of_vertex(p.size());
    uint32_t point = 0;
    for (size_t i = 0; i < order.size(); ++i)
    {
        if (i > 0 && p[order[i]] != p[order[i - 1]])
            ++point;
        point_of_vertex[order[i]] = point;
    }
    return point_of_vertex;
}

/// Return the corners (3 * triangle + k) at each point.
CsrLists<uint32_t> groupCorners(const mesh::SourceMesh& mesh, const std::vector<uint32_t>& point_of_vertex)
{
    const uint32_t point_count =
        point_of_vertex.empty() ? 0 : *std::max_element(point_of_vertex.begin(), point_of_vertex.end()) + 1;
    return CsrLists<uint32_t>(point_count,
                              [&](const auto& add)
                              {
                                  for (uint32_t corner = 0; corner < mesh.indices.size(); ++corner)
                                      add(point_of_vertex[mesh.indices[corner]], corner);
                              });
}

/// Direction of a face around a point. A point has at most kMaxDirections, so that the cost of a fan of a
/// million triangles stays linear.
struct FaceDirection
{
    Double3 unit;
    Double3 weighted_sum;
};
constexpr size_t kMaxDirections = 256;

/// Return the cell of a unit vector in a 16 x 16 grid on the octahedron.
uint32_t octahedralCell(const Double3& n)
{
    const double scale = 1.0 / (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
    double u = n.x * scale;
    double v = n.y * scale;
    if (n.z < 0)
    {
        const double folded = (1 - std::abs(v)) * (u < 0 ? -1.0 : 1.0);
        v = (1 - std::abs(u)) * (v < 0 ? -1.0 : 1.0);
        u = folded;
    }
    const auto cell = [](double x) { return std::min(static_cast<uint32_t>((x * 0.5 + 0.5) * 16.0), 15u); };
    return cell(v) * 16 + cell(u);
}

void addTo(Double3& sum, const Double3& unit, double weight)
{
    sum.x += unit.x * weight;
    sum.y += unit.y * weight;
    sum.z += unit.z * weight;
}

std::optional<Double3> normalized(const Double3& v)
{
    const double length = std::sqrt(dot(v, v));
    if (!(length > 0))
        return std::nullopt;
    return Double3{v.x / length, v.y / length, v.z / length};
}

void collectDirections(std::span<const uint32_t> corners, const std::vector<FaceNormal>& faces,
                       std::vector<FaceDirection>& directions)
{
    directions.clear();
    if (corners.size() <= kMaxDirections)
    {
        for (const uint32_t corner : corners)
        {
            const FaceNormal& face = faces[corner / 3];
            FaceDirection direction{face.unit, {}};
            addTo(direction.weighted_sum, face.unit, face.area);
            if (face.area > 0)
                directions.push_back(direction);
        }
        return;
    }
    std::array<Double3, kMaxDirections> cells{};
    for (const uint32_t corner : corners)
    {
        const FaceNormal& face = faces[corner / 3];
        if (face.area > 0)
            addTo(cells[octahedralCell(face.unit)], face.unit, face.area);
    }
    for (const Double3& sum : cells)
        if (const auto unit = normalized(sum))
            directions.push_back({*unit, sum});
}

Float3 toFloat(const Double3& v)
{
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// Return the normal of a corner of `face`: the average of the directions within the crease angle.
Float3 cornerNormal(const FaceNormal& face, std::span<const FaceDirection> directions, double min_cosine)
{
    Double3 sum;
    for (const FaceDirection& direction : directions)
        if (face.area == 0 || dot(direction.unit, face.unit) >= min_cosine)
            addTo(sum, direction.weighted_sum, 1);
    if (const auto unit = normalized(sum))
        return toFloat(*unit);
    return face.area > 0 ? toFloat(face.unit) : Float3{0, 0, 1};
}

std::vector<Float3> cornerNormals(const mesh::SourceMesh& mesh, float crease_angle_rad)
{
    // normals of coplanar faces differ by rounding
    constexpr double kCosineRounding = 1e-6;
    const double min_cosine = std::cos(static_cast<double>(crease_angle_rad)) - kCosineRounding;
    const std::vector<FaceNormal> faces = faceNormals(mesh);
    const CsrLists<uint32_t> corners_at = groupCorners(mesh, computePointIds(mesh));
    std::vector<Float3> normals(mesh.indices.size());
    tbb::parallel_for(tbb::blocked_range<size_t>(0, corners_at.size()),
                      [&](const tbb::blocked_range<size_t>& points)
                      {
                          std::vector<FaceDirection> directions;
                          for (size_t point = points.begin(); point < points.end(); ++point)
                          {
                              collectDirections(corners_at[point], faces, directions);
                              for (const uint32_t corner : corners_at[point])
                                  normals[corner] = cornerNormal(faces[corner / 3], directions, min_cosine);
                          }
                      });
    return normals;
}

/// Corner with the values that decide if it may share its vertex with another corner.
struct SplitCorner
{
    uint32_t vertex;
    std::array<int16_t, 3> direction; ///< of the normal, in steps too small to see
    uint32_t corner;
    friend auto operator<=>(const SplitCorner&, const SplitCorner&) = default;
    bool sharesVertexWith(const SplitCorner& other) const
    {
        return vertex == other.vertex && direction == other.direction;
    }
};

/// Give each vertex one copy for each distinct normal direction of its corners.
void splitVertices(mesh::SourceMesh& mesh, const std::vector<Float3>& corner_normals)
{
    constexpr float kSteps = 16384;
    std::vector<SplitCorner> corners(mesh.indices.size());
    for (uint32_t corner = 0; corner < corners.size(); ++corner)
    {
        const Float3 n = corner_normals[corner];
        const auto step = [](float value) { return static_cast<int16_t>(std::lround(value * kSteps)); };
        corners[corner] = {mesh.indices[corner], {step(n.x), step(n.y), step(n.z)}, corner};
    }
    tbb::parallel_sort(corners.begin(), corners.end());

    std::vector<uint32_t> old_from_new;
    std::vector<Float3> normals;
    for (size_t i = 0; i < corners.size(); ++i)
    {
        if (i == 0 || !corners[i].sharesVertexWith(corners[i - 1]))
        {
            old_from_new.push_back(corners[i].vertex);
            normals.push_back(corner_normals[corners[i].corner]);
        }
        mesh.indices[corners[i].corner] = static_cast<uint32_t>(old_from_new.size() - 1);
    }
    mesh.normals.clear();
    gatherVertices(mesh, old_from_new);
    mesh.normals = std::move(normals);
}

} // namespace

void generateNormals(mesh::SourceMesh& mesh, float crease_angle_rad)
{
    splitVertices(mesh, cornerNormals(mesh, crease_angle_rad));
}

} // namespace hearth::import

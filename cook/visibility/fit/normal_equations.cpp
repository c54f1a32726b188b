// Assembles the linear system of least squares vertex baking: L. Kavan, A. W. Bargteil, P.-P. Sloan, "Least
// squares vertex baking", 2011. Differs: the regulariser is one row for each edge, weighted by (A1 + A2)^2,
// and the mass is sampled like the right-hand side.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/fit/normal_equations.h"

#include "formats/base/assert.h"
#include "formats/base/csr_lists.h"
#include "formats/base/double3.h"

#include <algorithm>

namespace hearth::visibility
{

namespace
{

// Share of the determinant that a triangle's mass would have if it were sampled everywhere; a triangle below
// it is undersampled and gets a membrane. Without that, corners would follow the noise of samples that lie in
// a row, and the solver would take hundreds of iterations for models of loose triangles.
constexpr double kMinDeterminantShare = 0.3;

double triangleArea(std::span<const Float3> positions, const uint32_t* corners)
{
    const Double3 a = widen(positions[corners[0]]);
    return length(cross(widen(positions[corners[1]]) - a, widen(positions[corners[2]]) - a)) / 2;
}

/// Sums over the samples of one triangle.
struct TriangleSums
{
    double mass[6] = {0, 0, 0, 0, 0, 0}; ///< of pairs of corners: 00, 11, 22, 01, 12, 20
    Block4 right[3];
    double area = 0;                                                 ///< of the samples, times their weights
    double whole = 0;                                                ///< of the samples, with weights of 1
    double corner_areas[3] = {0, 0, 0}, corner_whole[3] = {0, 0, 0}; ///< split among the corners

    /// Share of the triangle's area that counts.
    double share() const { return whole > 0 ? area / whole : 1; }
};

std::vector<TriangleSums> sumSamples(size_t triangle_count, std::span<const SurfaceSample> samples,
                                     std::span<const Moments> values)
{
    std::vector<TriangleSums> sums(triangle_count);
    for (size_t i = 0; i < samples.size(); ++i)
    {
        const SurfaceSample& sample = samples[i];
        if (sample.triangle == kInvalidIndex)
            continue;
        TriangleSums& sum = sums[sample.triangle];
        const double u = sample.u, v = sample.v, whole = sample.area, area = whole * double{sample.weight};
        sum.area += area;
        sum.whole += whole;
        const double weights[3] = {1 - u - v, u, v};
        const Block4 value = blockFromMoments(values[i]);
        for (size_t k = 0; k < 3; ++k)
        {
            sum.mass[k] += weights[k] * weights[k] * area;
            sum.mass[3 + k] += weights[k] * weights[(k + 1) % 3] * area;
            sum.right[k].addScaled(value, weights[k] * area);
            sum.corner_areas[k] += weights[k] * area;
            sum.corner_whole[k] += weights[k] * whole;
        }
    }
    return sums;
}

/// Create the entries of the matrix: pairs of vertices of one triangle, and of vertices opposite to each
/// other across an edge.
SparseMatrix createPattern(const FitMesh& fit_mesh)
{
    const size_t rows = fit_mesh.positions.size();
    // every pair twice, once for each row; pairs along an edge once for each triangle of the edge
    const auto forPairs = [&](const auto& use)
    {
        for (size_t t = 0; t < fit_mesh.indices.size(); t += 3)
            for (size_t k = 0; k < 3; ++k)
                use(fit_mesh.indices[t + k], fit_mesh.indices[t + (k + 1) % 3]);
        for (const mesh::InteriorEdge& edge : fit_mesh.edges)
            use(edge.k, edge.l);
    };
    CsrLists<uint32_t> entries(rows,
                               [&](const auto& add)
                               {
                                   for (uint32_t row = 0; row < rows; ++row)
                                       add(row, row); // the diagonal
                                   forPairs(
                                       [&](uint32_t a, uint32_t b)
                                       {
                                           add(a, b);
                                           add(b, a);
                                       });
                               });
    SparseMatrix matrix;
    matrix.row_start.push_back(0);
    matrix.columns.reserve(entries.items().size());
    for (size_t row = 0; row < rows; ++row)
    {
        const std::span<uint32_t> columns = entries[row];
        std::sort(columns.begin(), columns.end());
        matrix.columns.insert(matrix.columns.end(), columns.begin(),
                              std::unique(columns.begin(), columns.end()));
        matrix.row_start.push_back(static_cast<uint32_t>(matrix.columns.size()));
    }
    matrix.values.assign(matrix.columns.size(), 0);
    return matrix;
}

double& entry(SparseMatrix& matrix, uint32_t row, uint32_t column)
{
    const auto begin = matrix.columns.begin() + matrix.row_start[row];
    const auto end = matrix.columns.begin() + matrix.row_start[row + 1];
    const auto found = std::find(begin, end, column); // about a dozen entries: faster than a binary search
    return matrix.values[static_cast<size_t>(found - matrix.columns.begin())];
}

void addSymmetric(SparseMatrix& matrix, uint32_t a, uint32_t b, double value)
{
    entry(matrix, a, b) += value;
    // twice on the diagonal, where a triangle names a vertex twice: both products belong there
    entry(matrix, b, a) += value;
}

void addMass(NormalEquations& system, const FitMesh& fit_mesh, const std::vector<TriangleSums>& sums)
{
    for (size_t t = 0; t < sums.size(); ++t)
    {
        const uint32_t* corners = fit_mesh.indices.data() + t * 3;
        const double* mass = sums[t].mass;
        for (size_t k = 0; k < 3; ++k)
        {
            entry(system.matrix, corners[k], corners[k]) += mass[k];
            addSymmetric(system.matrix, corners[k], corners[(k + 1) % 3], mass[3 + k]);
            system.right[corners[k]].addScaled(sums[t].right[k], 1);
            system.mass[corners[k]] += mass[k] + mass[3 + k] + mass[3 + (k + 2) % 3];
        }
    }
}

/// Compute the factor of a row that limits each squared coefficient to `stiffness` times its vertex's area.
double rowScale(const std::array<double, 4>& jump, const std::array<uint32_t, 4>& vertices,
                std::span<const double> areas, double stiffness)
{
    double factor = 1;
    for (size_t i = 0; i < 4; ++i)
        if (const double square = jump[i] * jump[i], limit = stiffness * areas[vertices[i]]; square > limit)
            factor = std::min(factor, std::sqrt(limit / square));
    return factor;
}

/// Compute for each vertex a third of the area of its triangles.
std::vector<double> computeVertexAreas(const FitMesh& fit_mesh)
{
    std::vector<double> areas(fit_mesh.positions.size(), 0);
    for (size_t t = 0; t < fit_mesh.indices.size(); t += 3)
    {
        const double third = triangleArea(fit_mesh.positions, &fit_mesh.indices[t]) / 3;
        for (size_t k = 0; k < 3; ++k)
            areas[fit_mesh.indices[t + k]] += third;
    }
    return areas;
}

/// Compute the share of the area around each vertex that counts.
std::vector<double> computeVertexShares(const FitMesh& fit_mesh, const std::vector<TriangleSums>& sums)
{
    std::vector<double> area(fit_mesh.positions.size(), 0), whole(area.size(), 0);
    for (size_t t = 0; t < sums.size(); ++t)
        for (size_t k = 0; k < 3; ++k)
        {
            area[fit_mesh.indices[t * 3 + k]] += sums[t].corner_areas[k];
            whole[fit_mesh.indices[t * 3 + k]] += sums[t].corner_whole[k];
        }
    for (size_t v = 0; v < area.size(); ++v)
        area[v] = whole[v] > 0 ? area[v] / whole[v] : 1;
    return area;
}

/// Add the jumps of gradients, scaled by the smallest share of area that counts around their vertices.
/// Without the scale, a vertex with almost no counting area would depend on jumps alone, which takes hundreds
/// of iterations and spreads its value.
void addJumps(NormalEquations& system, const FitMesh& fit_mesh, std::span<const double> areas,
              std::span<const double> shares, double alpha, double stiffness)
{
    for (const mesh::InteriorEdge& edge : fit_mesh.edges)
    {
        std::array<double, 4> jump = gradientJump(fit_mesh.positions, edge);
        const std::array<uint32_t, 4> vertices{edge.a, edge.b, edge.k, edge.l};
        double share = 1;
        for (const uint32_t vertex : vertices)
            share = std::min(share, shares[vertex]);
        const double factor = rowScale(jump, vertices, areas, stiffness) * std::sqrt(share);
        for (double& part : jump)
            part *= factor;
        for (size_t i = 0; i < 4; ++i)
        {
            entry(system.matrix, vertices[i], vertices[i]) += alpha * jump[i] * jump[i];
            for (size_t j = i + 1; j < 4; ++j)
                addSymmetric(system.matrix, vertices[i], vertices[j], alpha * jump[i] * jump[j]);
        }
    }
}

/// Return 1 where the samples say nothing about differences within the triangle, 0 where they say enough: by
/// the determinant of their mass over the determinant of the whole area's mass, which is (A / 12)^3 times the
/// determinant of ((2, 1, 1), (1, 2, 1), (1, 1, 2)).
double undersampling(const TriangleSums& sums, double area)
{
    const double* m = sums.mass;
    const double determinant = m[0] * m[1] * m[2] + 2 * m[3] * m[4] * m[5] - m[0] * m[4] * m[4] -
                               m[1] * m[5] * m[5] - m[2] * m[3] * m[3];
    const double twelfth = area / 12, whole = 4 * twelfth * twelfth * twelfth;
    return whole > 0 ? std::clamp(1 - determinant / (kMinDeterminantShare * whole), 0.0, 1.0) : 0;
}

/// Add share * area * undersampling times the sum of (u_i - u_j)^2 over the edges of each triangle.
void addMembrane(NormalEquations& system, const FitMesh& fit_mesh, const std::vector<TriangleSums>& sums,
                 double share)
{
    for (size_t t = 0; t < sums.size(); ++t)
    {
        const uint32_t* corners = &fit_mesh.indices[t * 3];
        const double area = triangleArea(fit_mesh.positions, corners) * sums[t].share();
        const double weight = share * area * undersampling(sums[t], area);
        if (!(weight > 0))
            continue;
        for (size_t k = 0; k < 3; ++k)
        {
            const uint32_t a = corners[k], b = corners[(k + 1) % 3];
            if (a == b)
                continue;
            entry(system.matrix, a, a) += weight;
            entry(system.matrix, b, b) += weight;
            addSymmetric(system.matrix, a, b, -weight);
        }
    }
}

std::vector<uint32_t> findIslands(const FitMesh& fit_mesh)
{
    std::vector<uint32_t> island(fit_mesh.positions.size());
    std::iota(island.begin(), island.end(), 0u);
    const auto find = [&](uint32_t v)
    {
        while (island[v] != v)
            v = island[v] = island[island[v]];
        return v;
    };
    for (size_t t = 0; t < fit_mesh.indices.size(); t += 3)
        for (size_t k = 1; k < 3; ++k)
        {
            const uint32_t a = find(fit_mesh.indices[t]), b = find(fit_mesh.indices[t + k]);
            island[std::max(a, b)] = std::min(a, b);
        }
    for (uint32_t v = 0; v < island.size(); ++v)
        island[v] = find(v);
    return island;
}

} // namespace

std::array<double, 4> gradientJump(std::span<const Float3> positions, const mesh::InteriorEdge& edge)
{
    const Double3 a = widen(positions[edge.a]);
    const Double3 along = widen(positions[edge.b]) - a;
    const Double3 to_k = widen(positions[edge.k]) - a, to_l = widen(positions[edge.l]) - a;
    const double length2 = dot(along, along);
    const double double_k = length(cross(along, to_k)), double_l = length(cross(along, to_l));
    if (!(length2 > 0) || !(double_k > 0) || !(double_l > 0))
        return {0, 0, 0, 0};
    // u_k minus u at the foot of k on the edge, divided by the height 2 A / L; the gradients agree along the
    // edge
    const double weight = (double_k + double_l) / 2 * std::sqrt(length2);
    const double k = weight / double_k, l = weight / double_l;
    const double foot_k = dot(to_k, along) / length2, foot_l = dot(to_l, along) / length2;
    return {-k * (1 - foot_k) - l * (1 - foot_l), -k * foot_k - l * foot_l, k, l};
}

NormalEquations assemble(const FitMesh& fit_mesh, std::span<const SurfaceSample> samples,
                         std::span<const Moments> values, const FitSettings& settings)
{
    HEARTH_ASSERT(samples.size() == values.size());
    const std::vector<TriangleSums> sums = sumSamples(fit_mesh.indices.size() / 3, samples, values);
    NormalEquations system;
    system.matrix = createPattern(fit_mesh);
    system.right.resize(fit_mesh.positions.size());
    system.mass.assign(fit_mesh.positions.size(), 0);
    addMass(system, fit_mesh, sums);
    addJumps(system, fit_mesh, computeVertexAreas(fit_mesh), computeVertexShares(fit_mesh, sums),
             settings.alpha, settings.stiffness);
    addMembrane(system, fit_mesh, sums, settings.membrane);
    system.island = findIslands(fit_mesh);
    return system;
}

} // namespace hearth::visibility

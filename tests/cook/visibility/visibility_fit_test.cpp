// Compares least-squares vertex baking of visibility with dense systems that are assembled independently, and
// with Ceres.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/fit/incomplete_cholesky.h"
#include "cook/visibility/fit/normal_equations.h"
#include "cook/visibility/fit/vertex_fit.h"
#include "formats/base/double3.h"
#include "tests/cook/visibility/mesh_samples.h"
#include "tests/support/shapes.h"

#include <Eigen/Dense>
#include <ceres/dynamic_autodiff_cost_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <cstring>
#include <gtest/gtest.h>
#include <random>
#include <tbb/global_control.h>

namespace hearth::visibility
{

using test::getPoint;
using test::makeMeshView;
using test::makeSamples;

namespace
{

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

/// FitMesh of a mesh, without normals, so that the clamp does not change directions.
FitMesh buildFitMesh(const mesh::SourceMesh& mesh, const FitMeshSettings& settings = {})
{
    FitMesh fit_mesh = makeFitMesh(makeMeshView(mesh), settings);
    std::fill(fit_mesh.normals.begin(), fit_mesh.normals.end(), Float3{});
    return fit_mesh;
}

/// Moments that vary smoothly over space and that clamping leaves alone.
Moments fieldAt(Float3 p)
{
    return {3 + 0.4f * std::sin(2 * p.x) + 0.2f * p.y,
            {0.3f * std::cos(3 * p.y), 0.2f * p.z, 0.5f + 0.2f * std::sin(p.x + p.z)}};
}

std::vector<Moments> sampleField(const FitMesh& fit_mesh, const std::vector<SurfaceSample>& samples)
{
    std::vector<Moments> values;
    for (const SurfaceSample& sample : samples)
        values.push_back(fieldAt(getPoint(fit_mesh.view(), sample)));
    return values;
}

/// Settings as published: all gradient jumps at full weight, and no other regularization.
FitSettings asPublished()
{
    FitSettings settings;
    settings.stiffness = std::numeric_limits<double>::infinity();
    settings.membrane = 0;
    return settings;
}

/// Standard normal random numbers (Box-Muller).
class Normal
{
public:
    explicit Normal(uint32_t seed) : random_(seed) {}

    float operator()()
    {
        const double u = (static_cast<double>(random_()) + 1) * 0x1p-32;
        const double v = static_cast<double>(random_()) * 0x1p-32;
        return static_cast<float>(std::sqrt(-2 * std::log(u)) * std::cos(2 * 3.14159265358979 * v));
    }

private:
    std::mt19937 random_;
};

/// Gradient of a linear function on a triangle in the plane, from its values at the corners.
Eigen::Matrix<double, 2, 3> computeGradient(const std::array<Eigen::Vector2d, 3>& corners)
{
    Eigen::Matrix2d edges;
    edges << (corners[1] - corners[0]).transpose(), (corners[2] - corners[0]).transpose();
    Eigen::Matrix<double, 2, 3> differences;
    differences << -1, 1, 0, -1, 0, 1;
    return edges.inverse() * differences;
}

/// Return the matrix over vertices a, b, k, l of (A1 + A2)^2 |g1 - g2|^2. Both triangles lie in one plane
/// with the edge along the first axis.
Eigen::Matrix4d computeJump(const FitMesh& fit_mesh, const mesh::InteriorEdge& edge)
{
    const auto at = [&](uint32_t v) { return widen(fit_mesh.positions[v]); };
    const Double3 along = at(edge.b) - at(edge.a);
    const double size = length(along);
    const auto flat = [&](uint32_t v, double side)
    {
        const Double3 to = at(v) - at(edge.a);
        const double x = dot(to, along) / size;
        return Eigen::Vector2d(x, side * std::sqrt(std::max(0.0, dot(to, to) - x * x)));
    };
    const Eigen::Vector2d a(0, 0), b(size, 0), k = flat(edge.k, 1), l = flat(edge.l, -1);
    const Eigen::Matrix<double, 2, 3> gk = computeGradient({a, b, k}), gl = computeGradient({a, b, l});
    Eigen::Matrix<double, 2, 4> jump;
    jump << gk.col(0) - gl.col(0), gk.col(1) - gl.col(1), gk.col(2), -gl.col(2);
    const double area = size * (k.y() - l.y()) / 2;
    return area * area * jump.transpose() * jump;
}

/// Return the inverse matrix that the preconditioner applies.
Matrix invert(const SparseMatrix& matrix)
{
    const size_t rows = matrix.rowCount();
    const IncompleteCholesky preconditioner(matrix);
    Matrix inverse(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(rows));
    std::vector<Block4> unit(rows), z(rows);
    for (size_t column = 0; column < rows; ++column)
    {
        unit[column].v[0] = 1;
        preconditioner.apply(unit, z);
        unit[column].v[0] = 0;
        for (size_t row = 0; row < rows; ++row)
            inverse(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) = z[row].v[0];
    }
    return (inverse + inverse.transpose()) / 2;
}

struct Dense
{
    Matrix mass;
    Matrix jumps;
    Matrix right; ///< four columns

    Matrix all(double alpha) const { return mass + alpha * jumps; }
};

Dense makeDense(const FitMesh& fit_mesh, const std::vector<SurfaceSample>& samples,
                const std::vector<Moments>& values)
{
    const auto n = static_cast<Eigen::Index>(fit_mesh.positions.size());
    Dense dense{Matrix::Zero(n, n), Matrix::Zero(n, n), Matrix::Zero(n, 4)};
    for (size_t i = 0; i < samples.size(); ++i)
    {
        Vector row = Vector::Zero(n);
        const uint32_t* corners = &fit_mesh.indices[size_t{samples[i].triangle} * 3];
        const double u = samples[i].u, v = samples[i].v;
        row[corners[0]] += 1 - u - v;
        row[corners[1]] += u;
        row[corners[2]] += v;
        dense.mass += samples[i].area * row * row.transpose();
        const Moments& m = values[i];
        dense.right += samples[i].area * row * Eigen::RowVector4d(m.m0, m.m1.x, m.m1.y, m.m1.z);
    }
    for (const mesh::InteriorEdge& edge : fit_mesh.edges)
    {
        const std::array<uint32_t, 4> vertices{edge.a, edge.b, edge.k, edge.l};
        const Eigen::Matrix4d jump = computeJump(fit_mesh, edge);
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j)
                dense.jumps(vertices[static_cast<size_t>(i)], vertices[static_cast<size_t>(j)]) += jump(i, j);
    }
    return dense;
}

double largestDifference(const std::vector<Moments>& moments, const Matrix& expected)
{
    double largest = 0;
    for (size_t v = 0; v < moments.size(); ++v)
        for (int k = 0; k < 4; ++k)
            largest = std::max(largest, std::abs(blockFromMoments(moments[v]).v[k] -
                                                 expected(static_cast<Eigen::Index>(v), k)));
    return largest;
}

constexpr double kAlpha = 0.1;

/// Ceres residuals: one for each term of the fit's sum of squares.
struct CeresResiduals
{
    const FitMesh& fit_mesh;
    const std::vector<SurfaceSample>& samples;
    const std::vector<Moments>& values;

    template <typename T>
    bool operator()(const T* const* parameters, T* residuals) const
    {
        const T* u = parameters[0];
        for (size_t i = 0; i < samples.size(); ++i)
        {
            const SurfaceSample& s = samples[i];
            const uint32_t* c = &fit_mesh.indices[size_t{s.triangle} * 3];
            const T interpolated =
                u[c[0]] * double(1 - s.u - s.v) + u[c[1]] * double(s.u) + u[c[2]] * double(s.v);
            *residuals++ = (interpolated - double(values[i].m0)) * std::sqrt(double(s.area));
        }
        for (const mesh::InteriorEdge& edge : fit_mesh.edges)
        {
            const std::array<double, 4> jump = gradientJump(fit_mesh.positions, edge);
            *residuals++ =
                (u[edge.a] * jump[0] + u[edge.b] * jump[1] + u[edge.k] * jump[2] + u[edge.l] * jump[3]) *
                std::sqrt(kAlpha);
        }
        return true;
    }
};

/// Flat mesh with vertices moved at random in its plane.
mesh::SourceMesh unevenGrid(uint32_t n)
{
    mesh::SourceMesh grid = shapes::grid(n);
    std::mt19937 random(4);
    for (Float3& p : grid.positions)
        for (float* x : {&p.x, &p.y, &p.z})
            *x += *x > 0.001f && *x < 0.999f
                      ? (static_cast<float>(random() % 1000) / 1000 - 0.5f) * 0.6f / static_cast<float>(n)
                      : 0;
    grid.normals.assign(grid.vertexCount(), {0, 0, 1});
    return grid;
}

} // namespace

TEST(GradientJump, isTheOuterProductOfBakingForAUnitSquare)
{
    const std::vector<Float3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const std::array<double, 4> jump = gradientJump(square, {0, 2, 1, 3, {0, 1}});
    const std::array<double, 4> expected{-std::sqrt(2.0), -std::sqrt(2.0), std::sqrt(2.0), std::sqrt(2.0)};
    for (size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(jump[i], expected[i], 1e-12);
}

TEST(GradientJump, isWhatDifferencesOfGradientsGive)
{
    const FitMesh fit_mesh = buildFitMesh(shapes::rock(3, 0.6f));
    ASSERT_GT(fit_mesh.edges.size(), 50u);
    for (const mesh::InteriorEdge& edge : fit_mesh.edges)
    {
        const std::array<double, 4> jump = gradientJump(fit_mesh.positions, edge);
        const Eigen::Vector4d row(jump.data());
        EXPECT_LT((row * row.transpose() - computeJump(fit_mesh, edge)).norm(),
                  1e-9 * computeJump(fit_mesh, edge).norm());
        EXPECT_NEAR(row.sum(), 0, 1e-9) << "constants have no gradient";
    }
}

TEST(GradientJump, isNothingForLinearFunctionsInAPlane)
{
    const FitMesh fit_mesh = buildFitMesh(unevenGrid(8));
    for (const mesh::InteriorEdge& edge : fit_mesh.edges)
    {
        const std::array<double, 4> jump = gradientJump(fit_mesh.positions, edge);
        const std::array<uint32_t, 4> vertices{edge.a, edge.b, edge.k, edge.l};
        double sum = 0;
        for (size_t i = 0; i < 4; ++i)
            sum += jump[i] * dot(widen(fit_mesh.positions[vertices[i]]), Double3{1, -3, 2});
        EXPECT_NEAR(sum, 0, 1e-9);
    }
}

TEST(FitVertices, isTheSolutionOfTheDenseSystem)
{
    for (const double alpha : {0.0, 0.1, 1.0})
    {
        const FitMesh fit_mesh = buildFitMesh(shapes::rock(4, 0.4f));
        const std::vector<SurfaceSample> samples = makeSamples(fit_mesh.view(), 5);
        const std::vector<Moments> values = sampleField(fit_mesh, samples);
        FitSettings settings = asPublished();
        settings.alpha = alpha;
        const FitResult fit = fitVertices(fit_mesh, samples, values, settings);
        const Dense dense = makeDense(fit_mesh, samples, values);
        const Matrix expected = dense.all(alpha).ldlt().solve(dense.right);
        EXPECT_LT(largestDifference(fit.moments, expected), 2e-6) << "alpha " << alpha;
        EXPECT_TRUE(fit.statistics.solve.converged);
        EXPECT_EQ(fit.statistics.clamped, 0u);

        const Matrix inverse = invert(assemble(fit_mesh, samples, values, settings).matrix);
        const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> eigen(dense.all(alpha), inverse.inverse());
        const double condition = eigen.eigenvalues().maxCoeff() / eigen.eigenvalues().minCoeff();
        EXPECT_LE(fit.statistics.solve.condition, condition * 1.01);
        EXPECT_GE(fit.statistics.solve.condition, condition * 0.7);
    }
}

TEST(FitVertices, isWhatCeresFinds)
{
    const FitMesh fit_mesh = buildFitMesh(shapes::rock(2, 0.4f));
    const std::vector<SurfaceSample> samples = makeSamples(fit_mesh.view(), 4);
    const std::vector<Moments> values = sampleField(fit_mesh, samples);
    auto* cost = new ceres::DynamicAutoDiffCostFunction<CeresResiduals, 8>(
        new CeresResiduals{fit_mesh, samples, values});
    cost->AddParameterBlock(static_cast<int>(fit_mesh.positions.size()));
    cost->SetNumResiduals(static_cast<int>(samples.size() + fit_mesh.edges.size()));
    std::vector<double> u(fit_mesh.positions.size(), 0);
    ceres::Problem problem;
    problem.AddResidualBlock(cost, nullptr, u.data());
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.logging_type = ceres::SILENT;
    options.function_tolerance = options.gradient_tolerance = options.parameter_tolerance = 1e-14;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);

    FitSettings settings = asPublished();
    settings.alpha = kAlpha;
    const FitResult fit = fitVertices(fit_mesh, samples, values, settings);
    for (size_t v = 0; v < u.size(); ++v)
        EXPECT_NEAR(fit.moments[v].m0, u[v], 2e-6);
}

TEST(FitVertices, bringsConstantsBackOnAnyMesh)
{
    const Moments constant{3, {0.1f, -0.5f, 0.7f}};
    std::vector<mesh::SourceMesh> meshes{shapes::rock(6, 0.5f),   shapes::blocks(3),
                                         shapes::tangle(80, 500), shapes::soup(60),
                                         shapes::moebius(20, 2),  unevenGrid(9)};
    for (mesh::SourceMesh& mesh : meshes)
    {
        mesh.normals.resize(mesh.vertexCount(), {0, 0, 1});
        const FitMesh fit_mesh = buildFitMesh(mesh);
        std::vector<SurfaceSample> samples = makeSamples(fit_mesh.view(), 2);
        std::mt19937 random(9);
        // some triangles have no sample; in the triangle soup, whole components have none
        std::erase_if(samples, [&](const SurfaceSample&) { return random() % 3 == 0; });
        const std::vector<Moments> values(samples.size(), constant);
        const FitResult fit = fitVertices(fit_mesh, samples, values);
        const Moments open{6.2831853f, {}};
        uint32_t unseen = 0;
        for (const Moments& m : fit.moments)
        {
            if (std::abs(m.m0 - open.m0) < 1e-5f)
            {
                ++unseen;
                continue;
            }
            EXPECT_NEAR(m.m0, constant.m0, 3e-6f);
            EXPECT_LT(length(m.m1 - constant.m1), 3e-6f);
        }
        EXPECT_EQ(unseen, fit.statistics.unseen);
    }
}

TEST(FitVertices, bringsLinearFunctionsBackInAPlane)
{
    const FitMesh fit_mesh = buildFitMesh(unevenGrid(10));
    const std::vector<SurfaceSample> samples = makeSamples(fit_mesh.view(), 40);
    std::vector<Moments> values;
    const auto linear = [](Float3 p) {
        return Moments{3 + p.x - 2 * p.y, {0.1f * p.x, 0.1f * p.z, 0.2f * p.y}};
    };
    for (const SurfaceSample& sample : samples)
        values.push_back(linear(getPoint(fit_mesh.view(), sample)));
    FitSettings settings;
    settings.alpha = 1;
    const FitResult fit = fitVertices(fit_mesh, samples, values, settings);
    for (size_t v = 0; v < fit_mesh.positions.size(); ++v)
        EXPECT_NEAR(fit.moments[v].m0, linear(fit_mesh.positions[v]).m0, 5e-6f);
}

TEST(FitVertices, needsFewIterationsWhereSmallTrianglesMeetLargeOnes)
{
    // cells that shrink to a hundredth and grow again; none is thin enough for the fit mesh to remove
    mesh::SourceMesh mesh = shapes::grid(30);
    Box3 box;
    for (const Float3 p : mesh.positions)
        box.add(p);
    for (Float3& p : mesh.positions)
        for (int axis = 0; axis < 3; ++axis)
            if (box.max[axis] > box.min[axis])
            {
                const float x = (p[axis] - box.min[axis]) / (box.max[axis] - box.min[axis]) * 2 - 1;
                p[axis] = x * x * x * 0.99f + x * 0.01f;
            }
    mesh.normals.assign(mesh.vertexCount(), {0, 0, 1});
    const FitMesh fit_mesh = buildFitMesh(mesh);
    const std::vector<SurfaceSample> samples = makeSamples(fit_mesh.view(), 4);
    const std::vector<Moments> values = sampleField(fit_mesh, samples);
    const SolveStatistics published = fitVertices(fit_mesh, samples, values, asPublished()).statistics.solve;
    const FitResult fit = fitVertices(fit_mesh, samples, values);
    std::printf("condition %.3g, %u iterations as published; %.3g, %u\n", published.condition,
                published.iterations, fit.statistics.solve.condition, fit.statistics.solve.iterations);
    EXPECT_LE(fit.statistics.solve.iterations, 40u);
    EXPECT_GE(published.iterations, 2 * fit.statistics.solve.iterations);
    for (size_t v = 0; v < fit_mesh.positions.size(); ++v)
        EXPECT_NEAR(fit.moments[v].m0, fieldAt(fit_mesh.positions[v]).m0, 0.04f);
}

TEST(FitVertices, makesTheBestOfTrianglesAlone)
{
    mesh::SourceMesh soup = shapes::soup(300);
    soup.normals.assign(soup.vertexCount(), {0, 0, 1});
    const FitMesh fit_mesh = buildFitMesh(soup);
    for (const uint32_t per_triangle : {1u, 2u, 3u, 4u})
    {
        const std::vector<SurfaceSample> samples = makeSamples(fit_mesh.view(), per_triangle);
        Normal normal(per_triangle);
        std::vector<Moments> values;
        for (size_t i = 0; i < samples.size(); ++i)
            values.push_back({3 + 0.1f * normal(), {}});
        const FitResult fit = fitVertices(fit_mesh, samples, values);
        EXPECT_LE(fit.statistics.solve.iterations, 45u);
        double sum = 0;
        for (const Moments& m : fit.moments)
            sum += (m.m0 - 3) * (m.m0 - 3);
        EXPECT_LT(std::sqrt(sum / static_cast<double>(fit.moments.size())), 0.2) << per_triangle;
    }
}

TEST(FitVertices, doesNotKnowTheUnitOfLength)
{
    mesh::SourceMesh mesh = shapes::rock(6, 0.4f);
    const FitMesh small = buildFitMesh(mesh);
    const std::vector<SurfaceSample> samples = makeSamples(small.view(), 3);
    const std::vector<Moments> values = sampleField(small, samples);
    for (const float factor : {100.0f, 1e-3f})
    {
        mesh::SourceMesh scaled = mesh;
        for (Float3& p : scaled.positions)
            p = p * factor;
        const FitMesh large = buildFitMesh(scaled);
        std::vector<SurfaceSample> moved = samples;
        for (SurfaceSample& sample : moved)
            sample.area *= factor * factor;
        const FitResult one = fitVertices(small, samples, values), other = fitVertices(large, moved, values);
        ASSERT_EQ(one.moments.size(), other.moments.size());
        for (size_t v = 0; v < one.moments.size(); ++v)
            EXPECT_NEAR(one.moments[v].m0, other.moments[v].m0, 2e-6f);
    }
}

TEST(FitVertices, solvesAroundVerticesThatAreHeld)
{
    const FitMesh fit_mesh = buildFitMesh(shapes::rock(4, 0.4f));
    const std::vector<SurfaceSample> samples = makeSamples(fit_mesh.view(), 4);
    const std::vector<Moments> values = sampleField(fit_mesh, samples);
    const size_t count = fit_mesh.positions.size();
    std::vector<uint8_t> is_held(count, 0);
    std::vector<Moments> moments(count);
    const Dense dense = makeDense(fit_mesh, samples, values);
    Matrix system = dense.all(0.1), right = dense.right;
    for (size_t v = 0; v < count; v += 3)
    {
        is_held[v] = 1;
        moments[v] = {2 + 0.001f * static_cast<float>(v), {0.1f, 0.2f, 0.3f}};
        const auto row = static_cast<Eigen::Index>(v);
        system.row(row).setZero(); // no longer symmetric, but an equivalent system
        system(row, row) = 1;
        for (int k = 0; k < 4; ++k)
            right(row, k) = blockFromMoments(moments[v]).v[k];
    }
    const FitResult fit = fitVertices(fit_mesh, samples, values, asPublished(), {is_held, moments});
    EXPECT_LT(largestDifference(fit.moments, system.partialPivLu().solve(right)), 2e-6);
    EXPECT_EQ(fit.statistics.held, (count + 2) / 3);
    for (size_t v = 0; v < count; v += 3)
        EXPECT_EQ(std::memcmp(&fit.moments[v], &moments[v], sizeof(Moments)), 0);
}

TEST(FitVertices, carriesOnWhereNoSamplesAre)
{
    const FitMesh fit_mesh = buildFitMesh(shapes::grid(20));
    std::vector<SurfaceSample> samples = makeSamples(fit_mesh.view(), 4);
    // a gap in the samples as wide as a quarter of the square
    const Box3 box = [&]
    {
        Box3 all;
        for (const Float3 p : fit_mesh.positions)
            all.add(p);
        return all;
    }();
    const Float3 center = box.center();
    std::erase_if(samples, [&](const SurfaceSample& s)
                  { return length(getPoint(fit_mesh.view(), s) - center) < 0.2f; });
    std::vector<Moments> values;
    const auto linear = [&](Float3 p) { return Moments{3 + dot(p - center, Float3{1, 1, 1}), {}}; };
    for (const SurfaceSample& sample : samples)
        values.push_back(linear(getPoint(fit_mesh.view(), sample)));
    const FitResult fit = fitVertices(fit_mesh, samples, values);
    for (size_t v = 0; v < fit_mesh.positions.size(); ++v)
        EXPECT_NEAR(fit.moments[v].m0, linear(fit_mesh.positions[v]).m0, 0.02f);
}

TEST(FitVertices, needsFewIterationsOnlyWithoutSlivers)
{
    mesh::SourceMesh mesh = unevenGrid(24);
    // a vertex a thousandth of an edge beside the midpoint of another edge
    const size_t t = mesh.triangleCount() / 2 * 3;
    const Float3 a = mesh.positions[mesh.indices[t]], b = mesh.positions[mesh.indices[t + 1]],
                 c = mesh.positions[mesh.indices[t + 2]];
    const uint32_t corner_c = mesh.indices[t + 2];
    const auto middle = static_cast<uint32_t>(mesh.positions.size());
    mesh.positions.push_back((a + b) * 0.5f + (c - (a + b) * 0.5f) * 2e-4f);
    mesh.normals.push_back({0, 0, 1});
    mesh.indices.insert(mesh.indices.end(),
                        {mesh.indices[t + 1], corner_c, middle, corner_c, mesh.indices[t], middle});
    mesh.indices[t + 2] = middle;
    FitMeshSettings raw;
    raw.thinness = 0;
    const FitMesh with = buildFitMesh(mesh, raw), without = buildFitMesh(mesh);
    const auto fitField = [](const FitMesh& fit_mesh)
    {
        const std::vector<SurfaceSample> samples = makeSamples(fit_mesh.view(), 4);
        return fitVertices(fit_mesh, samples, sampleField(fit_mesh, samples), asPublished()).statistics.solve;
    };
    const SolveStatistics slivers = fitField(with), clean = fitField(without);
    EXPECT_EQ(without.statistics.thin.flipped, 1u);
    EXPECT_LE(clean.iterations, 40u);
    EXPECT_LE(clean.condition, 40);
    EXPECT_GE(slivers.iterations, clean.iterations + 5);
    EXPECT_GE(slivers.condition, clean.condition * 100);
    std::printf("a sliver: condition %.3g, %u iterations; without: %.3g, %u\n", slivers.condition,
                slivers.iterations, clean.condition, clean.iterations);
}

TEST(FitVertices, needsFewIterationsForAnySize)
{
    for (const uint32_t per_triangle : {1u, 4u})
        for (const uint32_t n : {8u, 16u, 32u})
        {
            const FitMesh fit_mesh = buildFitMesh(shapes::rock(n, 0.5f));
            const std::vector<SurfaceSample> samples = makeSamples(fit_mesh.view(), per_triangle);
            const FitStatistics s = fitVertices(fit_mesh, samples, sampleField(fit_mesh, samples)).statistics;
            EXPECT_LE(s.solve.iterations, 40u);
            std::printf("%5zu vertices, %u samples a triangle: condition %.3g, %u iterations\n",
                        fit_mesh.positions.size(), per_triangle, s.solve.condition, s.solve.iterations);
        }
}

TEST(FitVertices, takesNoiseAway)
{
    const FitMesh fit_mesh = buildFitMesh(shapes::grid(40));
    const std::vector<SurfaceSample> samples = makeSamples(fit_mesh.view(), 8);
    const double per_vertex =
        static_cast<double>(samples.size()) / static_cast<double>(fit_mesh.positions.size());
    struct Expected
    {
        double alpha, least, most;
    };
    for (const Expected& e : {Expected{0, 1.8, 2.9}, {0.01, 0.75, 1.3}, {0.1, 0.18, 0.33}, {1, 0.03, 0.1}})
    {
        Normal normal(1);
        std::vector<Moments> values;
        for (size_t i = 0; i < samples.size(); ++i)
            values.push_back({3 + 0.1f * normal(), {0.1f * normal(), 0.1f * normal(), 1 + 0.1f * normal()}});
        FitSettings settings;
        settings.alpha = e.alpha;
        settings.max_iterations = 3000;
        const FitResult fit = fitVertices(fit_mesh, samples, values, settings);
        double sum = 0;
        size_t count = 0;
        for (size_t v = 0; v < fit_mesh.positions.size(); ++v)
        {
            const Float3 p = fit_mesh.positions[v];
            Box3 box;
            for (const Float3 q : fit_mesh.positions)
                box.add(q);
            bool inside = true;
            for (int axis = 0; axis < 3; ++axis)
                inside = inside && (box.max[axis] == box.min[axis] ||
                                    (p[axis] > box.min[axis] + 0.1f && p[axis] < box.max[axis] - 0.1f));
            if (!inside)
                continue;
            const Block4 m = blockFromMoments(fit.moments[v]), truth{{3, 0, 0, 1}};
            for (size_t k = 0; k < 4; ++k)
                sum += (m.v[k] - truth.v[k]) * (m.v[k] - truth.v[k]);
            count += 4;
        }
        const double gain = sum / static_cast<double>(count) / 0.01 * per_vertex;
        EXPECT_GE(gain, e.least) << e.alpha;
        EXPECT_LE(gain, e.most) << e.alpha;
        std::printf("alpha %.2f: noise gain %.3f\n", e.alpha, gain);
    }
}

TEST(FitVertices, hasTheSameBitsForAnyNumberOfThreads)
{
    const mesh::SourceMesh rock = shapes::rock(24, 0.5f);
    std::vector<std::vector<Moments>> results;
    for (const size_t threads : {1u, 2u, 3u})
    {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        const FitMesh fit_mesh = buildFitMesh(rock);
        const std::vector<SurfaceSample> samples = makeSamples(fit_mesh.view(), 2);
        results.push_back(fitVertices(fit_mesh, samples, sampleField(fit_mesh, samples)).moments);
    }
    for (const std::vector<Moments>& other : results)
        EXPECT_EQ(std::memcmp(results[0].data(), other.data(), other.size() * sizeof(Moments)), 0);
}

} // namespace hearth::visibility

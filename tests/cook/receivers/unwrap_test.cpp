// UVs that the cooker makes: nothing overlaps, charts keep apart, texels have their size.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/receivers/unwrap/charts.h"
#include "cook/receivers/unwrap/unwrap.h"
#include "tests/support/shapes.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <utility>

namespace hearth::receivers
{
namespace
{

struct Shape
{
    std::vector<Float3> positions;
    std::vector<uint32_t> indices;

    /// Append a quad whose front is on the side of cross(a, b).
    void addQuad(Float3 corner, Float3 a, Float3 b)
    {
        const auto first = static_cast<uint32_t>(positions.size());
        for (const Float3 p : {corner, corner + a, corner + a + b, corner + b})
            positions.push_back(p);
        for (const uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u})
            indices.push_back(first + i);
    }
};

Shape makeBox(Float3 size)
{
    const Float3 x{size.x, 0, 0}, y{0, size.y, 0}, z{0, 0, size.z};
    Shape box;
    box.addQuad({}, y, x);
    box.addQuad({}, z, y);
    box.addQuad({}, x, z);
    box.addQuad(size, -x, -y);
    box.addQuad(size, -y, -z);
    box.addQuad(size, -z, -x);
    return box;
}

/// Ramp around a column, three turns above each other: each triangle faces up.
Shape makeSpiral()
{
    Shape ramp;
    constexpr int kSteps = 90;
    const auto point = [](int step, float radius)
    {
        const float angle = 6.2831853f * 3 * static_cast<float>(step) / kSteps;
        return Float3{radius * std::cos(angle), 0.02f * static_cast<float>(step), radius * std::sin(angle)};
    };
    for (int step = 0; step < kSteps; ++step)
    {
        const auto first = static_cast<uint32_t>(ramp.positions.size());
        for (const Float3 p : {point(step, 1), point(step, 2), point(step + 1, 2), point(step + 1, 1)})
            ramp.positions.push_back(p);
        for (const uint32_t i : {0u, 2u, 1u, 0u, 3u, 2u})
            ramp.indices.push_back(first + i);
    }
    return ramp;
}

Shape makeRock()
{
    const mesh::SourceMesh rock = shapes::rock(40, 0.15f);
    return {rock.positions, rock.indices};
}

struct Corner2
{
    double u, v;
};

double cross(Corner2 a, Corner2 b, Corner2 c)
{
    return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
}

/// Corners of a triangle in texels.
std::array<Corner2, 3> corners(const Unwrapped& mesh, size_t triangle)
{
    std::array<Corner2, 3> out;
    for (size_t i = 0; i < 3; ++i)
    {
        const Float2 uv = mesh.uvs[mesh.indices[3 * triangle + i]];
        out[i] = {double{uv.x} * mesh.width, double{uv.y} * mesh.height};
    }
    return out;
}

double areaInTexels(const Unwrapped& mesh, size_t triangle)
{
    const std::array<Corner2, 3> c = corners(mesh, triangle);
    return cross(c[0], c[1], c[2]) / 2;
}

double area(const Shape& shape, size_t triangle)
{
    const auto at = [&](size_t i) { return shape.positions[shape.indices[3 * triangle + i]]; };
    return double{length(hearth::cross(at(1) - at(0), at(2) - at(0)))} / 2;
}

/// Return the chart of each triangle: triangles are of one chart if they have a corner at one place.
std::vector<uint32_t> findCharts(const Unwrapped& mesh)
{
    std::map<std::pair<float, float>, uint32_t> charts;
    const auto chart = [&](size_t i) -> uint32_t&
    {
        const Float2 uv = mesh.uvs[mesh.indices[i]];
        return charts.try_emplace({uv.x, uv.y}, static_cast<uint32_t>(charts.size())).first->second;
    };
    for (bool has_changed = true; has_changed;)
    {
        has_changed = false;
        for (size_t i = 0; i < mesh.indices.size(); i += 3)
        {
            const uint32_t least = std::min({chart(i), chart(i + 1), chart(i + 2)});
            for (size_t c = i; c < i + 3; ++c)
                if (std::exchange(chart(c), least) != least)
                    has_changed = true;
        }
    }
    std::vector<uint32_t> of_triangles;
    for (size_t i = 0; i < mesh.indices.size(); i += 3)
        of_triangles.push_back(chart(i));
    return of_triangles;
}

/// Triangles at the points of a fine grid.
struct Coverage
{
    double share_of_overlap = 0;
    std::map<std::pair<int, int>, std::set<uint32_t>> charts_of_texels;
};

Coverage cover(const Unwrapped& mesh)
{
    constexpr int kPoints = 8; // along a texel's side
    const std::vector<uint32_t> charts = findCharts(mesh);
    std::map<std::pair<int, int>, int> counts;
    Coverage coverage;
    for (size_t t = 0; t < mesh.indices.size() / 3; ++t)
    {
        const auto c = corners(mesh, t);
        const double side = cross(c[0], c[1], c[2]) < 0 ? -1 : 1;
        const auto [left, right] = std::minmax({c[0].u, c[1].u, c[2].u});
        const auto [top, bottom] = std::minmax({c[0].v, c[1].v, c[2].v});
        for (int y = static_cast<int>(top * kPoints); y < bottom * kPoints; ++y)
            for (int x = static_cast<int>(left * kPoints); x < right * kPoints; ++x)
            {
                const Corner2 p{(x + 0.37) / kPoints, (y + 0.41) / kPoints};
                if (side * cross(c[0], c[1], p) < 0 || side * cross(c[1], c[2], p) < 0 ||
                    side * cross(c[2], c[0], p) < 0)
                    continue;
                ++counts[{x, y}];
                coverage.charts_of_texels[{x / kPoints, y / kPoints}].insert(charts[t]);
            }
    }
    double doubly = 0;
    for (const auto& [place, count] : counts)
        doubly += count > 1 ? 1 : 0;
    coverage.share_of_overlap = doubly / static_cast<double>(counts.size());
    return coverage;
}

/// Expect what holds for all meshes. Returns the share of overlap.
double expectUsable(const Shape& shape, const Unwrapped& mesh, double texel_size)
{
    EXPECT_EQ(mesh.indices.size(), shape.indices.size());
    EXPECT_EQ(mesh.uvs.size(), mesh.old_from_new.size());
    for (size_t i = 0; i < mesh.indices.size(); ++i)
        EXPECT_EQ(mesh.old_from_new[mesh.indices[i]], shape.indices[i]);
    for (const Float2 uv : mesh.uvs)
        EXPECT_TRUE(uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1) << uv.x << " " << uv.y;
    double in_texels = 0, in_metres = 0;
    for (size_t t = 0; t < mesh.indices.size() / 3; ++t)
    {
        in_texels += std::abs(areaInTexels(mesh, t));
        in_metres += area(shape, t);
    }
    // projection makes areas smaller, and no chart turns by more than 45 degrees in most places
    EXPECT_LE(in_texels * texel_size * texel_size, in_metres * 1.0001);
    EXPECT_GE(in_texels * texel_size * texel_size, in_metres * 0.7);
    const Coverage coverage = cover(mesh);
    size_t touching = 0;
    for (const auto& [place, charts] : coverage.charts_of_texels)
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx)
                if (const auto beside = coverage.charts_of_texels.find({place.first + dx, place.second + dy});
                    beside != coverage.charts_of_texels.end() && beside->second != charts)
                    ++touching;
    EXPECT_EQ(touching, 0u) << "texels with another chart in or beside them";
    return coverage.share_of_overlap;
}

TEST(UnwrapTest, boxHasAChartOfTrueSizeForEachSide)
{
    const Shape box = makeBox({2, 1, 0.5f});
    const auto mesh = unwrap(box.positions, box.indices, 0.05);
    ASSERT_TRUE(mesh);
    EXPECT_EQ(mesh->chart_count, 6u);
    EXPECT_EQ(expectUsable(box, *mesh, 0.05), 0);
    for (size_t t = 0; t < 12; ++t)
        EXPECT_NEAR(areaInTexels(*mesh, t) * 0.05 * 0.05, area(box, t), 1e-4) << t;
    EXPECT_LE(mesh->width * mesh->height, 1.6 * 7.0 / (0.05 * 0.05)) << "more than three eighths are unused";
}

TEST(UnwrapTest, thinRodHasAnAreaOnAllSides)
{
    const Shape rod = makeBox({0.01f, 1, 0.01f});
    const auto mesh = unwrap(rod.positions, rod.indices, 0.125);
    ASSERT_TRUE(mesh);
    for (size_t t = 0; t < 12; ++t)
        EXPECT_GE(areaInTexels(*mesh, t) * 0.125 * 0.125, 0.05 * area(rod, t)) << t;
}

TEST(UnwrapTest, rockHasFewChartsThatKeepApart)
{
    const Shape rock = makeRock();
    for (const double texel_size : {0.1, 0.04})
    {
        const auto mesh = unwrap(rock.positions, rock.indices, texel_size);
        ASSERT_TRUE(mesh);
        EXPECT_LE(mesh->chart_count, 60u);
        EXPECT_LE(expectUsable(rock, *mesh, texel_size), 0.005);
    }
}

TEST(UnwrapTest, spiralIsDividedWhereItWouldLieOnItself)
{
    const Shape ramp = makeSpiral();
    EXPECT_EQ(growCharts(TriangleGraph(ramp.positions, ramp.indices), 0.01).size(), 1u);
    const auto mesh = unwrap(ramp.positions, ramp.indices, 0.1);
    ASSERT_TRUE(mesh);
    EXPECT_GE(mesh->chart_count, 3u);
    EXPECT_LE(expectUsable(ramp, *mesh, 0.1), 0.005);
}

TEST(UnwrapTest, trianglesWithoutAreaGetTheOrigin)
{
    Shape box = makeBox({1, 1, 1});
    box.indices.insert(box.indices.end(), {0, 0, 1, 2, 3, 3});
    const auto mesh = unwrap(box.positions, box.indices, 0.1);
    ASSERT_TRUE(mesh);
    EXPECT_EQ(mesh->chart_count, 6u);
    for (size_t i = 36; i < 42; ++i)
        EXPECT_EQ(mesh->uvs[mesh->indices[i]], (Float2{0, 0}));
    const auto nothing = unwrap({}, {}, 0.1);
    ASSERT_TRUE(nothing);
    EXPECT_EQ(nothing->chart_count, 0u);
}

TEST(UnwrapTest, largeSurfacesGetLargerTexels)
{
    Shape ground;
    ground.addQuad({0, 0, 0}, {0, 0, 20000}, {20000, 0, 0});
    const auto mesh = unwrap(ground.positions, ground.indices, 0.05);
    ASSERT_TRUE(mesh);
    EXPECT_LE(mesh->width, 4096u);
    EXPECT_GE(mesh->width, 3800u);
}

TEST(UnwrapTest, refusesTooManyPieces)
{
    Shape leaves;
    for (int i = 0; i < 60'000; ++i)
    {
        const Float3 at{static_cast<float>(i % 1000), static_cast<float>(i / 1000), 0};
        const auto first = static_cast<uint32_t>(leaves.positions.size());
        for (const Float3 p : {at, at + Float3{0.1f, 0, 0}, at + Float3{0, 0.1f, 0}})
            leaves.positions.push_back(p);
        for (const uint32_t corner : {0u, 1u, 2u})
            leaves.indices.push_back(first + corner);
    }
    EXPECT_FALSE(unwrap(leaves.positions, leaves.indices, 1));
}

} // namespace
} // namespace hearth::receivers

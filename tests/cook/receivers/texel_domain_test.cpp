// Compares the rasteriser with polygons that are clipped to each texel, in double.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/receivers/bake/atlas_layout.h"
#include "tests/cook/receivers/receiver_shapes.h"
#include "tests/support/sanitized.h"

#include <gtest/gtest.h>
#include <map>
#include <random>

namespace hearth::receivers
{
namespace
{

struct Point2
{
    double x, y;
};
using Polygon2 = std::vector<Point2>;

/// Keep the part of a polygon where a x + b y <= c.
Polygon2 clip(const Polygon2& polygon, double a, double b, double c)
{
    Polygon2 out;
    for (size_t i = 0; i < polygon.size(); ++i)
    {
        const Point2 p = polygon[i], q = polygon[(i + 1) % polygon.size()];
        const double dp = a * p.x + b * p.y - c, dq = a * q.x + b * q.y - c;
        if (dp <= 0)
            out.push_back(p);
        if ((dp < 0 && dq > 0) || (dp > 0 && dq < 0))
            out.push_back({p.x + (q.x - p.x) * dp / (dp - dq), p.y + (q.y - p.y) * dp / (dp - dq)});
    }
    return out;
}

double area(const Polygon2& polygon)
{
    double sum = 0;
    for (size_t i = 0; i < polygon.size(); ++i)
    {
        const Point2 p = polygon[i], q = polygon[(i + 1) % polygon.size()];
        sum += p.x * q.y - p.y * q.x;
    }
    return std::abs(sum) / 2;
}

double areaInTexel(const Triangle& triangle, uint32_t width, uint32_t height, uint32_t x, uint32_t y)
{
    Polygon2 polygon;
    for (const Float2 uv : triangle.uvs)
        polygon.push_back({double{uv.x} * width, double{uv.y} * height});
    polygon = clip(polygon, -1, 0, -double{1} * x);
    polygon = clip(polygon, 1, 0, double{1} * x + 1);
    polygon = clip(polygon, 0, -1, -double{1} * y);
    return area(clip(polygon, 0, 1, double{1} * y + 1));
}

using Random = std::mt19937;

uint32_t below(Random& random, uint32_t end)
{
    return static_cast<uint32_t>(random() % end);
}

float unit(Random& random)
{
    return static_cast<float>(random() >> 8) * 0x1p-24f;
}

/// Triangle with random UVs, on the plane z = 0 at ten metres for a unit of UV.
Triangle randomTriangle(Random& random, float size)
{
    Triangle triangle{};
    const Float2 middle{unit(random), unit(random)};
    for (size_t i = 0; i < 3; ++i)
    {
        const float u = middle.x + size * (unit(random) - 0.5f), v = middle.y + size * (unit(random) - 0.5f);
        triangle.uvs[i] = {std::clamp(u, 0.0f, 1.0f), std::clamp(v, 0.0f, 1.0f)};
        triangle.corners[i] = {triangle.uvs[i].x * 10, triangle.uvs[i].y * 10, 0};
        triangle.normals[i] = {0, 0, 1};
    }
    return triangle;
}

Float2 uvAt(std::span<const Triangle> triangles, const SurfacePoint& point)
{
    return interpolate(triangles[point.triangle].uvs, point.weights);
}

} // namespace

TEST(TexelDomain, hasTheTexelsInWhichATriangleHasAnArea)
{
    Random random(1);
    size_t texels = 0;
    const size_t count = test::trials(300);
    for (size_t trial = 0; trial < count; ++trial)
    {
        const uint32_t width = 4 + below(random, 30), height = 4 + below(random, 30);
        std::vector<Triangle> triangles;
        for (uint32_t i = 0; i < 1 + trial % 4; ++i)
            triangles.push_back(randomTriangle(random, trial % 2 == 0 ? 0.8f : 0.1f));
        const TexelDomain domain = rasterise(triangles, 0, width, height, 0);
        std::map<std::pair<uint32_t, uint32_t>, const DomainTexel*> found;
        for (const DomainTexel& texel : domain.texels)
            found[{texel.x, texel.y}] = &texel;
        for (uint32_t y = 0; y < height; ++y)
            for (uint32_t x = 0; x < width; ++x)
            {
                double max_area = 0;
                for (const Triangle& triangle : triangles)
                    max_area = std::max(max_area, areaInTexel(triangle, width, height, x, y));
                if (max_area > 1e-9)
                {
                    ASSERT_TRUE(found.contains({x, y})) << trial << ": " << x << ", " << y;
                }
                if (max_area == 0)
                {
                    ASSERT_FALSE(found.contains({x, y})) << trial << ": " << x << ", " << y;
                }
            }
        texels += domain.texels.size();
    }
    EXPECT_GT(texels, 10 * count);
}

TEST(TexelDomain, hasThePointsOfItsTrianglesThatAreNearestToTheStrata)
{
    Random random(2);
    for (size_t trial = 0; trial < test::trials(60); ++trial)
    {
        const uint32_t side = 4 + below(random, 12);
        const std::vector<Triangle> triangles{randomTriangle(random, 0.7f), randomTriangle(random, 0.7f)};
        for (const DomainTexel& texel : rasterise(triangles, 0, side, side, 0).texels)
            for (size_t i = 0; i < kTexelPoints; ++i)
            {
                const auto distance = [&](Float2 uv)
                {
                    const double dx = double{uv.x} * side - (texel.x + double{texelStrata()[i].x});
                    const double dy = double{uv.y} * side - (texel.y + double{texelStrata()[i].y});
                    return std::sqrt(dx * dx + dy * dy);
                };
                const double found = distance(uvAt(triangles, texel.points[i]));
                for (uint32_t t = 0; t < triangles.size(); ++t)
                    if (areaInTexel(triangles[t], side, side, texel.x, texel.y) > 1e-9)
                        for (int u = 0; u <= 20; ++u)
                            for (int v = 0; u + v <= 20; ++v)
                            {
                                const Float2 weights{static_cast<float>(u) / 20, static_cast<float>(v) / 20};
                                ASSERT_LE(found, distance(uvAt(triangles, {t, weights})) + 1e-4);
                            }
            }
    }
}

TEST(TexelDomain, keepsPointsOffTheEdges)
{
    std::vector<Triangle> floor;
    addQuad(floor, {0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {}, 0, {{0.1f, 0.1f}, {0.87f, 0.93f}});
    for (const DomainTexel& texel : rasterise(floor, 0, 16, 16, 0.01f).texels)
        for (const SurfacePoint& point : texel.points)
        {
            const Float3 at = interpolate(floor[point.triangle].corners, point.weights);
            EXPECT_GE(std::min({at.x, at.y, 4 - at.x, 4 - at.y}), 0.0095f);
        }
}

TEST(TexelDomain, countsOverlaps)
{
    std::vector<Triangle> once;
    addQuad(once, {0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {}, 0);
    EXPECT_EQ(rasterise(once, 0, 64, 64, 0).overlap, 0);
    EXPECT_EQ(checkOverlap(rasterise(once, 0, 64, 64, 0)).use, UvUse::usable);
    addQuad(once, {0, 0, 1}, {4, 0, 0}, {0, 4, 0}, {}, 0, {{0.5f, 0}, {1, 1}});
    const UvCheck check = checkOverlap(rasterise(once, 0, 64, 64, 0));
    EXPECT_EQ(check.use, UvUse::overlapping);
    EXPECT_NEAR(check.share, 0.5, 0.01);
    EXPECT_EQ(describe({UvUse::overlapping, 0.125}), "12.5 % of its UVs overlap");
}

TEST(TexelDomain, refusesUvsThatAddressNoTexels)
{
    std::vector<Triangle> quad;
    addQuad(quad, {0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {}, 0);
    EXPECT_EQ(checkUvs(quad).use, UvUse::usable);
    addQuad(quad, {0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {}, 0, {{0.5f, 0.5f}, {1.5f, 1}});
    EXPECT_EQ(checkUvs(quad).use, UvUse::outside);
    EXPECT_NEAR(checkUvs(quad).share, 0.5, 1e-6);
    std::vector<Triangle> flat;
    addQuad(flat, {0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {}, 0, {{0.5f, 0.5f}, {0.5f, 1}});
    EXPECT_EQ(checkUvs(flat).use, UvUse::flat);
    EXPECT_EQ(checkUvs({}).use, UvUse::flat);
}

TEST(TexelDomain, hasTheDensityThatWasAskedFor)
{
    std::vector<Triangle> quad;
    addQuad(quad, {1, 2, 3}, {4, 0, 0}, {0, 2, 0}, {}, 0);
    EXPECT_EQ(chooseRectangle(quad, 10), (RectangleSize{40, 20}));
    EXPECT_EQ(chooseRectangle(quad, 0.1), (RectangleSize{4, 4}));
    EXPECT_EQ(chooseRectangle(quad, 1500), (RectangleSize{4096, 3000}));
    std::vector<Triangle> half; // half of UV on as many metres: twice the texels
    addQuad(half, {1, 2, 3}, {4, 0, 0}, {0, 2, 0}, {}, 0, {{0, 0}, {0.5f, 1}});
    EXPECT_EQ(chooseRectangle(half, 10), (RectangleSize{80, 20}));
}

TEST(AtlasLayout, keepsRectanglesApart)
{
    Random random(3);
    for (size_t trial = 0; trial < test::trials(20); ++trial)
    {
        std::vector<RectangleSize> sizes;
        uint64_t area = 0;
        for (uint32_t i = 0; i < 1 + trial * 3; ++i)
        {
            sizes.push_back({4 + below(random, 60), 4 + below(random, 60)});
            area += uint64_t{sizes.back().width + 2} * (sizes.back().height + 2);
        }
        const AtlasLayout atlas = layOutAtlas(sizes).value();
        std::vector<bool> taken(size_t{atlas.width} * atlas.height);
        for (size_t i = 0; i < sizes.size(); ++i)
            for (uint32_t y = atlas.places[i].y - 1; y < atlas.places[i].y + sizes[i].height + 1; ++y)
                for (uint32_t x = atlas.places[i].x - 1; x < atlas.places[i].x + sizes[i].width + 1; ++x)
                {
                    ASSERT_LT(x, atlas.width);
                    ASSERT_LT(y, atlas.height);
                    ASSERT_FALSE(taken[size_t{y} * atlas.width + x]);
                    taken[size_t{y} * atlas.width + x] = true;
                }
        if (sizes.size() > 20)
        {
            EXPECT_GT(static_cast<double>(area) / static_cast<double>(taken.size()), 0.8);
        }
    }
}

TEST(AtlasLayout, endsAtItsLimit)
{
    const std::vector<RectangleSize> fitting(9, RectangleSize{4096, 4096});
    EXPECT_TRUE(layOutAtlas(fitting));
    const std::vector<RectangleSize> too_many(17, RectangleSize{4096, 4096});
    EXPECT_FALSE(layOutAtlas(too_many));
    EXPECT_EQ(layOutAtlas({})->width, 0u);
}

} // namespace hearth::receivers

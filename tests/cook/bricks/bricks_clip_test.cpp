// Compares triangles clipped to voxels with integer separating-axis tests, and cross-sections with samples.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/cook/bricks/bricks_scene.h"

#include <gtest/gtest.h>
#include <map>

namespace hearth::bricks
{

namespace
{

using Whole3 = std::array<int64_t, 3>;

// Units of the separating-axis tests: sixteenths of the steps to which corners are rounded. Grids here are 8
// voxels wide, so that products of three lengths fit 64 bits.
constexpr int64_t kFine = 16;
constexpr int64_t kVoxel = static_cast<int64_t>(kStepsPerVoxel) * kFine;
constexpr uint32_t kSize = 8;

Whole3 whole(const Double3& p)
{
    const double scale = static_cast<double>(kVoxel);
    return {static_cast<int64_t>(p.x * scale), static_cast<int64_t>(p.y * scale),
            static_cast<int64_t>(p.z * scale)};
}

Whole3 minus(const Whole3& a, const Whole3& b)
{
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Whole3 computeCross(const Whole3& a, const Whole3& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// True if the triangle intersects the interior of a voxel that is enlarged by `grown` on each side (shrunk
/// if negative).
/// T. Akenine-Moeller, "Fast 3D triangle-box overlap testing", 2001, with strict comparisons.
bool meets(const std::array<Whole3, 3>& triangle, const Cell& cell, int64_t grown)
{
    // double everything, so that the centre is an integer
    std::array<Whole3, 3> p;
    for (size_t i = 0; i < 3; ++i)
        for (size_t axis = 0; axis < 3; ++axis)
            p[i][axis] = 2 * triangle[i][axis] - (2 * static_cast<int64_t>(cell[axis]) + 1) * kVoxel;
    const int64_t half = kVoxel + 2 * grown;
    const auto apart = [&](const Whole3& along)
    {
        // 64-bit mantissa: products of three lengths of 2^26 need more, but ties need not be distinguished
        using Wide = long double;
        Wide low = 0, high = 0;
        for (size_t i = 0; i < 3; ++i)
        {
            Wide at = 0;
            for (size_t axis = 0; axis < 3; ++axis)
                at += static_cast<Wide>(along[axis]) * static_cast<Wide>(p[i][axis]);
            low = i == 0 ? at : std::min(low, at);
            high = i == 0 ? at : std::max(high, at);
        }
        Wide reach = 0;
        for (size_t axis = 0; axis < 3; ++axis)
            reach += static_cast<Wide>(std::abs(along[axis])) * static_cast<Wide>(half);
        return reach > 0 && (low >= reach || high <= -reach);
    };
    const std::array<Whole3, 3> edges{minus(p[1], p[0]), minus(p[2], p[1]), minus(p[0], p[2])};
    if (apart(computeCross(edges[0], edges[1])))
        return false;
    for (size_t axis = 0; axis < 3; ++axis)
    {
        Whole3 unit{};
        unit[axis] = 1;
        if (apart(unit))
            return false;
        for (const Whole3& edge : edges)
            if (apart(computeCross(unit, edge)))
                return false;
    }
    return true;
}

/// True if the triangle lies in a plane between voxels.
bool isFlat(const Polygon& triangle)
{
    for (int axis = 0; axis < 3; ++axis)
    {
        const std::array<double, 2> ends = triangle.span(axis);
        if (ends[0] == ends[1] && ends[0] == std::floor(ends[0]))
            return true;
    }
    return false;
}

struct Pieces
{
    std::map<Cell, Double3> areas; ///< doubled
};

Pieces clipToPieces(const Polygon& triangle, uint32_t size = kSize)
{
    Pieces pieces;
    const Cell grid{size, size, size};
    forEachPiece(triangle, doubleArea(triangle), grid, {{0, 0, 0}, grid},
                 [&](const Cell& cell, const Polygon& piece)
                 {
                     for (int axis = 0; axis < 3; ++axis)
                     {
                         const std::array<double, 2> ends = piece.span(axis);
                         EXPECT_GE(ends[0], cell[static_cast<size_t>(axis)]);
                         EXPECT_LE(ends[1], cell[static_cast<size_t>(axis)] + 1);
                     }
                     EXPECT_TRUE(pieces.areas.emplace(cell, doubleArea(piece)).second);
                 });
    return pieces;
}

} // namespace

TEST(ForEachPiece, givesTheVoxelsThatSeparatingAxesGive)
{
    Random random(1);
    uint64_t met = 0, in_planes = 0;
    for (int i = 0; i < 400; ++i)
    {
        // large, small, thin and flat triangles; every third on planes, edges and corners of voxels
        const double size = i % 4 == 0 ? 8 : i % 4 == 1 ? 1.5 : i % 4 == 2 ? 0.2 : 4;
        const Double3 middle = uniformPoint(random, 0, 8);
        Corners corners;
        for (Double3& corner : corners.at)
        {
            corner = middle + uniformPoint(random, -size, size);
            corner = {std::clamp(corner.x, 0.0, 8.0), std::clamp(corner.y, 0.0, 8.0),
                      std::clamp(corner.z, 0.0, 8.0)};
            if (i % 3 == 0)
                corner = {std::floor(corner.x * 2) / 2, std::floor(corner.y), std::floor(corner.z * 4) / 4};
        }
        if (i % 7 == 0)
            corners.at[2] = corners.at[0] + (corners.at[1] - corners.at[0]) * 0.4 + Double3{0, 0.001, 0};
        const Polygon triangle = makePolygon(corners);
        const Double3 area = doubleArea(triangle);
        if (length(area) == 0)
            continue;
        std::array<Whole3, 3> exact;
        for (size_t p = 0; p < 3; ++p)
            exact[p] = whole(triangle.points[p]);
        const Pieces pieces = clipToPieces(triangle);
        for (uint32_t z = 0; z < kSize; ++z)
            for (uint32_t y = 0; y < kSize; ++y)
                for (uint32_t x = 0; x < kSize; ++x)
                {
                    const Cell cell{x, y, z};
                    const bool has = pieces.areas.contains(cell);
                    met += has ? 1u : 0u;
                    if (meets(exact, cell, -1))
                        EXPECT_TRUE(has) << "triangle " << i << " at " << x << " " << y << " " << z;
                    else if (has)
                    {
                        // the triangle lies between voxels, or touches a corner to the last bits of the
                        // rounding
                        in_planes += isFlat(triangle) ? 1u : 0u;
                        EXPECT_TRUE(meets(exact, cell, 1))
                            << "triangle " << i << " at " << x << " " << y << " " << z;
                    }
                }
    }
    EXPECT_GT(met, 4000u);
    EXPECT_GT(in_planes, 100u);
}

TEST(ForEachPiece, keepsTheAreaAndItsDirection)
{
    Random random(2);
    for (int i = 0; i < 300; ++i)
    {
        Corners corners;
        for (Double3& corner : corners.at)
            corner = uniformPoint(random, 0, 8);
        const Polygon triangle = makePolygon(corners);
        Double3 sum;
        for (const auto& [cell, area] : clipToPieces(triangle).areas)
            sum = sum + area;
        EXPECT_LT(length(sum - doubleArea(triangle)), 1e-10);
    }
}

TEST(ForEachPiece, isTheSameHoweverTheGridIsDivided)
{
    Random random(3);
    for (int i = 0; i < 100; ++i)
    {
        Corners corners;
        for (Double3& corner : corners.at)
            corner = uniformPoint(random, 0, 8);
        const Polygon triangle = makePolygon(corners);
        const Pieces whole_grid = clipToPieces(triangle);
        size_t found = 0;
        for (uint32_t begin = 0; begin < kSize; begin += 2)
            forEachPiece(triangle, doubleArea(triangle), {kSize, kSize, kSize},
                         {{begin, 0, 0}, {begin + 2, kSize, kSize}},
                         [&](const Cell& cell, const Polygon& piece)
                         {
                             ++found;
                             const Double3 other = doubleArea(piece) - whole_grid.areas.at(cell);
                             EXPECT_TRUE(other.x == 0 && other.y == 0 && other.z == 0);
                         });
        EXPECT_EQ(found, whole_grid.areas.size());
    }
}

TEST(ForEachPiece, givesWhatLiesBetweenVoxelsToTheOneBehind)
{
    for (int axis = 0; axis < 3; ++axis)
        for (const double place : {0.0, 3.0, 8.0, 0.01, 2.99, 3.01, 7.99})
            for (const bool up : {false, true})
            {
                // triangles that nearly lie in the plane
                const double plane = std::round(place);
                const auto at = [&](double u, double v)
                {
                    const std::array<double, 3> values{place, u, v};
                    const auto value = [&](int which)
                    { return values[static_cast<size_t>((which - axis + 3) % 3)]; };
                    return Double3{value(0), value(1), value(2)};
                };
                Corners corners{{at(2, 2), at(3, 2), at(2, 3)}};
                if (!up)
                    std::swap(corners.at[1], corners.at[2]);
                const Polygon triangle = makePolygon(corners);
                ASSERT_EQ(coordinate(doubleArea(triangle), axis) > 0, up);
                const Pieces pieces = clipToPieces(triangle);
                ASSERT_EQ(pieces.areas.size(), 1u);
                const uint32_t behind = plane == 0 ? 0u : plane == 8 ? 7u : up ? 2u : 3u;
                EXPECT_EQ(pieces.areas.begin()->first[static_cast<size_t>(axis)], behind);
            }
}

TEST(HiddenSamples, giveEachSampleOfASheetToOnePieceAlone)
{
    Random random(4);
    for (int round = 0; round < 30; ++round)
    {
        // triangle fan over [0, 8]^2 about a random point, every third time on points of the grid
        const auto place = [&](double low, double high)
        {
            const double value = uniform(random, low, high);
            return round % 3 == 0 ? std::floor(value * 16) / 16 : value;
        };
        const Double3 slope{uniform(random, -0.4, 0.4), 0, uniform(random, -0.4, 0.4)};
        const auto lifted = [&](double x, double z) {
            return Double3{x, 4 + slope.x * (x - 4) + slope.z * (z - 4), z};
        };
        const Double3 middle = lifted(place(1, 7), place(1, 7));
        std::vector<Double3> rim;
        for (const auto& [x, z] : {std::pair{0.0, 0.0},
                                   {place(0, 8), 0.0},
                                   {8.0, 0.0},
                                   {8.0, place(0, 8)},
                                   {8.0, 8.0},
                                   {place(0, 8), 8.0},
                                   {0.0, 8.0},
                                   {0.0, place(0, 8)}})
            rim.push_back(lifted(x, z));
        std::map<std::array<uint32_t, 2>, uint64_t> hidden;
        std::map<std::array<uint32_t, 2>, int> count;
        for (size_t i = 0; i < rim.size(); ++i)
        {
            const Polygon triangle = makePolygon({{middle, rim[(i + 1) % rim.size()], rim[i]}});
            forEachPiece(triangle, doubleArea(triangle), {8, 8, 8}, {{0, 0, 0}, {8, 8, 8}},
                         [&](const Cell& cell, const Polygon& piece)
                         {
                             const uint64_t samples = coveredSamples(piece, cell, 1);
                             hidden[{cell[0], cell[2]}] |= samples;
                             count[{cell[0], cell[2]}] += std::popcount(samples);
                         });
        }
        EXPECT_EQ(hidden.size(), 64u);
        for (const auto& [column, samples] : hidden)
        {
            EXPECT_EQ(samples, ~uint64_t{0});
            EXPECT_EQ(count[column], 64);
        }
    }
}

TEST(HiddenSamples, countWhatIsHidden)
{
    // a triangle of half a voxel's side, and a square of a quarter of its cross-section
    Polygon piece;
    for (const Double3& p : {Double3{2, 3.5, 5}, Double3{3, 3.5, 5}, Double3{2, 3.5, 6}})
        piece.add(p);
    EXPECT_NEAR(std::popcount(coveredSamples(piece, {2, 3, 5}, 1)), 32, 4);
    EXPECT_EQ(coveredSamples(piece, {2, 3, 5}, 0), 0u);
    EXPECT_EQ(coveredSamples(piece, {2, 3, 5}, 2), 0u);
    Polygon square;
    for (const Double3& p :
         {Double3{2, 3, 5.5}, Double3{2.5, 3, 5.5}, Double3{2.5, 3.5, 5.5}, Double3{2, 3.5, 5.5}})
        square.add(p);
    EXPECT_EQ(coveredSamples(square, {2, 3, 5}, 2), 0x0F0F0F0Fu);
}

} // namespace hearth::bricks

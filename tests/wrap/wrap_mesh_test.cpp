// Tests wraps of models that have no inside: what they promise is checked by plain means.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/wrap/check.h"
#include "cook/wrap/decimate.h"
#include "cook/wrap/wrap_mesh.h"
#include "tests/support/shapes.h"
#include "tests/support/surfaces/surface_distance.h"
#include "tests/wrap/wrap_oracle.h"

#include <gtest/gtest.h>

#include <numbers>

namespace
{

using namespace hearth;
using mesh::SourceMesh;
using test::CheckedSurface;

/// Append a quad of two triangles, seen from the side where its corners run counter-clockwise.
void addQuad(SourceMesh& mesh, const std::array<Float3, 4>& corners, uint32_t material = 0)
{
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), corners.begin(), corners.end());
    for (const uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u})
        mesh.indices.push_back(first + corner);
    mesh.triangle_materials.insert(mesh.triangle_materials.end(), 2, material);
}

constexpr int kAllSides = 6;

/// Append the first `sides` sides of a box, each a quad of its own: a box of fewer than six is open.
void addBox(SourceMesh& mesh, Float3 low, Float3 high, int sides = kAllSides)
{
    const auto corner = [&](int i) {
        return Float3{i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z};
    };
    constexpr int kSides[kAllSides][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                          {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (int side = 0; side < sides; ++side)
    {
        const auto& s = kSides[side];
        addQuad(mesh, {corner(s[0]), corner(s[1]), corner(s[2]), corner(s[3])});
    }
}

SourceMesh makeQuad()
{
    SourceMesh mesh;
    mesh.name = "leaf";
    addQuad(mesh, {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}});
    return mesh;
}

/// Boxes that are pushed into each other, some without a bottom, as artists kit-bash.
SourceMesh makeKitBash()
{
    SourceMesh mesh;
    mesh.name = "kit";
    addBox(mesh, {0, 0, 0}, {1, 1, 1});
    addBox(mesh, {0.5f, 0.25f, 0.25f}, {1.75f, 0.75f, 0.75f}, 5);
    addBox(mesh, {-0.5f, 0.125f, 0.5f}, {0.5f, 0.375f, 1.5f}, 4);
    addBox(mesh, {0.25f, 0.25f, 0.75f}, {0.5f, 0.5f, 2});
    return mesh;
}

/// A house of one-sided walls, 1 m each way, whose sixth side is a wall with a square door.
SourceMesh makeHouse(float door)
{
    SourceMesh mesh;
    mesh.name = "house";
    addBox(mesh, {0, 0, 0}, {1, 1, 1}, 5);
    const float a = 0.5f - door / 2, b = 0.5f + door / 2;
    addQuad(mesh, {{{0, 0, 1}, {1, 0, 1}, {1, a, 1}, {0, a, 1}}});
    addQuad(mesh, {{{0, b, 1}, {1, b, 1}, {1, 1, 1}, {0, 1, 1}}});
    addQuad(mesh, {{{0, a, 1}, {a, a, 1}, {a, b, 1}, {0, b, 1}}});
    addQuad(mesh, {{{b, a, 1}, {1, a, 1}, {1, b, 1}, {b, b, 1}}});
    return mesh;
}

double findDiagonal(const SourceMesh& mesh)
{
    Float3 low = mesh.positions.front(), high = low;
    for (const Float3 p : mesh.positions)
        for (int axis = 0; axis < 3; ++axis)
        {
            low[axis] = std::min(low[axis], p[axis]);
            high[axis] = std::max(high[axis], p[axis]);
        }
    return length(widen(high) - widen(low));
}

/// Check all that a wrap promises.
/// max_distance  how far the wrap may be from the source, a fraction of the diagonal
void checkWrap(const SourceMesh& mesh, const SourceMesh& source, double max_distance)
{
    EXPECT_EQ(mesh.name, source.name);
    EXPECT_EQ(mesh.triangle_materials.size(), mesh.triangleCount());
    const CheckedSurface surface{mesh.positions, mesh.indices};
    EXPECT_TRUE(test::isWatertight(surface));
    EXPECT_TRUE(test::findCrossings(surface).empty());
    EXPECT_GT(test::enclosedVolume(surface), 0) << "it looks inwards";
    for (const uint32_t vertex : source.indices)
        EXPECT_NEAR(test::windingNumber(surface, widen(source.positions[vertex])), 1, 1e-6);
    const SurfaceDistance distance(source.positions, source.indices);
    EXPECT_LE(largestDistance(mesh.positions, mesh.indices, 20000, distance),
              max_distance * findDiagonal(source) * (1 + 1e-6));
}

/// Wrap and check, with all triangles of the wrap, and decimated.
/// slack    how far the wrap may be from the source, of alpha and offset: above 1 where CGAL fills wedges
///          between parts that touch in a point
/// returns  the wrap with all triangles
SourceMesh expectSound(const SourceMesh& source, wrap::WrapOptions options, double slack = 1)
{
    const auto wrapWith = [&](double error)
    {
        options.error = error;
        const Result<SourceMesh> result = wrap::wrapMesh(source, options, "test.part", 0);
        EXPECT_TRUE(result.ok()) << formatMessage(result.error());
        return result.ok() ? result.value() : SourceMesh{};
    };
    const SourceMesh whole = wrapWith(0);
    const double max_distance = slack * (options.alpha + options.offset);
    checkWrap(whole, source, max_distance);
    constexpr double kError = 0.004;
    const SourceMesh decimated = wrapWith(kError);
    // half of the error more between it and the source, and as much and the error from the wrap
    checkWrap(decimated, source, max_distance + 2 * kError);
    EXPECT_LT(decimated.triangleCount(), whole.triangleCount());
    return whole;
}

struct Cube
{
    Float3 low;
    float size;
};

/// Weld cubes, the first with its six sides or fewer.
wrap::Surface weldCubes(const std::vector<Cube>& cubes, int sides = kAllSides)
{
    SourceMesh mesh;
    for (const auto& [low, size] : cubes)
        addBox(mesh, low, low + Float3{size, size, size}, mesh.positions.empty() ? sides : kAllSides);
    return wrap::makeSurface(mesh);
}

TEST(FindFault, NamesWhatIsBroken)
{
    const wrap::Surface source = weldCubes({{{1, 1, 1}, 1}});
    const wrap::SourceTree tree(source, 10);
    const auto find = [&](const wrap::Surface& wrap) { return wrap::findFault(wrap, tree).text; };
    const Cube around{{0, 0, 0}, 3};
    EXPECT_EQ(find(weldCubes({around})), "");
    EXPECT_EQ(find(weldCubes({around, {{4, 4, 4}, 1}})), "");
    EXPECT_EQ(find({}), "it is no surface");
    EXPECT_EQ(find(weldCubes({around}, 5)), "it is not watertight");
    EXPECT_EQ(find(weldCubes({around, {{3, 3, 0}, 3}})), "it is not watertight") << "a common edge";
    EXPECT_EQ(find(weldCubes({around, {{3, 3, 3}, 1}})), "it is not watertight") << "a common vertex";
    EXPECT_EQ(find(weldCubes({around, {{-1, -1, -1}, 1.5f}})), "it intersects itself");
    EXPECT_EQ(find(weldCubes({{{0, 0, 0}, 1.5f}})), "it touches the source");
    EXPECT_EQ(find(weldCubes({{{-1, -1, -1}, 3}})), "it touches the source") << "common planes";
    EXPECT_EQ(find(weldCubes({{{5, 5, 5}, 1}})), "it leaves vertices of the source outside");
    wrap::Surface collapsed = weldCubes({around});
    collapsed.positions[collapsed.indices[0]] = collapsed.positions[collapsed.indices[1]];
    EXPECT_EQ(find(collapsed), "its triangles collapse");
}

TEST(FindFault, NamesTheTriangles)
{
    const wrap::Surface source = weldCubes({{{1, 1, 1}, 1}});
    const wrap::SourceTree tree(source, 10);
    wrap::Surface touching = weldCubes({{{0, 0, 0}, 3}, {{4, 4, 4}, 1}});
    for (size_t corner = 0; corner < 3; ++corner)
        touching.positions[touching.indices[corner]].x = 1.5f; // the first side, and those beside it
    const std::vector<uint32_t> triangles = wrap::findFault(touching, tree).triangles;
    EXPECT_TRUE(std::ranges::binary_search(triangles, 0u));
    for (const uint32_t triangle : triangles)
        EXPECT_LT(triangle, 12u) << "it is of the other cube";
}

TEST(WrapMesh, OneSidedQuad)
{
    const SourceMesh wrap = expectSound(makeQuad(), {});
    const CheckedSurface surface{wrap.positions, wrap.indices};
    // a slab around it: a layer of the offset on either side
    const double offset = std::numbers::sqrt2 / 600;
    EXPECT_NEAR(test::enclosedVolume(surface), 2 * offset, 0.5 * offset);
}

TEST(WrapMesh, KitBashedBoxes)
{
    expectSound(makeKitBash(), {.alpha = 1 / 20.});
}

TEST(WrapMesh, Tangle)
{
    SourceMesh tangle = shapes::tangle(12, 40);
    tangle.name = "tangle";
    expectSound(tangle, {.alpha = 1 / 10., .offset = 1 / 100.});
}

TEST(WrapMesh, LooseQuads)
{
    expectSound(shapes::foliage(40), {.alpha = 1 / 20., .offset = 1 / 200.}, 1.5);
}

TEST(WrapMesh, Rock)
{
    expectSound(shapes::rock(8, 0.3f), {.alpha = 1 / 20.});
}

TEST(WrapMesh, DoorsSmallerThanAlphaAreClosed)
{
    const Double3 inside{0.5, 0.5, 0.5};
    // a ball of radius alpha gets through a square door if half of its side is larger
    const double alpha_m = 0.05 * findDiagonal(makeHouse(0.1f));
    const SourceMesh closed = expectSound(makeHouse(static_cast<float>(alpha_m)), {.alpha = 0.05});
    EXPECT_NEAR(test::windingNumber({closed.positions, closed.indices}, inside), 1, 1e-6);
    const SourceMesh open = expectSound(makeHouse(static_cast<float>(4 * alpha_m)), {.alpha = 0.05});
    EXPECT_NEAR(test::windingNumber({open.positions, open.indices}, inside), 0, 1e-6);
}

TEST(WrapMesh, HouseWithoutAWallIsHollow)
{
    SourceMesh house;
    addBox(house, {0, 0, 0}, {1, 1, 1}, 5);
    const SourceMesh wrap = expectSound(house, {.alpha = 0.05});
    EXPECT_NEAR(test::windingNumber({wrap.positions, wrap.indices}, {0.5, 0.5, 0.5}), 0, 1e-6);
}

TEST(DecimateWrap, StaysNearTheWrap)
{
    const SourceMesh rock = shapes::rock(8, 0.3f);
    const Result<SourceMesh> whole =
        wrap::wrapMesh(rock, {.alpha = 1 / 20., .offset = 1 / 50., .error = 0}, "test.part", 0);
    ASSERT_TRUE(whole.ok());
    const wrap::Surface source = wrap::makeSurface(rock), surface = wrap::makeSurface(whole.value());
    const wrap::SourceTree tree(source, 10);
    const SurfaceDistance distance(surface.positions, surface.indices);
    size_t triangles = surface.triangleCount();
    for (const double error_m : {0.02, 0.04, 0.08})
    {
        const auto decimated =
            wrap::decimateWrap(surface, tree, {.error_m = error_m, .step_m = 0.001, .max_seconds = 60});
        ASSERT_TRUE(decimated);
        EXPECT_LT(decimated->triangleCount(), triangles);
        triangles = decimated->triangleCount();
        // it is measured at corners and middles: between them it may be a little farther away
        EXPECT_LE(largestDistance(decimated->positions, decimated->indices, 20000, distance), 1.25 * error_m);
    }
    EXPECT_FALSE(wrap::decimateWrap(surface, tree, {.error_m = 0.02, .step_m = 0.001, .max_seconds = 0}));
}

TEST(WrapMesh, DecimatedToTheCornersOfABox)
{
    SourceMesh box;
    addBox(box, {0, 0, 0}, {3, 2, 1});
    const Result<SourceMesh> wrap = wrap::wrapMesh(box, {.error = 0.004}, "test.part", 0);
    ASSERT_TRUE(wrap.ok());
    EXPECT_LE(wrap.value().triangleCount(), 24u);
    checkWrap(wrap.value(), box, 0.01);
}

TEST(WrapMesh, DecimatedToACount)
{
    const SourceMesh rock = shapes::rock(8, 0.3f);
    const Result<SourceMesh> wrap =
        wrap::wrapMesh(rock, {.alpha = 1 / 20., .error = 0, .triangles = 100}, "test.part", 0);
    ASSERT_TRUE(wrap.ok());
    EXPECT_LE(wrap.value().triangleCount(), 100u);
    EXPECT_GE(wrap.value().triangleCount(), 80u);
    checkWrap(wrap.value(), rock, 1 / 20. + 16 * 1 / 600.);
}

TEST(WrapMesh, HasMoreTrianglesThanAskedForWhereItMust)
{
    const SourceMesh leaves = shapes::foliage(40);
    const Result<SourceMesh> wrap = wrap::wrapMesh(
        leaves, {.alpha = 1 / 20., .offset = 1 / 200., .error = 0, .triangles = 1}, "test.part", 0);
    ASSERT_TRUE(wrap.ok());
    EXPECT_GE(wrap.value().triangleCount(), 4u);
    checkWrap(wrap.value(), leaves, 1);
}

TEST(WrapMesh, MaterialsAreThoseOfTheNearestTriangles)
{
    SourceMesh mesh;
    addQuad(mesh, {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}, 7);
    addQuad(mesh, {{{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}}}, 3);
    const SourceMesh wrap = expectSound(mesh, {});
    for (size_t i = 0; i < wrap.triangleCount(); ++i)
    {
        float middle = 0;
        for (size_t k = 0; k < 3; ++k)
            middle += wrap.positions[wrap.indices[3 * i + k]].x / 3;
        if (std::abs(middle - 1) > 1e-5f)
            EXPECT_EQ(wrap.triangle_materials[i], middle < 1 ? 7u : 3u) << middle;
    }
}

TEST(WrapMesh, TrianglesWithoutAreaDoNotCount)
{
    SourceMesh mesh = makeQuad();
    const auto far = static_cast<uint32_t>(mesh.positions.size());
    mesh.positions.push_back({9, 9, 9});
    mesh.indices.insert(mesh.indices.begin(), {0, far, far});
    mesh.triangle_materials.insert(mesh.triangle_materials.begin(), 5);
    const Result<SourceMesh> with = wrap::wrapMesh(mesh, {}, "test.part", 0);
    const Result<SourceMesh> without = wrap::wrapMesh(makeQuad(), {}, "test.part", 0);
    ASSERT_TRUE(with.ok() && without.ok());
    EXPECT_EQ(with.value().positions, without.value().positions);
    EXPECT_EQ(with.value().indices, without.value().indices);
    EXPECT_EQ(with.value().triangle_materials, without.value().triangle_materials);
}

TEST(WrapMesh, CopiesOfTrianglesDoNotCount)
{
    SourceMesh mesh = makeQuad();
    constexpr uint32_t kCorners[][3] = {{0, 1, 2}, {1, 2, 0}, {2, 1, 0}};
    for (uint32_t copy = 0; copy < 30'000; ++copy)
    {
        mesh.indices.insert(mesh.indices.end(), std::begin(kCorners[copy % 3]), std::end(kCorners[copy % 3]));
        mesh.triangle_materials.push_back(copy);
    }
    const Result<SourceMesh> with = wrap::wrapMesh(mesh, {}, "test.part", 0);
    const Result<SourceMesh> without = wrap::wrapMesh(makeQuad(), {}, "test.part", 0);
    ASSERT_TRUE(with.ok() && without.ok());
    EXPECT_EQ(with.value().positions, without.value().positions);
    EXPECT_EQ(with.value().indices, without.value().indices);
    EXPECT_EQ(with.value().triangle_materials, without.value().triangle_materials);
}

TEST(WrapMesh, NothingWithAnAreaIsEmpty)
{
    SourceMesh mesh;
    mesh.name = "line";
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    mesh.indices = {0, 1, 2, 0, 0, 1};
    mesh.triangle_materials = {0, 0};
    const Result<SourceMesh> wrap = wrap::wrapMesh(mesh, {}, "test.part", 0);
    ASSERT_TRUE(wrap.ok());
    EXPECT_EQ(wrap.value().triangleCount(), 0u);
    EXPECT_EQ(wrap.value().vertexCount(), 0u);
    EXPECT_EQ(wrap.value().name, "line");
}

TEST(WrapMesh, FloatsTooCoarseForTheOffsetAreAnError)
{
    SourceMesh mesh = makeQuad();
    for (Float3& position : mesh.positions)
        position = position + Float3{1e6f, 1e6f, 1e6f};
    const Result<SourceMesh> wrap = wrap::wrapMesh(mesh, {}, "far.part", 3);
    ASSERT_FALSE(wrap.ok());
    EXPECT_EQ(wrap.error().issue, Issue::wrap_failed);
    EXPECT_EQ(wrap.error().file, "far.part");
    EXPECT_EQ(wrap.error().where, "mesh 3 \"leaf\"");
    EXPECT_NE(wrap.error().detail.find("once its positions are floats"), std::string::npos)
        << wrap.error().detail;
}

TEST(WrapMesh, LargerOffsetHoldsWhereFloatsAreCoarse)
{
    SourceMesh mesh = makeQuad();
    for (Float3& position : mesh.positions)
        position = position + Float3{1e6f, 1e6f, 1e6f};
    EXPECT_TRUE(wrap::wrapMesh(mesh, {.alpha = 1, .offset = 1}, "far.part", 3).ok());
}

TEST(WrapMesh, TimeIsLimited)
{
    const Result<SourceMesh> wrap =
        wrap::wrapMesh(shapes::rock(16, 0.3f), {.max_seconds = 1e-9}, "test.part", 1);
    ASSERT_FALSE(wrap.ok());
    EXPECT_EQ(wrap.error().issue, Issue::wrap_failed);
    EXPECT_NE(wrap.error().detail.find("processor time"), std::string::npos) << wrap.error().detail;
}

} // namespace

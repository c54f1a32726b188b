// Tests the appearance of voxels of simple solids, and the set of their exposed faces, against exact answers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/grid/grid_settings.h"
#include "cook/bricks/voxels/blend_sides.h"
#include "formats/codecs/vertex_codec.h"
#include "formats/gpu_shared/brick_codes.h"
#include "tests/cook/bricks/bricks_scene.h"

#include <gtest/gtest.h>
#include <numbers>

namespace hearth::bricks
{

namespace
{

constexpr uint32_t kUp = 3, kDown = 2;

SurfaceMaterial colored(Float3 color, bool double_sided = false)
{
    SurfaceMaterial material = defaultMaterial();
    material.record.base_color = {color.x, color.y, color.z, 1};
    material.record.metallic = 0;
    material.dielectric = shared::specularDielectric({}, 0); // reflects its colour alone
    material.record.flags = double_sided ? uint32_t{formats::kMaterialDoubleSided} : 0u;
    return material;
}

/// Rectangle at a height, from (x, z) to (x, z), facing up.
std::vector<Corners> rectangle(double height, Double3 low, Double3 high)
{
    const Double3 a{low.x, height, low.z}, b{low.x, height, high.z}, c{high.x, height, high.z},
        d{high.x, height, low.z};
    return {{{a, b, c}}, {{a, c, d}}};
}

/// Return the only voxel of triangles that lie in one voxel, each with its own material.
SolidVoxel makeVoxelFrom(const std::vector<std::pair<std::vector<Corners>, SurfaceMaterial>>& surfaces)
{
    const GridFrame frame = frameOfSize(4, 4, 4);
    Tile tile(frame, {0, 0, 0});
    for (const auto& [triangles, material] : surfaces)
        for (const Corners& triangle : triangles)
            tile.add(makePolygon(triangle), {}, material, 1);
    const TileVoxels voxels = tile.finish();
    EXPECT_EQ(voxels.voxels.size(), 1u);
    return voxels.voxels[0];
}

void expectNear(Float3 a, Float3 b, float tolerance)
{
    EXPECT_LE(length(a - b), tolerance)
        << a.x << " " << a.y << " " << a.z << ", not " << b.x << " " << b.y << " " << b.z;
}

Float3 decodeNormal(const SolidVoxel& voxel, uint32_t face)
{
    return formats::NormalCode<8>::decode(voxel.normal[face]);
}

std::array<size_t, kFaces> countFaces(const GridWithFaces& grid)
{
    std::array<size_t, kFaces> count{};
    for (const uint8_t faces : grid.faces)
        for (uint32_t face = 0; face < kFaces; ++face)
            count[face] += (faces >> face & 1) != 0;
    return count;
}

// half a step of unorm10, for three colours
constexpr float kAlbedoStep = 1.0f / 1023;

} // namespace

TEST(Faces, ofABoxOnThePlanesOfTheGridAreItsSides)
{
    std::vector<Corners> box;
    addBox(box, {6, 6.5, 7}, {2, 0, 0}, {0, 2.5, 0}, {0, 0, 3}, false);
    const GridWithFaces grid = addFaces(makeSolidGrid(box, frameOfSize(12, 12, 12)));
    EXPECT_EQ(grid.solid.voxels.size(), 4u * 5 * 6 - 2 * 3 * 4); // minus the interior voxels
    EXPECT_EQ(countFaces(grid), (std::array<size_t, kFaces>{30, 30, 24, 24, 20, 20}));
    EXPECT_EQ(grid.seen.sealed, 1u);
    EXPECT_EQ(grid.seen.sealed_sides, 2u * (3 * 4 + 2 * 4 + 2 * 3));
    for (const SolidVoxel& voxel : grid.solid.voxels)
    {
        EXPECT_EQ(voxel.opacity, kOpaque);
        for (uint32_t face = 0; face < kFaces; ++face)
            if ((voxel.front_visible >> face & 1) != 0)
            {
                Float3 expected;
                expected[faceAxis(face)] = isPositiveFace(face) ? 1.0f : -1.0f;
                expectNear(decodeNormal(voxel, face), expected, 0);
                EXPECT_EQ(voxel.albedo[face], shared::encodeAlbedo({1, 1, 1}));
            }
    }
}

TEST(Faces, ofARoomAreWallsOfOneVoxelAroundIt)
{
    std::vector<Corners> room;
    addBox(room, {6, 6.5, 7}, {2, 0, 0}, {0, 2.5, 0}, {0, 0, 3}, true);
    const GridWithFaces grid = addFaces(makeSolidGrid(room, frameOfSize(12, 12, 12)));
    const size_t walls = 2 * (4 * 5 + 5 * 6 + 4 * 6);
    EXPECT_EQ(grid.solid.voxels.size(), walls);
    EXPECT_EQ(grid.seen.sealed, 0u);
    // as many interior faces as voxels; outside, also at their borders
    size_t inside = 0;
    for (size_t v = 0; v < grid.solid.voxels.size(); ++v)
        for (uint32_t face = 0; face < kFaces; ++face)
            if ((grid.faces[v] >> face & 1) != 0 && (grid.solid.voxels[v].front_visible >> face & 1) != 0)
                ++inside;
    EXPECT_EQ(inside, walls);
    EXPECT_EQ(countFaces(grid)[kUp], 24u + 24 + 2 * (4 + 6));
}

TEST(VoxelLook, isWeighedByTheAreaThatASideSees)
{
    const Float3 red{0.8f, 0.1f, 0.05f}, blue{0.1f, 0.2f, 0.9f};
    // a quarter red, the rest blue
    const SolidVoxel level = makeVoxelFrom({{rectangle(1.5, {1, 0, 1}, {1.25, 0, 2}), colored(red)},
                                            {rectangle(1.5, {1.25, 0, 1}, {2, 0, 2}), colored(blue)}});
    expectNear(shared::decodeAlbedo(level.albedo[kUp]), red * 0.25f + blue * 0.75f, kAlbedoStep);
    expectNear(decodeNormal(level, kUp), {0, 1, 0}, 0);
    EXPECT_EQ(level.front_visible, 1u << kUp);
    EXPECT_EQ(shared::decodeFaceDepth(level.albedo[kUp]), 0.5f);

    // a step: upward surface is red, surface facing x is blue, and each face of the voxel takes its own
    const Double3 a{1.5, 1.5, 1}, b{1.5, 1.9, 1}, c{1.5, 1.9, 2}, d{1.5, 1.5, 2};
    const std::vector<Corners> riser{Corners{{a, b, c}}, Corners{{a, c, d}}};
    const SolidVoxel step =
        makeVoxelFrom({{rectangle(1.5, {1, 0, 1}, {2, 0, 2}), colored(red)}, {riser, colored(blue)}});
    expectNear(shared::decodeAlbedo(step.albedo[kUp]), red, kAlbedoStep);
    expectNear(shared::decodeAlbedo(step.albedo[1]), blue, kAlbedoStep);
    EXPECT_EQ(step.front_visible, 1u << kUp | 1u << 1);

    // a slope that faces (3, 4, 0) / 5 has its own normal on both faces that see it
    const std::vector<Corners> slope{
        Corners{{Double3{1.2, 1.8, 1.1}, Double3{1.2, 1.8, 1.9}, Double3{1.6, 1.5, 1.1}}}};
    const SolidVoxel slanted = makeVoxelFrom({{slope, colored(red)}});
    EXPECT_EQ(slanted.front_visible, 1u << kUp | 1u << 1);
    for (const uint32_t face : {1u, kUp})
        EXPECT_GT(dot(decodeNormal(slanted, face), Float3{0.6f, 0.8f, 0}), 0.9998f);
}

TEST(VoxelLook, ofASheetFromBehindIsItsColour)
{
    const Float3 green{0.2f, 0.7f, 0.3f};
    const std::vector<Corners> sheet = rectangle(1.5, {1, 0, 1}, {2, 0, 2});
    const SolidVoxel single = makeVoxelFrom({{sheet, colored(green)}});
    expectNear(shared::decodeAlbedo(single.albedo[kDown]), green, kAlbedoStep);
    expectNear(decodeNormal(single, kDown), {0, -1, 0}, 0);
    expectNear(decodeNormal(single, 0), {-1, 0, 0}, 0);
    EXPECT_EQ(single.front_visible, 1u << kUp);

    const SolidVoxel both = makeVoxelFrom({{sheet, colored(green, true)}});
    EXPECT_EQ(both.front_visible, 1u << kUp | 1u << kDown);
    expectNear(decodeNormal(both, kDown), {0, -1, 0}, 0);
}

TEST(VoxelLook, ofBlendedSurfacesHidesAsMuchAsTheirAlpha)
{
    for (const float alpha : {0.0f, 0.25f, 0.5f, 0.9f})
    {
        SurfaceMaterial glass = colored({1, 1, 1});
        glass.record.alpha_mode = static_cast<uint32_t>(formats::AlphaMode::blend);
        glass.record.base_color.w = alpha;
        const SolidGrid grid =
            makeSolidGrid(rectangle(1.5, {0, 0, 0}, {4, 0, 4}), frameOfSize(4, 4, 4), glass);
        if (alpha == 0)
        {
            EXPECT_TRUE(grid.voxels.empty());
            continue;
        }
        ASSERT_EQ(grid.voxels.size(), 16u);
        for (const SolidVoxel& voxel : grid.voxels)
            EXPECT_NEAR(voxel.opacity, alpha * 255, 3);
    }
}

TEST(VoxelLook, ofASphereTurnsWithIt)
{
    constexpr double kRadius = 10;
    const Double3 middle{16.3, 15.8, 16.1};
    std::vector<Corners> sphere;
    const auto at = [&](int ring, int sector)
    {
        const double polar = std::numbers::pi * ring / 32,
                     azimuth = 2 * std::numbers::pi * (sector % 64) / 64;
        return middle + Double3{std::sin(polar) * std::sin(azimuth), std::cos(polar),
                                std::sin(polar) * std::cos(azimuth)} *
                            kRadius;
    };
    for (int ring = 0; ring < 32; ++ring)
        for (int sector = 0; sector < 64; ++sector)
        {
            sphere.push_back({{at(ring, sector), at(ring + 1, sector), at(ring + 1, sector + 1)}});
            sphere.push_back({{at(ring, sector), at(ring + 1, sector + 1), at(ring, sector + 1)}});
        }
    const GridWithFaces grid = addFaces(makeSolidGrid(sphere, frameOfSize(32, 32, 32)));
    EXPECT_EQ(grid.seen.sealed, 1u);
    grid.solid.forEachBrick(
        [&](uint32_t brick, const Cell& least)
        {
            uint32_t v = grid.solid.bricks[brick].first;
            for (uint64_t rest = grid.solid.bricks[brick].mask; rest != 0; rest &= rest - 1, ++v)
            {
                const Cell cell = cellFromBit(least, static_cast<uint32_t>(std::countr_zero(rest)));
                const Double3 from = Double3{cell[0] + 0.5, cell[1] + 0.5, cell[2] + 0.5} - middle;
                EXPECT_LT(std::abs(length(from) - kRadius), std::sqrt(0.75) + 0.1);
                for (uint32_t face = 0; face < kFaces; ++face)
                    if ((grid.faces[v] >> face & 1) != 0 &&
                        (grid.solid.voxels[v].front_visible >> face & 1) != 0)
                    {
                        EXPECT_GT(
                            dot(decodeNormal(grid.solid.voxels[v], face), narrow(from * (1 / length(from)))),
                            0.99f);
                    }
            }
        });
    // projections of a sphere: all faces along an axis cover at least the sphere's disc, and at most half as
    // much again
    for (const size_t faces : countFaces(grid))
    {
        EXPECT_GT(static_cast<double>(faces), std::numbers::pi * kRadius * kRadius);
        EXPECT_LT(static_cast<double>(faces), 1.5 * std::numbers::pi * kRadius * kRadius);
    }
}

TEST(SideMix, keepsAnAlbedoThatAllSurfacesHave)
{
    const Float3 albedo{0.8f, 0.4f, 0.2f};
    Random random(7);
    std::uniform_real_distribution<double> turn(-1, 1);
    for (int i = 0; i < 20; ++i)
    {
        const Double3 x{turn(random), turn(random), turn(random)},
            y{turn(random), turn(random), turn(random)};
        const Double3 a = x * (3 / length(x)), across = cross(x, y), c = across * (2.5 / length(across)),
                      along = cross(c, a), b = along * (4 / length(along));
        std::vector<Corners> box;
        addBox(box, Double3{10, 10, 10}, a, b, c, i % 2 != 0);
        SolidGrid grid = makeSolidGrid(box, frameOfSize(20, 20, 20), colored(albedo));
        blendSides(grid);
        for (const SolidVoxel& voxel : grid.voxels)
            for (uint32_t face = 0; face < kFaces; ++face)
                expectNear(shared::decodeAlbedo(voxel.albedo[face]), albedo, 2 * kAlbedoStep);
    }
}

/// To the nearest quarter of a voxel, from either side, and through the blending of sides.
TEST(FaceDepth, isThatOfTheSurfaceBehindTheFace)
{
    const struct
    {
        double height;
        float below_up;
    } sheets[] = {{1.9, 0}, {1.75, 0.25f}, {1.4, 0.5f}, {1.25, 0.75f}, {1.05, 0.75f}};
    for (const auto& sheet : sheets)
    {
        SolidGrid grid = makeSolidGrid(rectangle(sheet.height, {1, 0, 1}, {2, 0, 2}), frameOfSize(4, 4, 4));
        blendSides(grid);
        ASSERT_EQ(grid.voxels.size(), 1u);
        EXPECT_EQ(shared::decodeFaceDepth(grid.voxels[0].albedo[kUp]), sheet.below_up) << sheet.height;
    }
}

TEST(WithinBudget, keepsTheNearestBricksThatFit)
{
    Random random(12);
    std::vector<Corners> soup;
    for (int i = 0; i < 300; ++i)
    {
        const Double3 at = uniformPoint(random, 2, 62);
        soup.push_back({{at, at + uniformPoint(random, -2, 2), at + uniformPoint(random, -2, 2)}});
    }
    const SolidGrid solid = makeSolidGrid(soup, frameOfSize(64, 64, 64));
    const GridWithFaces whole = addFaces(solid);
    const Float3 focus{10, 20, 30};
    const auto computeDistance = [&](const Cell& cell) {
        return length(Double3{cell[0] + 2.0, cell[1] + 2.0, cell[2] + 2.0} - widen(focus));
    };
    for (const double share : {1.0, 0.7, 0.2, 0.02})
    {
        const auto memory = static_cast<uint64_t>(share * static_cast<double>(whole.bytes().total()));
        const GridWithFaces some = fitToMemory(solid, {}, {&focus, 1}, memory);
        EXPECT_LE(some.bytes().total(), memory);
        EXPECT_EQ(some.solid.bricks.size() + some.dropped.bricks, whole.solid.bricks.size());
        EXPECT_EQ(some.solid.voxels.size() + some.dropped.voxels, whole.solid.voxels.size());
        if (share == 1)
        {
            EXPECT_EQ(some.dropped.bricks, 0u);
            continue;
        }
        // one more would not have fitted
        EXPECT_GT(some.bytes().total() + sizeof(formats::BrickRecord) + 64 * (1 + 6 * 14), memory);
        some.solid.forEachBrick([&](uint32_t, const Cell& cell)
                                { EXPECT_LE(computeDistance(cell), some.dropped.from_distance); });
        size_t nearer = 0;
        whole.solid.forEachBrick([&](uint32_t, const Cell& cell)
                                 { nearer += computeDistance(cell) < some.dropped.from_distance ? 1u : 0u; });
        EXPECT_LE(nearer, some.solid.bricks.size());
        const BrickTables tables = makeBrickTables(some.solid, some.faces);
        EXPECT_EQ(computeBrickBytes(tables.groups.size(), tables.bricks.size(), tables.opacity.size(),
                                    tables.albedo.size())
                      .total(),
                  some.bytes().total());
    }
}

TEST(FrameOf, liesOnMultiplesWithRoomBehindTheSides)
{
    Box3 box;
    box.add(Float3{-3, 0, 0.2f});
    box.add(Float3{3, 2.5f, 4.9f});
    const Result<GridFrame> frame = makeGridFrame({}, box, 0.5);
    ASSERT_TRUE(frame.ok());
    EXPECT_EQ(frame->origin, (Float3{-3.5f, -0.5f, 0}));
    EXPECT_EQ(frame->voxels, (Cell{14, 7, 10}));
    const Result<GridFrame> empty = makeGridFrame({}, Box3{}, 1);
    ASSERT_TRUE(empty.ok());
    EXPECT_EQ(empty->voxels, (Cell{1, 1, 1}));
}

TEST(FrameOf, takesAnExtentAsItIs)
{
    GridSettings settings;
    settings.min = {-256, -64, -256};
    settings.max = {256, 64, 256};
    for (const auto& [size, voxels] :
         {std::pair{1.0, Cell{512, 128, 512}}, {0.1, {5120, 1280, 5120}}, {0.3, {1707, 427, 1707}}})
    {
        settings.memory = uint64_t{1} << 32;
        const Result<GridFrame> frame = makeGridFrame(settings, Box3{}, size);
        ASSERT_TRUE(frame.ok());
        EXPECT_EQ(frame->origin, (Float3{-256, -64, -256}));
        EXPECT_EQ(frame->voxels, voxels);
    }
}

TEST(FrameOf, refusesWhatMakesNoSense)
{
    const double nan = std::numeric_limits<double>::quiet_NaN(),
                 infinity = std::numeric_limits<double>::infinity();
    Box3 box;
    box.add(Float3{0, 0, 0});
    box.add(Float3{100, 100, 100});
    const auto refuse = [&](const GridSettings& settings, double size, const std::string& part)
    {
        const Result<GridFrame> frame = makeGridFrame(settings, box, size);
        ASSERT_FALSE(frame.ok());
        EXPECT_EQ(exitCode(frame.error()), 2);
        EXPECT_NE(formatMessage(frame.error()).find(part), std::string::npos) << formatMessage(frame.error());
    };
    for (const double size : {0.0, -1.0, nan, infinity})
    {
        GridSettings settings;
        settings.voxel_size = size;
        refuse(settings, size, "is not a size: give metres above 0");
    }
    refuse({}, 1e-3, "along x, 16384 are the most: give at least 0.0061");
    GridSettings settings;
    settings.min = Double3{0, 0, 0};
    refuse(settings, 1, "needs both");
    for (const Double3& max : {Double3{1, 0, 1}, {1, -1, 1}, {1, nan, 1}, {1, infinity, 1}})
    {
        settings.max = max;
        refuse(settings, 1, "the extent along y is 0 to");
    }
    settings = {};
    settings.memory = 100;
    refuse(settings, 1, "100 bytes are less than the empty grid takes, 4116");
}

TEST(VoxelSize, isOfTheSeriesByTheLongestSide)
{
    const auto of = [](float side)
    {
        Box3 box;
        box.add(Float3{0, 0, 0});
        box.add(Float3{1, side, 2});
        return firstVoxelSize(box);
    };
    EXPECT_EQ(of(512), 1);
    EXPECT_EQ(of(600), 1.25);
    EXPECT_EQ(of(30), 0.1);
    EXPECT_EQ(of(6), 0.1);
    EXPECT_EQ(of(3.2f), 0.05);
    EXPECT_EQ(of(2), 0.032);
    EXPECT_EQ(firstVoxelSize(Box3{}), 1);
    double size = 0.1;
    for (const double expected : {0.125, 0.16, 0.2, 0.25, 0.32, 0.4, 0.5, 0.64, 0.8, 1.0, 1.25})
    {
        size = nextVoxelSize(size);
        EXPECT_EQ(size, expected);
    }
}

} // namespace hearth::bricks

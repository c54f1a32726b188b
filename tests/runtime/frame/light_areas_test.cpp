// Tests which lights reach the tiles of an image and boxes of clusters, against a test of each light at each
// point.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/light_boxes.h"

#include "tests/runtime/frame/light_cases.h"
#include "tests/support/sanitized.h"

#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

using shared::LightGridLayout;
using shared::LightGridView;

/// True if a tile lists a light: the test of tile_lights.comp.
bool reachesTile(const LightGridLayout& layout, uint32_t tile, const shared::LightSlab& slab,
                 const shared::CellLight& light)
{
    const uint32_t column = tile % layout.tiles.columns, number = tile / layout.tiles.columns;
    const shared::LightRow row{lightRowEdge(layout.grid, layout.tiles, number),
                               lightRowEdge(layout.grid, layout.tiles, number + 1)};
    const shared::LightColumns columns = lightColumns(layout.grid, layout.tiles, light, slab, row);
    return static_cast<int>(column) >= columns.first && static_cast<int>(column) <= columns.last &&
           reachesCell(layout.grid, light, slab,
                       {lightColumnEdge(layout.grid, layout.tiles, column),
                        lightColumnEdge(layout.grid, layout.tiles, column + 1), row.begin, row.end});
}

} // namespace

TEST(LightTiles, areOf32PixelsAndNoMoreThanAllowed)
{
    LightCases cases(1);
    for (int i = 0; i < 1000; ++i)
    {
        const LightGridView view = cases.view();
        const shared::LightCascade tiles = makeLightGrid(view).tiles;
        const float pixels = 1 / tiles.cells_per_pixel;
        ASSERT_LE(tiles.columns * tiles.rows, shared::kMaxLightTiles);
        EXPECT_GE(static_cast<float>(tiles.columns) * pixels, view.width);
        EXPECT_GE(static_cast<float>(tiles.rows) * pixels, view.height);
        const bool is_large =
            std::ceil(view.width / 32) * std::ceil(view.height / 32) > shared::kMaxLightTiles;
        EXPECT_EQ(pixels, is_large ? 64 : 32);
    }
}

TEST(LightTiles, missNoLitPoint)
{
    LightCases cases(5);
    uint32_t lit_pairs = 0, listed = 0, pairs = 0;
    for (size_t v = 0; v < trials(4000); ++v)
    {
        const LightGridView view = cases.view();
        const LightGridLayout layout = makeLightGrid(view);
        for (int i = 0; i < 40; ++i)
        {
            Float3 image, other;
            const Vector point = cases.point(view, layout, image);
            // a tile that shows this point, and others nearer or farther
            const auto depth = static_cast<float>(cases.logUniform(0.5, 2)) * image.z;
            const shared::LightSlab slab =
                tileSlab(layout.grid, std::min(image.z, depth), std::max(image.z, depth));
            const uint32_t tile = lightCellAt(layout.tiles, image.x, image.y, image.z);
            for (const Vector& lit : {point, cases.point(view, layout, other)})
            {
                const LightCase light = cases.light(lit);
                const shared::CellLight seen = makeCellLight(layout.grid, light.light);
                const bool is_listed =
                    isLightInView(layout.grid, seen) && reachesTile(layout, tile, slab, seen);
                ++pairs;
                listed += is_listed ? 1 : 0;
                if (!isLit(light.light, point, light.outer_cone_rad))
                    continue;
                ++lit_pairs;
                ASSERT_TRUE(is_listed) << "view " << v << ", range " << light.light.range << " at depth "
                                       << image.z << ", cone " << light.outer_cone_rad;
            }
        }
    }
    EXPECT_GT(lit_pairs, 37 * trials(4000));
    EXPECT_LT(listed, pairs - pairs / 8) << "most lights of other points are left out";
}

TEST(LightTiles, listNothingWithoutASurface)
{
    LightCases cases(6);
    const LightGridView view = cases.view();
    const shared::LightSlab slab = tileSlab(makeLightGrid(view).grid, shared::kMaxFiniteError, 0);
    EXPECT_GT(slab.begin, slab.end);
}

TEST(LightBoxes, missNoLitPoint)
{
    LightCases cases(7);
    uint32_t lit_pairs = 0, boxes_listed = 0, boxes = 0;
    for (size_t v = 0; v < trials(20000); ++v)
    {
        const LightGridView view = cases.view();
        const LightGridLayout layout = makeLightGrid(view);
        Float3 image;
        const Vector middle = cases.point(view, layout, image);
        // any affine instance, a mirror and a shear too
        shared::Instance instance{};
        const double size = cases.logUniform(0.001, 10);
        Float4* const rows[] = {&instance.world_from_object_x, &instance.world_from_object_y,
                                &instance.world_from_object_z};
        const double origin[] = {middle.x, middle.y, middle.z};
        for (int axis = 0; axis < 3; ++axis)
        {
            const Float3 row = cases.direction() * static_cast<float>(size * cases.uniform(0.2, 2));
            *rows[axis] = {row.x, row.y, row.z, static_cast<float>(origin[axis])};
        }
        const Float3 a = cases.direction(), b = cases.direction();
        const Float3 low = min(a, b), high = max(a, b);
        const shared::LightBox box = lightBox(layout.grid, instance, view.eye, low, high);
        for (int i = 0; i < 8; ++i)
        {
            const double inside[] = {cases.uniform(low.x, high.x), cases.uniform(low.y, high.y),
                                     cases.uniform(low.z, high.z)};
            const auto transform = [&](const Float4& row)
            { return row.x * inside[0] + row.y * inside[1] + row.z * inside[2] + double{row.w}; };
            const Vector point{transform(*rows[0]), transform(*rows[1]), transform(*rows[2])};
            for (const Vector& lit : {point, cases.point(view, layout, image)})
            {
                const LightCase light = cases.light(lit);
                const bool is_listed = reachesBox(makeCellLight(layout.grid, light.light), box);
                ++boxes;
                boxes_listed += is_listed ? 1 : 0;
                if (!isLit(light.light, point, light.outer_cone_rad))
                    continue;
                ++lit_pairs;
                ASSERT_TRUE(is_listed)
                    << "view " << v << ", range " << light.light.range << ", cone " << light.outer_cone_rad;
            }
        }
    }
    EXPECT_GT(lit_pairs, 7 * trials(20000));
    EXPECT_LT(boxes_listed, boxes - boxes / 8) << "most lights of other points are left out";
}

} // namespace hearth::test

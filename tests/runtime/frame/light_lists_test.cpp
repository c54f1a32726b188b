// Tests the lists of light cells against a test of each light at each point.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/frame/light_lists.h"

#include "tests/runtime/frame/light_cases.h"
#include "tests/support/sanitized.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace hearth::test
{

namespace
{

using shared::LightGridLayout;
using shared::LightGridView;
using shared::LightLists;

bool contains(const std::vector<uint32_t>& rows, uint32_t row)
{
    return std::find(rows.begin(), rows.end(), row) != rows.end();
}

} // namespace

TEST(LightGrid, hasNoMoreCellsThanAllowed)
{
    LightCases cases(1);
    for (int i = 0; i < 1000; ++i)
    {
        const LightGridView view = cases.view();
        const LightGridLayout layout = makeLightGrid(view);
        ASSERT_LE(layout.grid.cell_count, shared::kMaxLightCells);
        uint32_t cells = 0, slabs = 0;
        for (const shared::LightCascade& cascade : layout.cascades)
        {
            EXPECT_EQ(cascade.first_cell, cells);
            EXPECT_EQ(cascade.first_slab, slabs);
            cells += cascade.slabs * cascade.rows * cascade.columns;
            slabs += cascade.slabs;
        }
        EXPECT_EQ(cells, layout.grid.cell_count);
        EXPECT_EQ(slabs, layout.grid.slab_count);
    }
}

TEST(LightGrid, isThatOfTheDesignAt720Lines)
{
    LightGridView view{.width = 1280, .height = 720};
    view.pixels_per_u = view.pixels_per_v = 360 / std::tan(0.4f);
    view.center_x = 640;
    view.center_y = 360;
    const LightGridLayout layout = makeLightGrid(view);
    EXPECT_NEAR(layout.grid.slab_count, 95, 10);
    EXPECT_NEAR(layout.grid.cell_count, 19580, 3000);
}

TEST(LightLists, missNoLitPoint)
{
    LightCases cases(2);
    LightLists lists;
    uint32_t lit_pairs = 0;
    for (size_t v = 0; v < trials(1000); ++v)
    {
        const LightGridView view = cases.view();
        const LightGridLayout layout = makeLightGrid(view);
        std::vector<LightCase> lights;
        std::vector<std::pair<Vector, Float3>> points;
        for (int i = 0; i < 1000; ++i)
        {
            Float3 image;
            const Vector point = cases.point(view, layout, image);
            points.push_back({point, image});
            if (i < 40)
                lights.push_back(cases.light(point));
        }
        std::vector<shared::Light> records;
        for (const LightCase& light : lights)
            records.push_back(light.light);
        ListMemory memory(records.size());
        lists.assign(layout, records, memory.view());
        ASSERT_EQ(memory.counts.overflows, 0u);
        for (const auto& [point, image] : points)
        {
            const std::vector<uint32_t> rows = memory.listLights(cellAt(layout, image));
            ASSERT_TRUE(std::is_sorted(rows.begin(), rows.end()));
            for (uint32_t row = 0; row < lights.size(); ++row)
                if (isLit(lights[row].light, point, lights[row].outer_cone_rad))
                {
                    ++lit_pairs;
                    ASSERT_TRUE(contains(rows, row))
                        << "view " << v << ", light " << row << " of range " << lights[row].light.range
                        << " at depth " << image.z << ", cone " << lights[row].outer_cone_rad;
                }
        }
    }
    EXPECT_GT(lit_pairs, 1000 * trials(1000));
}

/// The row test of the shaders, for each cell alone.
TEST(LightLists, equalTheTestOfEachCell)
{
    LightCases cases(3);
    LightLists lists;
    for (size_t v = 0; v < trials(60); ++v)
    {
        const LightGridView view = cases.view();
        const LightGridLayout layout = makeLightGrid(view);
        std::vector<shared::Light> lights;
        for (int i = 0; i < 12; ++i)
        {
            Float3 image;
            lights.push_back(cases.light(cases.point(view, layout, image)).light);
        }
        ListMemory memory(lights.size());
        lists.assign(layout, lights, memory.view());
        for (const shared::LightCascade& cascade : layout.cascades)
            for (uint32_t number = 0; number < cascade.slabs; ++number)
            {
                const shared::LightSlab slab = lightSlab(layout.grid, cascade, number);
                for (uint32_t r = 0; r < cascade.rows; ++r)
                    for (uint32_t place = 0; place < memory.counts.ranged; ++place)
                    {
                        const uint32_t row = memory.frame[memory.counts.unranged + place];
                        const shared::CellLight light = makeCellLight(layout.grid, lights[row]);
                        const shared::LightRow edges{lightRowEdge(layout.grid, cascade, r),
                                                     lightRowEdge(layout.grid, cascade, r + 1)};
                        const shared::LightColumns columns =
                            slab.end > slab.begin ? lightColumns(layout.grid, cascade, light, slab, edges)
                                                  : shared::LightColumns{1, 0};
                        for (uint32_t c = 0; c < cascade.columns; ++c)
                        {
                            const bool reaches = static_cast<int>(c) >= columns.first &&
                                                 static_cast<int>(c) <= columns.last &&
                                                 reachesCell(layout.grid, light, slab,
                                                             {lightColumnEdge(layout.grid, cascade, c),
                                                              lightColumnEdge(layout.grid, cascade, c + 1),
                                                              edges.begin, edges.end});
                            const uint32_t cell =
                                cascade.first_cell + (number * cascade.rows + r) * cascade.columns + c;
                            ASSERT_EQ(contains(memory.listLights(cell), row), reaches)
                                << "view " << v << " light " << row << " cell " << cell;
                        }
                    }
            }
    }
}

TEST(LightLists, fallBackToAllLightsWhereTheyAreFull)
{
    LightCases cases(4);
    LightGridView view{.width = 640, .height = 480};
    view.forward = {0, 0, 1};
    view.right = {1, 0, 0};
    view.down = {0, 1, 0};
    view.pixels_per_u = view.pixels_per_v = 400;
    view.center_x = 320;
    view.center_y = 240;
    const LightGridLayout layout = makeLightGrid(view);
    std::vector<shared::Light> lights;
    for (int i = 0; i < 50; ++i)
    {
        Float3 image;
        lights.push_back(cases.light(cases.point(view, layout, image)).light);
    }
    LightLists lists;
    ListMemory all(lights.size());
    lists.assign(layout, lights, all.view());
    ListMemory few(lights.size(), all.counts.index_words / 2);
    lists.assign(layout, lights, few.view());
    EXPECT_GT(few.counts.overflows, 0u);
    EXPECT_EQ(few.counts.index_words, all.counts.index_words);
    EXPECT_EQ(few.counts.indices, all.counts.indices);
    for (uint32_t cell = 0; cell < layout.grid.cell_count; ++cell)
    {
        const std::vector<uint32_t> listed = few.listLights(cell);
        for (const uint32_t row : all.listLights(cell))
            EXPECT_TRUE(contains(listed, row));
    }
}

TEST(LightLists, leaveOutLightsThatAreOffAndListCommonOnesFirst)
{
    LightGridView view{.width = 64, .height = 64};
    view.forward = {0, 0, 1};
    view.right = {1, 0, 0};
    view.down = {0, 1, 0};
    view.pixels_per_u = view.pixels_per_v = 64;
    view.center_x = view.center_y = 32;
    shared::Light lamp{};
    lamp.type = shared::kLightPoint;
    lamp.position = {0, 0, 5};
    lamp.range = 1;
    lamp.intensity = {1, 1, 1};
    shared::Light off = lamp;
    off.intensity = {0, 0, 0};
    shared::Light endless = lamp;
    endless.range = 0;
    shared::Light behind = lamp;
    behind.position = {0, 0, -5};
    shared::Light sun{};
    sun.type = shared::kLightDirectional;
    sun.intensity = {0, 0, 1};
    const std::vector<shared::Light> lights{lamp, off, endless, behind, sun, lamp};
    LightLists lists;
    ListMemory memory(lights.size());
    lists.assign(makeLightGrid(view), lights, memory.view());
    EXPECT_EQ(memory.counts.unranged, 2u);
    EXPECT_EQ(memory.counts.ranged, 2u);
    EXPECT_EQ((std::vector<uint32_t>(memory.frame.begin(), memory.frame.begin() + 4)),
              (std::vector<uint32_t>{2, 4, 0, 5}));
}

} // namespace hearth::test

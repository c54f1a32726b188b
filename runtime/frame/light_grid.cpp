// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/frame/light_grid.h"

#include "formats/gpu_shared/decisions.h"

#include <cmath>
#include <numbers>

namespace hearth::shared
{

namespace
{

/// Share of a pixel by which a shaded point may lie off the ray of its pixel.
constexpr float kPixelSlack = 1.0f / 64;

/// Share of a distance that covers the roundings of the tests: each of a dozen may be one in the last place.
constexpr float kTestSlack = 8 * kRoundingSlack;

/// Split a row of the view's matrix into a unit vector across the view, the scale along it, and the shift.
struct ClipRow
{
    Float3 axis;
    float scale;
    float shift;
};

ClipRow splitRow(Float4 row, Float3 forward, bool is_orthographic)
{
    const Float3 r = row3(row);
    const float along = is_orthographic ? 0 : dot(r, forward);
    const Float3 across = r - forward * along;
    const float scale = length(across);
    return {across / scale, scale, is_orthographic ? row.w : along};
}

float edgeLength(float edge, bool is_orthographic)
{
    return is_orthographic ? 1.0f : std::sqrt(1.0f + edge * edge);
}

uint32_t cellsAlong(float pixels, float cell_pixels)
{
    return std::max(1u, static_cast<uint32_t>(std::ceil(pixels / cell_pixels)));
}

/// Lay out cells of at least `pixels` each way; returns their number.
uint64_t layOut(const LightGridView& view, float pixels, LightGridLayout& layout)
{
    uint64_t cells = 0;
    uint32_t slabs = 0;
    layout.grid.max_columns = layout.grid.max_rows = 0;
    for (uint32_t k = 0; k < kLightCascades; ++k)
    {
        LightCascade& cascade = layout.cascades[k];
        cascade = {};
        cascade.begin = std::ldexp(kFirstCascadeDepth, static_cast<int>(k));
        // metres that a pixel covers where the cascade begins
        const float pixel = (view.is_orthographic ? 1.0f : cascade.begin) / view.pixels_per_v;
        const float size = std::max(pixels * pixel, kMinLightCellSize);
        const float cell_pixels = size / pixel;
        cascade.slabs = static_cast<uint32_t>(
            std::clamp(std::round(cascade.begin / size), 1.0f, static_cast<float>(kMaxLightCells)));
        cascade.slab_depth = cascade.begin / static_cast<float>(cascade.slabs);
        cascade.slabs_per_m = 1 / cascade.slab_depth;
        cascade.cells_per_pixel = 1 / cell_pixels;
        cascade.column_step = cell_pixels / view.pixels_per_u;
        cascade.columns_per_u = 1 / cascade.column_step;
        cascade.row_step = cell_pixels / view.pixels_per_v;
        cascade.rows_per_v = 1 / cascade.row_step;
        cascade.columns = cellsAlong(view.width, cell_pixels);
        cascade.rows = cellsAlong(view.height, cell_pixels);
        cascade.first_slab = slabs;
        cascade.first_cell = static_cast<uint32_t>(std::min<uint64_t>(cells, UINT32_MAX));
        slabs += cascade.slabs;
        cells += uint64_t{cascade.slabs} * cascade.rows * cascade.columns;
        layout.grid.max_columns = std::max(layout.grid.max_columns, cascade.columns);
        layout.grid.max_rows = std::max(layout.grid.max_rows, cascade.rows);
    }
    layout.grid.slab_count = slabs;
    layout.grid.cell_count = static_cast<uint32_t>(std::min<uint64_t>(cells, UINT32_MAX));
    return cells;
}

/// Lay out the tiles of an image: one slab, which has no depth.
LightCascade layOutTiles(const LightGridView& view)
{
    LightCascade tiles{};
    tiles.slabs = 1;
    for (float pixels = kLightTilePixels; tiles.columns == 0 || tiles.columns * tiles.rows > kMaxLightTiles;
         pixels *= 2)
    {
        tiles.cells_per_pixel = 1 / pixels;
        tiles.columns = cellsAlong(view.width, pixels);
        tiles.rows = cellsAlong(view.height, pixels);
        tiles.column_step = pixels / view.pixels_per_u;
        tiles.columns_per_u = 1 / tiles.column_step;
        tiles.row_step = pixels / view.pixels_per_v;
        tiles.rows_per_v = 1 / tiles.row_step;
    }
    return tiles;
}

} // namespace

LightGridView lightGridView(const FrameView& view)
{
    const Float3 forward = row3(view.clip_w);
    const bool is_orthographic = isOrthographic(view);
    const ClipRow x = splitRow(view.clip_x, forward, is_orthographic);
    const ClipRow y = splitRow(view.clip_y, forward, is_orthographic);
    return {.eye = view.eye,
            .right = x.axis,
            .down = y.axis,
            .forward = forward,
            .pixels_per_u = 0.5f * view.width * x.scale,
            .pixels_per_v = 0.5f * view.height * y.scale,
            .center_x = 0.5f * view.width * (1 + x.shift),
            .center_y = 0.5f * view.height * (1 + y.shift),
            .width = view.width,
            .height = view.height,
            .z_near = view.z_near,
            .is_orthographic = is_orthographic};
}

LightGridLayout makeLightGrid(const LightGridView& view)
{
    LightGridLayout layout{};
    LightGrid& grid = layout.grid;
    grid.right = view.right;
    grid.down = view.down;
    grid.forward = view.forward;
    grid.eye = view.eye;
    grid.z_near = view.z_near;
    grid.is_orthographic = view.is_orthographic ? 1 : 0;
    grid.edges = {-view.center_x / view.pixels_per_u, (view.width - view.center_x) / view.pixels_per_u,
                  -view.center_y / view.pixels_per_v, (view.height - view.center_y) / view.pixels_per_v};
    const Float4 e = grid.edges;
    grid.edge_lengths = {edgeLength(e.x, view.is_orthographic), edgeLength(e.y, view.is_orthographic),
                         edgeLength(e.z, view.is_orthographic), edgeLength(e.w, view.is_orthographic)};
    const float pixel_slack =
        kPixelSlack * std::numbers::sqrt2_v<float> / std::min(view.pixels_per_u, view.pixels_per_v);
    grid.slack_share = kTestSlack + (view.is_orthographic ? 0 : pixel_slack);
    grid.slack_size = view.is_orthographic ? pixel_slack : 0;
    for (float pixels = kLightCellPixels; layOut(view, pixels, layout) > kMaxLightCells;)
        pixels *= 1.125f;
    layout.tiles = layOutTiles(view);
    return layout;
}

} // namespace hearth::shared

// Lays out the grid of light cells over a view: formats/gpu_shared/light_grid.h. C++ only.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/light_grid.h"
#include "formats/gpu_shared/records.h"

#include <array>

namespace hearth::shared
{

/// Side of a cell in pixels, and its least side in metres.
inline constexpr float kLightCellPixels = 64;
inline constexpr float kMinLightCellSize = 0.5f;

/// Side of a tile in pixels; larger images have tiles twice as wide, or four times.
inline constexpr float kLightTilePixels = 32;

/// View that a grid divides.
struct LightGridView
{
    Float3 eye;                  ///< world, as all vectors
    Float3 right, down, forward; ///< unit, at right angles to each other
    float pixels_per_u = 1;      ///< light_grid.h has u and v
    float pixels_per_v = 1;
    float center_x = 0; ///< place of u = v = 0 in the image, pixels
    float center_y = 0;
    float width = 1; ///< pixels
    float height = 1;
    float z_near = 0.01f; ///< metres
    bool is_orthographic = false;
};

/// Return the view of a frame, which may be off centre.
LightGridView lightGridView(const FrameView& view);

struct LightGridLayout
{
    LightGrid grid;
    std::array<LightCascade, kLightCascades> cascades;
    LightCascade tiles; ///< of the image, each with depths of its own: shared::tileSlab
};

LightGridLayout makeLightGrid(const LightGridView& view);

} // namespace hearth::shared

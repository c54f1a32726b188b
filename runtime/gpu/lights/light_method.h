// Methods of lighting a frame by many lights: one table for the renderer, its programs and its tests.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/specialization.h"

#include <cstdint>
#include <iterator>

namespace hearth::gpu
{

enum class LightMethod : uint8_t
{
    practical, ///< the default
    all,
    tiled_forward,
    clustered_forward,
    forward,
    deferred,
    tiled_deferred,
    clustered_deferred,
    tile_deferred,
    count,
};
inline constexpr size_t kLightMethodCount = static_cast<size_t>(LightMethod::count);

/// Areas of a frame that have lists of lights.
enum class LightAreas : uint8_t
{
    cells, ///< of the light grid, before anything is drawn: on the device or the CPU
    // the next ones on the device alone
    visible_cells, ///< those with a visible pixel, behind the visibility buffer
    tiles,         ///< of the image, between the depths of their pixels: behind the visibility buffer
    slots,         ///< of the visible list, behind culling
};

/// True if areas have lists by what pixels show, which splits a frame behind the visibility buffer.
constexpr bool needPixels(LightAreas areas)
{
    return areas == LightAreas::visible_cells || areas == LightAreas::tiles;
}

/// Place at which a frame adds its lights.
enum class LightPath : uint8_t
{
    materials, ///< shading of materials evaluates lights as well
    /// Shading stores what lights need of a surface in an image, and a step behind it adds the lights. Needs
    /// RendererOptions::deferred. All of it is one render pass, up to the finished image.
    surfaces_on_tile,
    surfaces, ///< the same in render passes of their own: surfaces are stored in memory
};

/// Output of shading: frames of each have pipelines of their own.
enum class ShadedOutput : uint8_t
{
    color,
    radiance,         ///< of frames with a final pass
    surfaces_on_tile, ///< and radiance, of frames with this LightPath
    surfaces,
    count,
};
inline constexpr size_t kShadedOutputCount = static_cast<size_t>(ShadedOutput::count);

constexpr bool storesSurfaces(ShadedOutput output)
{
    return output >= ShadedOutput::surfaces_on_tile;
}

struct LightMethodFacts
{
    const char* name; ///< of --lights
    const char* summary;
    uint32_t light_list; ///< shared::kLightList*: lights that a pixel evaluates
    LightAreas areas;    ///< with lists
    LightPath path = LightPath::materials;
};

/// Facts by LightMethod. Methods that add lights in one order draw the same bytes.
inline constexpr LightMethodFacts kLightMethods[] = {
    {"practical", "each pixel evaluates the lights of its cell of a grid over the view",
     shared::kLightListCells, LightAreas::cells},
    {"all", "each pixel evaluates all lights of the frame", shared::kLightListFrame, LightAreas::cells},
    {"tiled-forward", "each pixel evaluates the lights of its tile, between the depths that the tile shows",
     shared::kLightListTiles, LightAreas::tiles},
    {"clustered-forward", "as practical, and only cells that a pixel shows have lists",
     shared::kLightListCells, LightAreas::visible_cells},
    {"forward", "each pixel evaluates the lights that reach the box of its cluster", shared::kLightListSlots,
     LightAreas::slots},
    {"deferred", "surfaces are stored, and each light is added to the pixels in its volume",
     shared::kLightListVolumes, LightAreas::cells, LightPath::surfaces},
    {"tiled-deferred", "surfaces are stored, and each pixel evaluates the lights of its tile",
     shared::kLightListTiles, LightAreas::tiles, LightPath::surfaces},
    {"clustered-deferred", "surfaces are stored, and each pixel evaluates the lights of its cell",
     shared::kLightListCells, LightAreas::visible_cells, LightPath::surfaces},
    {"tile-deferred", "the same as deferred, with surfaces that need not leave the tile",
     shared::kLightListVolumes, LightAreas::cells, LightPath::surfaces_on_tile},
};
static_assert(std::size(kLightMethods) == kLightMethodCount);

constexpr const LightMethodFacts& lightMethodFacts(LightMethod method)
{
    return kLightMethods[static_cast<size_t>(method)];
}

} // namespace hearth::gpu

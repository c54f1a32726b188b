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
    stack,
    prepass,
    classic_prepass,
    encoded_prepass,
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

/// Place at which a frame adds its lights. All but the first need RendererOptions::deferred.
enum class LightPath : uint8_t
{
    materials, ///< shading of materials evaluates lights as well
    /// Shading stores what lights need of a surface in an image, and a step behind it adds the lights. All of
    /// it is one render pass, up to the finished image.
    surfaces_on_tile,
    surfaces, ///< the same in render passes of their own: surfaces are stored in memory
    /// Lights are summed ahead of shading, which weighs the sums by each material: diffuse light, and
    /// specular light without and with the share of Schlick's term. Runs in the render pass of visibility and
    /// shading.
    light_sums,
    joint_sums,         ///< the same with the luminance of specular light alone, beside the diffuse light
    encoded_joint_sums, ///< the same, and lights read the depth from the image of normals
    light_bits,         ///< lights that reach a pixel are marked ahead of shading, in the same render pass
    count,
};
inline constexpr size_t kLightPathCount = static_cast<size_t>(LightPath::count);

/// Bit of a path in a set of them, beside `materials`.
constexpr uint32_t lightPathBit(LightPath path)
{
    return 1u << static_cast<uint32_t>(path);
}

inline constexpr uint32_t kAllLightPaths = (1u << kLightPathCount) - 2;

/// True if shading leaves the lights to a step behind it.
constexpr bool storesSurfaces(LightPath path)
{
    return path == LightPath::surfaces_on_tile || path == LightPath::surfaces;
}

/// True if shading weighs sums of light.
constexpr bool sumsLights(LightPath path)
{
    return path == LightPath::light_sums || path == LightPath::joint_sums ||
           path == LightPath::encoded_joint_sums;
}

/// Output of shading: frames of each have pipelines of their own.
enum class ShadedOutput : uint8_t
{
    color,
    radiance,         ///< of frames with a final pass
    surfaces_on_tile, ///< and radiance, of frames with this LightPath
    surfaces,
    // the first two of frames with the other paths
    summed_color,
    summed_radiance,
    joint_color,
    joint_radiance,
    encoded_joint_color,
    encoded_joint_radiance,
    marked_color,
    marked_radiance,
    count,
};
inline constexpr size_t kShadedOutputCount = static_cast<size_t>(ShadedOutput::count);

constexpr LightPath lightPath(ShadedOutput output)
{
    constexpr LightPath kPaths[] = {
        LightPath::materials,          LightPath::materials,  LightPath::surfaces_on_tile,
        LightPath::surfaces,           LightPath::light_sums, LightPath::light_sums,
        LightPath::joint_sums,         LightPath::joint_sums, LightPath::encoded_joint_sums,
        LightPath::encoded_joint_sums, LightPath::light_bits, LightPath::light_bits};
    static_assert(std::size(kPaths) == kShadedOutputCount);
    return kPaths[static_cast<size_t>(output)];
}

/// True if shading writes linear colours, which a final pass finishes.
constexpr bool isRadiance(ShadedOutput output)
{
    return output != ShadedOutput::color && output != ShadedOutput::summed_color &&
           output != ShadedOutput::joint_color && output != ShadedOutput::encoded_joint_color &&
           output != ShadedOutput::marked_color;
}

/// True if frames of methods with a path may have an output: those on the tile may have to leave it.
constexpr bool mayShade(LightPath path, ShadedOutput output)
{
    return lightPath(output) == path || (storesSurfaces(lightPath(output)) && storesSurfaces(path));
}

/// Return the colour targets of shading.
constexpr uint32_t shadedColors(ShadedOutput output)
{
    return storesSurfaces(lightPath(output)) ? 2 : 1;
}

/// Return the output of frames. Those that light stored surfaces have a final pass.
constexpr ShadedOutput shadedOutput(LightPath path, bool has_final_pass)
{
    ShadedOutput output = ShadedOutput::color;
    while (lightPath(output) != path || (isRadiance(output) != has_final_pass && !storesSurfaces(path)))
        output = static_cast<ShadedOutput>(static_cast<size_t>(output) + 1);
    return output;
}

struct LightMethodFacts
{
    const char* name; ///< of --lights
    const char* summary;
    uint32_t light_list; ///< shared::kLightList*: lights that a pixel evaluates
    LightAreas areas;    ///< with lists
    LightPath path = LightPath::materials;
    bool approximates = false; ///< the image differs by more than rounding
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
    {"stack", "bits of a pixel name the lights whose volume it is in; those behind the 64th have cells",
     shared::kLightListBits, LightAreas::cells, LightPath::light_bits},
    {"prepass", "lights are summed ahead of shading, split so that materials weigh the sums exactly",
     shared::kLightListVolumes, LightAreas::cells, LightPath::light_sums},
    {"classic-prepass", "the same with the luminance of specular light alone, in a third of the bytes",
     shared::kLightListVolumes, LightAreas::cells, LightPath::joint_sums, true},
    {"encoded-prepass", "the same, with depths of 16 bits beside the normals, for lights that read no others",
     shared::kLightListVolumes, LightAreas::cells, LightPath::encoded_joint_sums, true},
};
static_assert(std::size(kLightMethods) == kLightMethodCount);

constexpr const LightMethodFacts& lightMethodFacts(LightMethod method)
{
    return kLightMethods[static_cast<size_t>(method)];
}

} // namespace hearth::gpu

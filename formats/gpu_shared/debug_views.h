// Registry of the debug views: numbers for C++ and GLSL, and the names, shaders and notes that the runtime
// loops over.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_DEBUG_VIEWS_H
#define HEARTH_SHARED_DEBUG_VIEWS_H

#include "formats/gpu_shared/language.h"

HEARTH_SHARED_BEGIN

HEARTH_CONSTANT uint kViewFinal = 0;
HEARTH_CONSTANT uint kViewClusters = 1;
HEARTH_CONSTANT uint kViewLod = 2;
HEARTH_CONSTANT uint kViewTriangles = 3;
HEARTH_CONSTANT uint kViewNormals = 4;
HEARTH_CONSTANT uint kViewDepth = 5;
HEARTH_CONSTANT uint kViewMaterials = 6;
HEARTH_CONSTANT uint kViewError = 7;
HEARTH_CONSTANT uint kViewCones = 8;
HEARTH_CONSTANT uint kViewOverdraw = 9;
HEARTH_CONSTANT uint kViewShadowMaps = 10;
HEARTH_CONSTANT uint kViewBones = 11; ///< main bones of clusters
// sky occlusion as shaded
HEARTH_CONSTANT uint kViewAmbientOcclusion = 12;
HEARTH_CONSTANT uint kViewBentNormal = 13;        ///< axis of the visibility cone
HEARTH_CONSTANT uint kViewAperture = 14;          ///< its half-angle
HEARTH_CONSTANT uint kViewSpecularOcclusion = 15; ///< from the eye, by the material's roughness
// views of scenes with bricks
HEARTH_CONSTANT uint kViewBricks = 16;        ///< the voxels that a pixel's ray meets first, by albedo
HEARTH_CONSTANT uint kViewBrickLighting = 17; ///< the same by outgoing radiance
HEARTH_CONSTANT uint kViewGi = 18;            ///< global illumination alone, on white surfaces
// lists of lights
HEARTH_CONSTANT uint kViewLightCount = 19; ///< lights that a pixel evaluates, without those that all do
HEARTH_CONSTANT uint kViewLightCells = 20; ///< cells of the light grid
HEARTH_CONSTANT uint kViewReceivers = 21; ///< irradiance of the atlas alone, in its texels, on white surfaces

HEARTH_SHARED_END

#ifdef __cplusplus

#include <algorithm>
#include <array>
#include <cstdint>

namespace hearth::shared
{

/// Shader that draws a view.
enum class ViewShader : uint8_t
{
    materials,   ///< final: the materials
    surface,     ///< view_surface.frag, with the textures of each material
    clusters,    ///< view_clusters.frag
    overdraw,    ///< counts fragments; needs a renderer that was prepared for it
    shadow_maps, ///< view_shadow_maps.frag; needs a scene with shadows
    bricks,      ///< view_bricks.frag; needs a scene with bricks
    gi,          ///< view_gi.frag; needs a scene with bricks
};

struct DebugView
{
    uint32_t number;
    const char* name; ///< value of --view
    ViewShader shader;
    const char* note; ///< explanation for help; empty: none
};

// NOTE: a view is a line here, its number above, HEARTH_VIEW_... in hearth.h, and a branch in its shader.
// VIEW(name in hearth.h, number, value of --view, shader, note)
#define HEARTH_DEBUG_VIEWS(VIEW)                                                                             \
    VIEW(FINAL, kViewFinal, "final", materials, "")                                                          \
    VIEW(CLUSTERS, kViewClusters, "clusters", surface, "")                                                   \
    VIEW(LOD, kViewLod, "lod", surface, "red: source triangles, violet: coarsest")                           \
    VIEW(TRIANGLES, kViewTriangles, "triangles", surface, "")                                                \
    VIEW(MATERIALS, kViewMaterials, "materials", surface, "")                                                \
    VIEW(NORMALS, kViewNormals, "normals", surface, "")                                                      \
    VIEW(DEPTH, kViewDepth, "depth", surface, "")                                                            \
    VIEW(ERROR, kViewError, "error", clusters, "yellow: as large as allowed")                                \
    VIEW(CONES, kViewCones, "cones", clusters, "red: none")                                                  \
    VIEW(OVERDRAW, kViewOverdraw, "overdraw", overdraw, "white: 16")                                         \
    VIEW(BONES, kViewBones, "bones", surface, "of characters; grey: none")                                   \
    VIEW(AMBIENT_OCCLUSION, kViewAmbientOcclusion, "ao", surface, "packs with visibility; dark red: none")   \
    VIEW(BENT_NORMAL, kViewBentNormal, "bent-normal", surface, "packs with visibility; dark red: none")      \
    VIEW(APERTURE, kViewAperture, "aperture", surface, "packs with visibility; white: 90 degrees")           \
    VIEW(SPECULAR_OCCLUSION, kViewSpecularOcclusion, "specular-occlusion", surface,                          \
         "packs with visibility; dark red: none")                                                            \
    VIEW(BRICKS, kViewBricks, "bricks", bricks, "packs with bricks")                                         \
    VIEW(BRICK_LIGHTING, kViewBrickLighting, "brick-lighting", bricks, "packs with bricks; red: unknown")    \
    VIEW(GI, kViewGi, "gi", gi, "packs with bricks: their light alone, on white")                            \
    VIEW(SHADOW_MAPS, kViewShadowMaps, "shadow-maps", shadow_maps, "grey: none")                             \
    VIEW(LIGHT_COUNT, kViewLightCount, "light-count", surface,                                               \
         "blue: 1, green: 4, yellow: 8, red: 16, white: 32")                                                 \
    VIEW(LIGHT_CELLS, kViewLightCells, "light-cells", surface, "")                                           \
    VIEW(RECEIVERS, kViewReceivers, "receivers", surface,                                                    \
         "texels of baked light; red: a lamp of more than 2 % is dropped; violet: none")

#define HEARTH_LIST_VIEW(c_name, number, name, shader, note)                                                 \
    DebugView{number, name, ViewShader::shader, note},
/// All views, the final one first.
inline constexpr auto kDebugViews = std::to_array<DebugView>({HEARTH_DEBUG_VIEWS(HEARTH_LIST_VIEW)});
#undef HEARTH_LIST_VIEW

/// Find a view by its number; nullptr where there is none.
constexpr const DebugView* findDebugView(uint32_t number)
{
    const auto found = std::find_if(kDebugViews.begin(), kDebugViews.end(),
                                    [number](const DebugView& view) { return view.number == number; });
    return found == kDebugViews.end() ? nullptr : &*found;
}

/// Return the shader of a view that exists.
constexpr ViewShader viewShader(uint32_t number)
{
    return findDebugView(number)->shader;
}

/// True if the view needs bricks, which not all scenes have.
constexpr bool viewNeedsBricks(uint32_t number)
{
    return viewShader(number) == ViewShader::bricks || viewShader(number) == ViewShader::gi;
}

} // namespace hearth::shared

#endif

#endif

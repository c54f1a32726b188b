// Shadow plan: the lights that cast shadows, and their shadow maps in a frame. Plain data, no Vulkan. See
// runtime/gpu/README.md, "Shadows".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/shading.h"
#include "formats/pack/pack_view.h"
#include "formats/scene/scene_lighting.h"
#include "runtime/frame/shadow_fit.h"

#include <vector>

namespace hearth::gpu
{

/// Format of the depths in shadow maps.
enum class ShadowDepth : uint8_t
{
    d32, ///< floats
    d16, ///< fixed point, in half the memory
};
constexpr uint32_t depthBits(ShadowDepth depth)
{
    return depth == ShadowDepth::d16 ? 16 : 32;
}

/// Geometry that casts shadows.
enum class Casters : uint8_t
{
    clusters, ///< the levels that the frame draws, or coarser ones (ShadowOptions::error_bias)
    proxies,  ///< proxies of meshes that have one which can (shared::findProxyCasters), else clusters
};

/// Shadow settings of a scene.
struct ShadowOptions
{
    /// Largest number of maps of a frame, up to shared::kMaxShadowMaps: layers of their image. 0: no shadows,
    /// and nothing is created or recorded for them.
    uint32_t max_maps = 0;
    /// Width and height of a layer: 4 bytes per texel, 2 with 16-bit depths. A power of two up to 8192,
    /// >= 4 * (kernel + 1).
    uint32_t texels = 1024;
    uint32_t kernel = 1; ///< filter radius in texels: 1 is 3 x 3
    /// BiasLODError, >= 1: the error of casters may be this many times the error of the frame.
    float error_bias = 2;

    /// View-dependent maps of each sun, beside the spheres of the pack and of FrameInput; at most kMaxSplits.
    uint32_t splits = 4;
    shared::SplitRange split_range{};

    /// Draw casters that have moved since loading over a copy of the resting ones, in as many more layers.
    /// Otherwise a moving caster redraws its maps as a whole.
    bool moving_layers = true;

    /// Near plane of spots and of the faces of point lights in metres, above 0: nearer surfaces cast no
    /// shadow.
    float spot_near = 0.05f;

    /// d16: 16-bit depths where their steps do not show, else 32-bit depths (chooseShadowDepth).
    ShadowDepth depth = ShadowDepth::d32;

    Casters casters = Casters::clusters;
};

inline constexpr uint32_t kMaxSplits = 8;

/// Sphere in which shadows are finer, placed by an artist: a generalised cascade.
struct ShadowSphere
{
    static constexpr uint32_t kAllLights = 0xFFFFFFFF;

    Float3 center;               ///< world
    float radius = 1;            ///< metres, above 0
    uint32_t light = kAllLights; ///< index in the pack
    /// Width and height of its map, rounded down to a power of two; 0: the layer size, which is the maximum.
    uint32_t texels = 0;
};

/// Projection of a light that casts shadows. The faces of a point light follow each other, also in their
/// rows.
struct ShadowCaster
{
    uint32_t light = 0; ///< slot
    uint32_t row = 0;   ///< of the ShadowBlock
    uint32_t face = 0;  ///< of a point light
    shared::ShadowLight projection{};
    float tangent = 0;      ///< half-width of a spot or of a face; 0: a sun
    float range = 0;        ///< metres; 0: unlimited
    bool is_unseen = false; ///< no point in view is in the face, which needs no map
};

/// Return the spheres that artists placed in the scene.
std::vector<ShadowSphere> readShadowSpheres(const formats::PackView& pack);

/// Append the projections of a light.
///
/// row    first of its rows
/// scene  world bounds of all casters and receivers, not empty
/// near   ShadowOptions::spot_near
void addShadowCasters(const shared::Light& light, uint32_t slot, uint32_t row, const Box3& scene, float near,
                      std::vector<ShadowCaster>& casters);

/// Return the number of maps of a frame in which all lights have theirs, up to shared::kMaxShadowMaps.
///
/// spheres    number of spheres, each of all lights
uint32_t countShadowMaps(const shared::SceneLighting& lighting, uint32_t splits, size_t spheres);

/// Shadow maps of a frame. The shadow cache assigns their layers.
struct ShadowPlan
{
    shared::ShadowBlock block{};                           ///< the maps of each light are sorted by density
    uint32_t map_count = 0;                                ///< maps, and layers in use
    uint32_t unseen_maps = 0;                              ///< left out, of faces that no point in view is in
    uint32_t shadowed_lights = 0;                          ///< lights with all the maps that they need
    std::array<uint32_t, shared::kMaxShadowMaps> row_of{}; ///< light row of each map
    /// Metres of the finest texel of each row that has maps: all faces of a light have the finest of them, be
    /// they seen or not.
    std::array<float, shared::kMaxShadowProjections> finest_m{};
    std::array<float, shared::kMaxShadowProjections> range_m{}; ///< of each row; 0: unlimited
    uint32_t dropped_maps = 0;                                  ///< maps for which there was no layer
};

/// Largest step of 16-bit depths, in texels of the map. Casters are moved by a step of depth, and a stored
/// depth is off by up to another: a point counts as lit if it is nearer behind its caster, along the light,
/// than two steps. Where level ground meets a wall, under a light of elevation e, those are points up to
/// 2 cos(e) steps behind the wall, which is 2 cos(e) sin(e) <= 1 step across the light, in the map. So a
/// shadow begins late by a step at most: by half a texel, by which taking the nearest texel moves edges, too.
inline constexpr float kMaxDepthStepTexels = 0.5f;

/// Format of the depths of a scene's maps.
struct ShadowDepthChoice
{
    ShadowDepth depth = ShadowDepth::d32;
    /// Light with the largest step of 16-bit depths, index in the pack; kInvalidIndex: none was asked for.
    uint32_t light = kInvalidIndex;
    float step_texels = 0; ///< the step, in texels of the map
};

/// Choose the format of the depths: as the options say, but 32 bits if a step of 16 bits is larger than
/// kMaxDepthStepTexels in any map that a light of the pack may have. A step of a sun is 1 / 65535 of the
/// scene's depth along its rays; one of a spot or point light is z^2 / (near * 65535) at a distance of z
/// along the map's axis, up to the light's range or the end of the scene. Splits are taken as those of a lens
/// of 60 degrees: those of narrower lenses, spheres of frames, and lights that frames add may have finer
/// texels. There shadows begin later, but no surface shadows itself.
///
/// scene    world bounds
/// spheres  of the pack
ShadowDepthChoice chooseShadowDepth(const shared::SceneLighting& lighting, const ShadowOptions& options,
                                    const Box3& scene, std::span<const ShadowSphere> spheres);

/// Plan the maps of a frame. Suns get the spheres and the splits, spots their whole cone and the spheres that
/// intersect it, point lights all their faces, or none if there are too few layers, and the parts of spheres
/// in each face.
///
/// casters    whole lights, in the order in which they get layers
/// view       of the frame
/// spheres    spheres of lights that cast no shadow are ignored
ShadowPlan planShadows(std::span<const ShadowCaster> casters, const ShadowOptions& options,
                       const shared::FrameView& view, std::span<const ShadowSphere> spheres);

} // namespace hearth::gpu

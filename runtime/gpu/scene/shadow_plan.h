// Which lights cast shadows, and which maps a frame has of them: plain data, no Vulkan. See runtime/gpu/README.md, "Shadows".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/shading.h"
#include "formats/pack/pack_view.h"
#include "runtime/frame/shadow_fit.h"

#include <vector>

namespace hearth::gpu
{

/// Suns and spots cast shadows, point lights do not.
struct ShadowOptions
{
    /// Maps of a frame at most, up to shared::kMaxShadowMaps: layers of their image. 0: no shadows, for which nothing is made and recorded.
    uint32_t max_maps = 0;
    uint32_t texels =
        1024; ///< of a layer each way: 4 bytes each. A power of two up to 8192, >= 4 * (kernel + 1)
    uint32_t kernel = 1;  ///< texels that the filter reads on each side: 1 is 3 x 3
    float error_bias = 2; ///< BiasLODError, >= 1: by how many times a shadow may be coarser than the picture

    /// Maps of each sun that follow the view, beside the spheres of the pack and of FrameInput; at most kMaxSplits.
    uint32_t splits = 4;
    shared::SplitRange split_range{};

    /// Casters that have moved since they were loaded are drawn over a copy of those that rest, in as many layers more: else
    /// one that moves has its maps drawn as a whole.
    bool moving_layers = true;

    float spot_near = 0.05f; ///< metres, above 0: what is nearer to a spot light casts no shadow
};

inline constexpr uint32_t kMaxSplits = 8;

/// A sphere in which shadows are finer, as an artist places it: a generalised cascade.
struct ShadowSphere
{
    static constexpr uint32_t kAllLights = 0xFFFFFFFF;

    Float3 center;               ///< world
    float radius = 1;            ///< metres, above 0
    uint32_t light = kAllLights; ///< of the pack
    uint32_t texels =
        0; ///< of its map each way, rounded down to a power of two; 0: those of a layer, its most
};

/// A light that casts shadows, in the row of the ShadowBlock that its number in a list of them says.
struct CastingLight
{
    uint32_t light = 0; ///< of the pack
    shared::ShadowLight projection{};
    float cone_tangent = 0; ///< of a spot; 0: a sun
};

/// Those that artists placed in the scene.
std::vector<ShadowSphere> shadowSpheresOf(const formats::PackView& pack);

/// Give the lights that cast shadows their rows: the suns, then the spots, as many as there are.
void assignShadowRows(shared::Lighting& lighting);

/// One of them.
///
/// number  of the light
CastingLight makeCastingLight(const shared::Light& light, uint32_t number, const Box3& scene,
                              float spot_near);

/// The lights that have rows, in the order of the rows.
///
/// scene      box of all casters and receivers, world; of an empty one nothing casts
std::vector<CastingLight> makeCastingLights(const shared::Lighting& lighting, const Box3& scene,
                                            float spot_near);

/// The maps of a frame. Layers are given out in the order light, sphere, so that what stays keeps its layer.
struct ShadowPlan
{
    shared::ShadowBlock block{};                           ///< of each light the maps are sorted by density
    uint32_t map_count = 0;                                ///< maps, and layers in use
    std::array<uint32_t, shared::kMaxShadowMaps> row_of{}; ///< light row of a map
    std::array<float, shared::kMaxShadowLights>
        finest_m{};            ///< metres of the finest texel of a light that has maps
    uint32_t dropped_maps = 0; ///< for which there was no layer
};

/// Spots have their whole cone and the spheres that meet it, suns the spheres and the splits.
///
/// view       of the picture
/// spheres    those of lights that cast none are passed over
ShadowPlan planShadows(std::span<const CastingLight> lights, const ShadowOptions& options,
                       const shared::FrameView& view, std::span<const ShadowSphere> spheres);

} // namespace hearth::gpu

// C++ only: fits shadow maps to spheres, which artists place or which split the view. Spheres of either kind, of suns and
// of spots, are one list that is sorted by texel density: cascades without an order of their own.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/shadow.h"
#include "runtime/frame/frame.h"

#include <optional>
#include <span>

namespace hearth::shared
{

struct ShadowMapSize
{
    uint32_t texels = 1024; ///< each way; a power of two up to 8192, and at least 4 * (kernel + 1)
    uint32_t kernel = 1;    ///< texels that the filter reads on each side: 1 is 3 x 3
};

/// The projection of a sun over a scene, which has one as long as its box stays: what moves is the maps.
///
/// direction  the way it shines; of any length but 0
/// scene      box of all casters and receivers, world, not empty. Casters that leave it cast from where it begins
ShadowLight makeSunShadow(Float3 direction, const Box3& scene);

/// The projection of a spot light.
///
/// near       metres, above 0: what is nearer to the light casts no shadow
ShadowLight makeSpotShadow(Float3 position, Float3 direction, float near);

/// The map of a sun that holds a sphere. Moves in whole texels: vertices of casters keep their place within their texel,
/// to the bit, wherever the centre goes while the radius stays. Spheres so small that floats could not tell a sixteenth of
/// their texels apart get a coarser map.
///
/// sphere     world; radius above 0
ShadowMap fitSunMap(const ShadowLight& light, const Sphere& sphere, ShadowMapSize size);

/// The tangent of half the angle of a map of a whole cone. Wider cones than 80 degrees to each side have no shadow beyond.
float coneTangent(float outer_cone_rad);

/// The map of the whole cone, which every spot has for what no sphere holds.
ShadowMap wholeConeMap(float cone_tangent, ShadowMapSize size);

/// The part of the cone that holds a sphere: nothing where it lies behind the light or beside the cone, and the map of
/// the whole cone where the light lies in the sphere. Takes the exact bounds of the sphere's image. As for suns, tiny
/// spheres get a coarser map.
///
/// sphere     world; radius above 0
std::optional<ShadowMap> fitSpotMap(const ShadowLight& light, float cone_tangent, const Sphere& sphere,
                                    ShadowMapSize size);

/// The densest map first; what is as dense keeps its order. At any point the densities of the maps of one light are in
/// this order, also for a spot, whose texels grow alike in all its maps.
void sortByDensity(std::span<ShadowMap> maps);

/// The best map at a point: the first one that holds it; null where there is none.
///
/// point      relative to light.origin, world axes
const ShadowMap* mapHolding(const ShadowLight& light, std::span<const ShadowMap> maps, Float3 point);

/// What of a view gets shadows by default.
struct SplitRange
{
    float near = 0.1f; ///< metres
    float far = 100;
    float blend = 0.8f; ///< 0: splits of equal length, 1: each so many times as long as the one before
};

/// Spheres around the slices of a camera's view, the nearest first: the fallback where no artist placed any. Their radii
/// depend on the lens alone, neither on place nor direction. F. Zhang et al., "Parallel-split shadow maps for
/// large-scale virtual environments", 2006.
///
/// view       its eye, direction and lens are looked at
/// spheres    filled; as many slices
void splitSpheres(const FrameView& view, const SplitRange& range, std::span<Sphere> spheres);

} // namespace hearth::shared

// Fits shadow maps to spheres, which artists place or which split the view. Spheres of both kinds form one
// list for each light, sorted by texel density: cascades without a fixed order. C++ only.
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
    uint32_t texels = 1024; ///< width and height; a power of two up to 8192, and at least 4 * (kernel + 1)
    uint32_t kernel = 1;    ///< texels that the filter reads on each side: 1 is 3 x 3
};

/// Return the projection of a sun over a scene. It stays the same as long as the scene's box does; only the
/// maps move.
///
/// direction  direction of the light's rays; of any length but 0
/// scene      box of all casters and receivers, world, not empty. Casters that leave it cast from its
///            boundary
ShadowLight makeSunShadow(Float3 direction, const Box3& scene);

/// Return the projection of a spot light.
///
/// near       metres, above 0: nearer geometry casts no shadow
ShadowLight makeSpotShadow(Float3 position, Float3 direction, float near);

/// Half-width of a face of a point light, as a tangent: the faces meet at 45 degrees.
inline constexpr float kFaceTangent = 1;

/// Return the projection of one face of a point light, in world axes. With half-width kFaceTangent its maps
/// are those of a spot: the texels that a filter reads beyond a seam lie within the map of the face.
///
/// face       below kPointFaces
/// near       metres, above 0: nearer geometry casts no shadow
ShadowLight makePointShadow(Float3 position, uint32_t face, float near);

/// Return the map of a sun that covers a sphere. It moves in whole texels: vertices of casters keep their
/// position within their texel, bit for bit, wherever the centre goes while the radius stays. Spheres so
/// small that floats could not resolve a sixteenth of their texels get a coarser map.
///
/// sphere     world; radius above 0
ShadowMap fitSunMap(const ShadowLight& light, const Sphere& sphere, ShadowMapSize size);

/// Return the tangent of the half-angle of a map of a whole cone. Cones wider than 80 degrees to each side
/// have no shadow beyond that.
float coneTangent(float outer_cone_rad);

/// Return the map of the whole cone or face, which every spot and every face of a point light has for points
/// outside of all spheres. It is wider than the cone by the texels that the filter reads.
ShadowMap makeConeMap(float cone_tangent, ShadowMapSize size);

/// Return the map of the part of a cone or face that covers a sphere: nullopt where the sphere is behind the
/// light or beside the cone, and the map of the whole cone where the light is inside the sphere. The bounds
/// of the projected sphere are exact. As for suns, tiny spheres get a coarser map.
///
/// sphere     world; radius above 0
std::optional<ShadowMap> fitSpotMap(const ShadowLight& light, float cone_tangent, const Sphere& sphere,
                                    ShadowMapSize size);

/// Sort maps by texel density, densest first; maps of equal density keep their order. The densities of the
/// maps of one projection have this order at every point, also in perspective, where texels grow alike in all
/// maps.
void sortByDensity(std::span<ShadowMap> maps);

/// Return the best map at a point: the first one that covers it; null where there is none.
///
/// point      relative to light.origin, world axes
const ShadowMap* findShadowMap(const ShadowLight& light, std::span<const ShadowMap> maps, Float3 point);

/// Range of view depths with shadows, and its split scheme.
struct SplitRange
{
    float near = 0.1f; ///< metres
    float far = 100;
    /// 0: uniform splits, 1: logarithmic splits, each longer than the one before by the same factor
    float blend = 0.8f;
};

/// Compute spheres around slices of a camera's view, nearest first: the fallback where no artist placed any.
/// Their radii depend on the lens alone, not on position or direction. F. Zhang et al., "Parallel-split
/// shadow maps for large-scale virtual environments", 2006.
///
/// view       only its eye, direction and lens are used
/// spheres    output; its size is the number of slices
void computeSplitSpheres(const FrameView& view, const SplitRange& range, std::span<Sphere> spheres);

} // namespace hearth::shared

// How far the light that is gathered from bricks is from the truth, over points of a scene's surfaces.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/light/face_lighting.h"
#include "formats/gpu_shared/brick_lighting.h"
#include "tests/reference/tracer/irradiance.h"

#include <vector>

namespace hearth::reference
{

/// A point of a surface, and from where it is seen.
struct SeenPoint
{
    ShadedPoint point;
    Double3 to_eye; ///< unit
};

/// And the light that truly arrives there.
struct LitPoint
{
    SeenPoint seen;
    SurfaceLight truth;
    Double3 halves[2]; ///< indirect light by either half of the paths
    bool near_lamp =
        false; ///< within kNearLamp of a lamp, or of a surface that shines and is seen from there
};

/// Metres.
inline constexpr double kNearLamp = 0.15;

/// Points that are seen from the scene's cameras in all directions; where it has none, from straight above, but for the rim.
std::vector<SeenPoint> seenPoints(const ShadedScene& scene, const formats::PackView& pack, uint32_t count);

std::vector<LitPoint> litPoints(const ShadedScene& scene, const std::vector<SeenPoint>& points,
                                uint32_t paths);

/// The lights and the sky of the reference, as shaders take them.
shared::Lighting sharedLighting(const SceneLighting& lighting);

/// Light of bricks that has converged, and what arrives from it.
class BrickGather
{
public:
    /// bricks  whose tables outlive it
    /// rays    of each face
    BrickGather(const bricks::BrickView& bricks, const shared::Lighting& lighting, uint32_t rays);

    /// Irradiance over pi of all but the lights, as the runtime gathers it. rays  of the point
    Double3 at(const SeenPoint& point, uint32_t rays, uint32_t seed) const;

private:
    bricks::FaceLighting faces_;
    shared::BrickSky sky_;
};

/// Root mean square of differences over the mean of the truth. The square of a difference is the product of those from either
/// half of the paths, whose noise has nothing to do with each other: so its mean is that of the error alone.
struct LightError
{
    double whole = 0;    ///< over the mean of all light: its direct part has no error
    double indirect = 0; ///< over that of the indirect part
    double bias = 0;     ///< mean difference over the mean of the indirect part
    size_t points = 0;
};

/// gathered  for each point
LightError lightError(const std::vector<LitPoint>& points, const std::vector<Double3>& gathered,
                      bool with_near_lamps);

} // namespace hearth::reference

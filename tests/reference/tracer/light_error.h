// Measures the error of the light gathered from bricks, at points on the surfaces of a scene.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/light/face_lighting.h"
#include "formats/gpu_shared/brick_lighting.h"
#include "tests/reference/tracer/irradiance.h"

#include <vector>

namespace hearth::reference
{

/// A surface point and the direction to its viewer.
struct SeenPoint
{
    ShadedPoint point;
    Double3 to_eye; ///< unit
};

/// A surface point with the true light that arrives there.
struct LitPoint
{
    SeenPoint seen;
    SurfaceLight truth;
    Double3 halves[2]; ///< indirect light by either half of the paths
    bool near_lamp =
        false; ///< within kNearLamp of a lamp, or of a surface that shines and is seen from there
};

/// Metres; a point within this distance of a lamp is near it.
inline constexpr double kNearLamp = 0.15;

/// Choose points that are visible from the scene's cameras in all directions. Without cameras, choose points
/// that are visible from straight above, except at the rim.
std::vector<SeenPoint> seenPoints(const ShadedScene& scene, const formats::PackView& pack, uint32_t count);

std::vector<LitPoint> litPoints(const ShadedScene& scene, const std::vector<SeenPoint>& points,
                                uint32_t paths);

/// Lights and sky of the reference in the form that shaders take.
shared::SceneLighting sharedLighting(const SceneLighting& lighting);

/// Light of the bricks, swept until it hardly changes, and the gather from it.
class BrickGather
{
public:
    /// bricks  tables must outlive the object
    /// rays    for each face
    BrickGather(const bricks::BrickView& bricks, const shared::SceneLighting& lighting, uint32_t rays);

    /// Irradiance over pi from all but the lights, gathered as in the runtime. rays  for the point
    Double3 at(const SeenPoint& point, uint32_t rays, uint32_t seed) const;

private:
    bricks::FaceLighting faces_;
    shared::Sky sky_;
};

/// Root mean square of differences over the mean of the truth. A squared difference is the product of the
/// differences from either half of the paths, whose noise is independent: its mean has no noise term.
struct LightError
{
    double whole = 0;       ///< over the mean of all light: its direct part has no error
    double indirect = 0;    ///< over the mean of the indirect part
    double bias = 0;        ///< mean difference over the mean of the indirect part
    double uncertainty = 0; ///< standard error of `whole`, from the choice of points and the noise of paths
    size_t points = 0;
};

/// Root mean square of the paths' noise over the mean of all light.
double pathNoise(const std::vector<LitPoint>& points);

/// gathered  one for each point
LightError lightError(const std::vector<LitPoint>& points, const std::vector<Double3>& gathered,
                      bool with_near_lamps);

} // namespace hearth::reference

// Lights and sky of a scene, from the rules in runtime/gpu/README.md and KHR_lights_punctual.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "tests/reference/double3.h"
#include "tests/reference/tracer/sky_map.h"

#include <memory>
#include <optional>
#include <vector>

namespace hearth::reference
{

/// Light that arrives at a point from one light source.
struct Incident
{
    Double3 to_light;   ///< unit
    double distance;    ///< metres; infinite for the sun
    Double3 irradiance; ///< on a surface that faces the light
    bool casts_shadows = true;
};

struct SceneLight
{
    formats::LightType type;
    Double3 position, direction; ///< world space; the direction is the emission axis, unit
    Double3 intensity;           ///< candela or lux, after exposure
    double range;                ///< metres; 0: unlimited
    double cos_inner, cos_outer;
    bool casts_shadows = true; ///< false: surfaces do not block it, as those of a renderer without a map

    Incident at(Double3 point) const;
};

struct SceneLighting
{
    Double3 zenith, horizon, ground;
    std::vector<SceneLight> lights;
    double exposure = 1;                     ///< of emission; the intensities of lights have it already
    std::shared_ptr<const SkyMap> sky_map{}; ///< in place of the three colours; for paths alone

    /// Radiance of the sky from a direction.
    Double3 radiance(Double3 direction) const;
    /// Irradiance over pi of a surface with this normal, under the open sky.
    Double3 irradiance(Double3 normal) const;
    /// Mean radiance over the directions within an angle of an axis.
    Double3 coneRadiance(Double3 axis, double cos_half_angle) const;
};

/// Read the lights, and the sky: if the pack has the probe of one, the cube that the camera sees.
/// flicker_seconds  time of the lights' flicker, which exposure does not follow; none: they are steady
SceneLighting readLighting(const formats::PackView& view, std::optional<double> flicker_seconds = {});

} // namespace hearth::reference

// The lights and the sky of a scene, from the rules in runtime/gpu/README.md and KHR_lights_punctual.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "tests/reference/double3.h"

#include <vector>

namespace hearth::reference
{

/// What a light does to a point.
struct Incident
{
    Double3 to_light;   ///< unit
    double distance;    ///< metres; infinite for the sun
    Double3 irradiance; ///< on a surface that faces it
};

struct SceneLight
{
    formats::LightType type;
    Double3 position, direction; ///< world; the direction it shines in, unit
    Double3 intensity;           ///< candela or lux, exposed
    double range;                ///< metres; 0: unlimited
    double cos_inner, cos_outer;

    Incident at(Double3 point) const;
};

struct SceneLighting
{
    Double3 zenith, horizon, ground;
    std::vector<SceneLight> lights;

    /// Radiance of the sky as a surface of this roughness mirrors it; 0.4 is the background.
    Double3 radiance(Double3 direction, double roughness) const;
    /// Irradiance over pi of a surface with this normal.
    Double3 irradiance(Double3 normal) const;
};

SceneLighting lightingOf(const formats::PackView& view);

} // namespace hearth::reference

// The sky that lights every scene (formats/gpu_shared/sky.h). Needs the lighting block, which holds the
// radiances; the including file includes it before.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/light_cone.h"
#include "formats/gpu_shared/sky.h"

// texels (height, half-angle): means over cones
layout(set = kSetScene, binding = kSceneSkyTable) uniform mediump sampler2D sky_table;

Sky sceneSky() { return Sky(lighting.sky_zenith, lighting.sky_horizon, lighting.sky_ground); }

// Mean radiance over a cone.
mediump vec3 skyConeRadiance(LightCone cone)
{
    const mediump vec2 nodes = vec2(kSkyTableHeights, kSkyTableAngles);
    mediump vec2 at = (skyTableCoordinates(cone.axis.y, cone.cos_half_angle) * (nodes - 1.0) + 0.5) / nodes;
    return skyMeanRadiance(sceneSky(), textureLod(sky_table, at, 0.0).rg); // one mip
}

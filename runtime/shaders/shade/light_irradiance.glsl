// Light of a lamp or sun at a point, before shadows. Needs formats/gpu_shared/shading.h, `view` and
// `reflectedShare`.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/receivers/receiver_rows.h"
#include "formats/gpu_shared/record_values.h"

// Intensity that what surrounds a lamp adds to the lamp's, as a share. from_lamp: unit.
vec3 reflectedShare(Light light, vec3 from_lamp);

// True if the atlas of receivers has the light of a lamp: surfaces that it lights leave the lamp out.
bool isBaked(Light light) { return (light.reflector_axis & kLightBaked) != 0u; }

// Irradiance of a light on a surface that faces it, and the direction to the light. KHR_lights_punctual.
vec3 lightIrradiance(Light light, vec3 position, out vec3 to_light)
{
    if (light.type == kLightDirectional)
    {
        to_light = -light.direction;
        return light.intensity;
    }
    vec3 offset = (light.position - view.eye) - position;
    float distance2 = max(dot(offset, offset), 1e-8);
    to_light = offset * inversesqrt(distance2);
    float attenuation = 1.0 / distance2;
    if (light.range > 0.0)
    {
        float ratio2 = distance2 / (light.range * light.range);
        attenuation *= clamp(1.0 - ratio2 * ratio2, 0.0, 1.0);
    }
    vec3 share = vec3(1.0);
    if (light.type == kLightSpot)
    {
        mediump float cone = clamp(dot(light.direction, -to_light) * light.cone_scale + light.cone_offset, 0.0, 1.0);
        share = vec3(cone * cone);
    }
    share += reflectedShare(light, -to_light);
    return light.intensity * share * attenuation;
}

// Light of lamps and suns at a pixel, which passes ahead of shading have summed, weighed by its material.
// Include behind shading.glsl.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/shaders/shade/light_inputs.glsl"

layout(input_attachment_index = kFirstLightInput, set = kSetAttachments, binding = kAttachmentLight)
    uniform subpassInput diffuse_light;

#ifdef HEARTH_JOINED_SUMS
#include "runtime/shaders/prepass/specular_luminance.glsl"

// Radiance towards the eye. The colour of specular light is that of diffuse light, and no share of it grows
// towards grazing angles.
vec3 summedLight(Shading s)
{
    vec4 sums = subpassLoad(diffuse_light);
    vec3 specular = sums.rgb * (sums.a / max(specularLuminance(sums.rgb), 1e-6));
    return s.albedo.diffuse / kPi * sums.rgb + s.albedo.scattering * s.albedo.f0 * specular;
}
#else
layout(input_attachment_index = kFirstLightInput + 1u, set = kSetAttachments, binding = kAttachmentLight + 1u)
    uniform subpassInput specular_light;
layout(input_attachment_index = kFirstLightInput + 2u, set = kSetAttachments, binding = kAttachmentLight + 2u)
    uniform subpassInput grazing_light;

// Radiance towards the eye.
vec3 summedLight(Shading s)
{
    // sums may have left the range of a half
    vec3 diffuse = min(subpassLoad(diffuse_light).rgb, 65504.0);
    vec3 specular = min(subpassLoad(specular_light).rgb, 65504.0);
    vec3 grazing = min(subpassLoad(grazing_light).rgb, 65504.0);
    return s.albedo.diffuse / kPi * diffuse +
           s.albedo.scattering * (s.albedo.f0 * specular + s.albedo.f90 * grazing);
}
#endif

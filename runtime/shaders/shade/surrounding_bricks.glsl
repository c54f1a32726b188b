// Environment light of scenes with bricks (GI): the gathered light, which includes the sky. In place of
// surrounding_sky.glsl.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/reflector.h"
#include "runtime/shaders/gi/sample_gi.glsl"

// Occlusion by detail finer than the bricks: leaves and blades, several in a voxel. Returns the sky share of
// the cone over the sky share that the bricks leave. Elsewhere the gather knows more than cones do: those of
// vertices cannot follow a shadow across a wall, and would take light away that its bricks have not.
mediump float fineOcclusion(SurfacePoint point, vec3 normal, mediump float sky_share)
{
    if (!kSkyVisibility || material.alpha_mode == kAlphaOpaque)
        return 1.0;
    return openShare(diffuseSky(skyView(point, normal, kTextureNormal)), sky_share);
}

vec3 reflectedShare(Light light, vec3 from_lamp)
{
    return reflectorShare(light, from_lamp);
}

vec3 surroundingLight(SurfacePoint point, Shading shading, Layers layers, mediump float occlusion)
{
    GiSample light = sampleGi(gl_FragCoord.xy, point.position, shading.normal, shading.roughness);
    mediump float fine = min(occlusion, fineOcclusion(point, shading.normal, light.sky));
    if (point.received.is_known) // which has all occlusion
    {
        light.diffuse = point.received.mean_radiance;
        fine = 1.0;
    }
    vec3 radiance = fine * shading.albedo.diffuse * light.diffuse + occlusion * shading.albedo.specular * light.mirror;
    if (hasLayer(kLayerSheen))
        radiance = addSheen(layers, radiance, fine * light.diffuse);
    if (hasLayer(kLayerClearcoat))
    {
        GiSample coat = sampleGi(gl_FragCoord.xy, point.position, layers.coat_normal, layers.coat_roughness);
        radiance = addCoat(layers, radiance, occlusion * coat.mirror);
    }
    return radiance;
}

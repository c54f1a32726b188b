// Environment light of scenes with bricks (GI): the gathered light, which includes the sky. In place of
// surrounding_sky.glsl.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/shaders/gi/sample_gi.glsl"

// Margin added to the openness of the cone and to the sky share of the bricks. Where both see next to no sky
// the cone has no say.
const float kOpenMargin = 0.1;

// Occlusion by detail finer than the bricks. Bricks occlude at distances above a voxel or two; cones know
// finer shape. Returns the sky share of the cone over the sky share that the bricks leave.
float fineOcclusion(SurfacePoint point, vec3 normal, float sky_share)
{
    if (!kSkyVisibility)
        return 1.0;
    return min((diffuseSky(skyView(point, normal)) + kOpenMargin) / (sky_share + kOpenMargin), 1.0);
}

vec3 surroundingLight(SurfacePoint point, Shading shading, float occlusion)
{
    GiSample light = sampleGi(gl_FragCoord.xy, point.position, shading.normal, shading.roughness);
    float fine = min(occlusion, fineOcclusion(point, shading.normal, light.sky));
    return fine * shading.albedo.diffuse * light.diffuse + occlusion * shading.albedo.specular * light.mirror;
}

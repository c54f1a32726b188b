// As surrounding_sky.glsl, of scenes with bricks: what was gathered through them, the sky with it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/shaders/gi/gathered.glsl"

// What a cone is open, and what the bricks leave of it, count as so much more: where both see next to no sky the cone says
// nothing.
const float kOpenMargin = 0.1;

// Bricks hide what is farther than a voxel or two; cones know finer form. How much a point loses by that: what its cone
// sees of the sky over what the bricks let it see.
float fineOcclusion(SurfacePoint point, vec3 normal, float sky_share)
{
    if (!kSkyVisibility)
        return 1.0;
    return min((diffuseSky(skyView(point, normal)) + kOpenMargin) / (sky_share + kOpenMargin), 1.0);
}

vec3 surroundingLight(SurfacePoint point, Shading shading, float occlusion)
{
    vec2 scale_bias = specularScaleBias(shading.roughness, shading.n_dot_v);
    vec3 specular = shading.f0 * scale_bias.x + scale_bias.y;
    GatheredLight light = gatheredLight(gl_FragCoord.xy, point.position, shading.normal, shading.roughness);
    float fine = min(occlusion, fineOcclusion(point, shading.normal, light.sky));
    return fine * (1.0 - specular) * shading.diffuse * light.diffuse + occlusion * specular * light.mirror;
}

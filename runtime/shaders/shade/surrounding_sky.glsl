// What a point gets from its surroundings beside the lights: the sky, as far as the point's visibility lets it through.
// After lighting.glsl.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided

vec3 surroundingLight(SurfacePoint point, Shading shading, float occlusion)
{
    vec2 scale_bias = specularScaleBias(shading.roughness, shading.n_dot_v);
    vec3 specular = shading.f0 * scale_bias.x + scale_bias.y;
    vec3 mirror = reflect(-shading.to_eye, shading.normal);
    vec3 diffuse_sky = (1.0 - specular) * shading.diffuse * skyIrradiance(shading.normal);
    vec3 specular_sky = specular * skyRadiance(mirror, shading.roughness);
    if (!kSkyVisibility)
        return occlusion * (diffuse_sky + specular_sky);
    // The smaller counts: a texture is usually baked from the same form and would hide the sky twice; what it has beyond
    // that, fine form that the mesh lacks, is where it says less.
    SkyView sky = skyView(point, shading.normal);
    return min(occlusion, diffuseSky(sky)) * diffuse_sky +
           min(occlusion, specularSky(sky, shading.roughness, shading.n_dot_v, mirror)) * specular_sky;
}

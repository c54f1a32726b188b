// Environment light without bricks: the sky, occluded by the visibility of the point. Include after
// lighting.glsl.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided

vec3 surroundingLight(SurfacePoint point, Shading shading, float occlusion)
{
    vec3 mirror = reflect(-shading.to_eye, shading.normal);
    vec3 diffuse_sky = shading.albedo.diffuse * skyIrradiance(shading.normal);
    vec3 specular_sky = shading.albedo.specular * skyRadiance(mirror, shading.roughness);
    if (!kSkyVisibility)
        return occlusion * (diffuse_sky + specular_sky);
    // The smaller one counts. An occlusion texture is usually baked from the same shape and would occlude the
    // sky twice. The texture is smaller only where it has detail that the mesh lacks.
    SkyView sky = skyView(point, shading.normal);
    return min(occlusion, diffuseSky(sky)) * diffuse_sky +
           min(occlusion, specularSky(sky, shading.roughness, shading.n_dot_v, mirror)) * specular_sky;
}

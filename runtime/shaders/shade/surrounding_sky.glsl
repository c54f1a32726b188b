// Environment light without bricks: the sky, of which a point sees what its visibility leaves. Include after
// lighting.glsl.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided

vec3 surroundingLight(SurfacePoint point, Shading shading, float occlusion)
{
    vec3 mirror = reflect(-shading.to_eye, shading.normal);
    LightCone diffuse = cosineCone(shading.normal);
    LightCone specular = lobeCone(shading.lobe, mirror, shading.normal);
    float diffuse_share = occlusion;
    float specular_share = occlusion;
    if (kSkyVisibility)
    {
        // The smaller share counts. An occlusion texture is usually baked from the same shape and would
        // occlude the sky twice. The texture is smaller only where it has detail that the mesh lacks.
        SkyView sky = skyView(point, shading.normal);
        diffuse_share = min(occlusion, diffuseSky(sky));
        specular_share = min(occlusion, specularSky(sky, shading.roughness, shading.n_dot_v, mirror));
        diffuse = visibleDiffuseCone(sky, shading.normal, diffuse);
        specular = visibleSpecularCone(sky, specular);
    }
    return diffuse_share * shading.albedo.diffuse * skyConeRadiance(diffuse) +
           specular_share * shading.albedo.specular * skyConeRadiance(specular);
}

// Environment light without bricks: probes within the scene, and elsewhere the sky, of which a point
// sees what its visibility leaves, and what occludes the rest. Include after lighting.glsl.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/shaders/shade/local_probes.glsl"

// Without bricks nothing around a lamp gives light back.
vec3 reflectedShare(Light light, vec3 from_lamp)
{
    return vec3(0.0);
}

// Light of the sky and of its occluders that a lobe reflects, per albedo.
// mirror   reflection of the view direction at the normal of the lobe
// open     cone of the lobe under an open sky
// diffuse  mean radiance of the diffuse part
mediump vec3 mirroredSky(SkyView sky, OccluderLight occluders, LightCone open, vec3 mirror, mediump float roughness,
                         mediump float n_dot_v, mediump vec3 diffuse, mediump float occlusion)
{
    if (!kSkyVisibility)
        return occlusion * skyMirror(open, open, roughness, n_dot_v, diffuse);
    mediump float share = min(occlusion, specularSky(sky, roughness, n_dot_v, mirror));
    return share * skyMirror(visibleSpecularCone(sky, open), open, roughness, n_dot_v, diffuse) + specularOccluders(occluders, open, share);
}

vec3 skyLight(SurfacePoint point, Shading shading, Layers layers, mediump float occlusion)
{
    vec3 mirror = reflect(-shading.to_eye, shading.normal);
    LightCone diffuse = cosineCone(shading.normal);
    SkyView sky = skyView(point, shading.normal, kTextureNormal);
    OccluderLight occluders = kNoOccluderLight;
    mediump float diffuse_share = occlusion;
    mediump vec3 occluded = vec3(0.0);
    if (kSkyVisibility)
    {
        // The smaller share counts. An occlusion texture is usually baked from the same shape and would
        // occlude the sky twice. The texture is smaller only where it has detail that the mesh lacks.
        diffuse_share = min(occlusion, diffuseSky(sky));
        diffuse = visibleDiffuseCone(sky, shading.normal, diffuse);
        occluders = occluderLight(point.instance);
        occluded = diffuseOccluders(occluders, sky, diffuse_share);
    }
    LightCone specular = skyLobeCone(shading.lobe, mirror, shading.normal, shading.roughness, shading.n_dot_v);
    mediump vec3 seen = skyDiffuse(diffuse);
    mediump vec3 arriving = diffuse_share * seen + occluded;
    if (point.received.is_known)
        arriving = point.received.mean_radiance;
    mediump vec3 radiance = shading.albedo.diffuse * arriving +
                    shading.albedo.specular * mirroredSky(sky, occluders, specular, mirror, shading.roughness,
                                                          shading.n_dot_v, seen, occlusion);
    if (hasLayer(kLayerSheen))
    {
        // a lobe as wide as the hemisphere is occluded as much as the diffuse part
        LightCone open = sheenCone(layers.sheen, shading.to_eye, shading.normal);
        if (kSkyVisibility)
            open = visibleSpecularCone(sky, open);
        if (!point.received.is_known)
            arriving = diffuse_share * skyDiffuse(open) + occluded;
        radiance = addSheen(layers, radiance, arriving);
    }
    if (hasLayer(kLayerClearcoat))
    {
        vec3 normal = layers.coat_normal;
        vec3 coat_mirror = reflect(-shading.to_eye, normal);
        LightCone open = skyLobeCone(layers.coat_lobe, coat_mirror, normal, layers.coat_roughness,
                                     layers.coat_n_dot_v);
        SkyView coat_sky = skyView(point, normal, kTextureClearcoatNormal);
        radiance = addCoat(layers, radiance,
                           mirroredSky(coat_sky, occluders, open, coat_mirror, layers.coat_roughness,
                                       layers.coat_n_dot_v, seen, occlusion));
    }
    return radiance;
}

vec3 surroundingLight(SurfacePoint point, Shading shading, Layers layers, mediump float occlusion)
{
    if (!kLocalProbes)
        return skyLight(point, shading, layers, occlusion);
    vec4 probes = sumLocalProbes(point, shading, layers, occlusion);
    if (probes.a < 1.0)
        probes.rgb += (1.0 - probes.a) * skyLight(point, shading, layers, occlusion);
    return probes.rgb;
}

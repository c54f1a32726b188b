// Light of probes within the scene (formats/gpu_shared/probes/local_probes.h), which takes the place of the
// sky around them. Include after sky.glsl and sky_occlusion.glsl.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/probes/local_probes.h"

layout(constant_id = kConstantLocalProbes) const bool kLocalProbes = false;

// light over LocalProbe::irradiance; its largest texel is beyond mediump
layout(set = kSetScene, binding = kSceneSpecularTable) uniform sampler2D probe_atlas;

LocalProbe localProbe(uint row)
{
    vec4 head[kFirstProbeHarmonic];
    for (uint i = 0u; i < kFirstProbeHarmonic; ++i)
        head[i] = uintBitsToFloat(light_rows[row + i]);
    return LocalProbe(head[0].xyz, head[0].w, head[1].xyz, floatBitsToUint(head[1].w), head[2].xyz, head[2].w,
                      head[3].xyz, head[3].w, head[4].xyz, head[4].w, head[5]);
}

vec3 probeIrradiance(LocalProbe probe) { return vec3(probe.irradiance_red, probe.irradiance_green, probe.irradiance_blue); }

mediump vec3 probeHarmonic(uint row, uint i) { return uintBitsToFloat(light_rows[row + kFirstProbeHarmonic + i].xyz); }

// Luminance of the mean radiance over a wide cone, with that of lamps, which no texel has.
mediump float probeLitConeLuminance(uint row, LightCone cone)
{
    vec3 sums[9];
    for (uint i = 0u; i < 9u; ++i)
        sums[i] = vec3(uintBitsToFloat(light_rows[row + kFirstProbeHarmonic + i].w));
    RadianceHarmonics harmonics =
        RadianceHarmonics(sums[0], sums[1], sums[2], sums[3], sums[4], sums[5], sums[6], sums[7], sums[8]);
    return harmonicConeRadiance(harmonics, cone.axis, cone.cos_half_angle).x;
}

// Mean radiance over a wide cone.
mediump vec3 probeConeRadiance(uint row, LightCone cone)
{
    RadianceHarmonics harmonics = RadianceHarmonics(
        probeHarmonic(row, 0u), probeHarmonic(row, 1u), probeHarmonic(row, 2u), probeHarmonic(row, 3u),
        probeHarmonic(row, 4u), probeHarmonic(row, 5u), probeHarmonic(row, 6u), probeHarmonic(row, 7u),
        probeHarmonic(row, 8u));
    return harmonicConeRadiance(harmonics, cone.axis, cone.cos_half_angle);
}

// Radiance of a mip, from the point of the box that a direction from the probe meets.
vec3 probeMip(LocalProbe probe, CubePlace place, uint mip)
{
    vec2 at = probeAtlasPoint(place, lighting.local_probe_side, mip, probe.atlas_row);
    return textureLod(probe_atlas, at / vec2(textureSize(probe_atlas, 0)), 0.0).rgb;
}

// Radiance that a lobe sees: as skyMirror of the image of a sky, from the box around the probe.
// diffuse  mean radiance of the diffuse part
mediump vec3 probeMirror(LocalProbe probe, uint row, vec3 position, vec3 mirror, vec3 normal, mediump float roughness,
                         mediump float n_dot_v, mediump vec3 diffuse)
{
    SkyLobe lobe = skyLobe(roughness, n_dot_v);
    vec3 axis = normalize(mirror * (1.0 - lobe.turn) + normal * lobe.turn);
    CubePlace place = findCubePlace(correctParallax(probe, position, axis));
    uint last = lighting.local_probe_mips - 1u;
    float lod = float(last) * lobe.roughness * (2.0 - lobe.roughness); // formats/records/probe.h
    uint mip = min(uint(lod), last - 1u);
    vec3 narrow = mix(probeMip(probe, place, mip), probeMip(probe, place, mip + 1u), lod - float(mip));
    mediump vec3 wide = mix(diffuse, 0.28209479 * probeHarmonic(row, 0u), lobe.even);
    return mix(min(narrow, kMaxMirrorRadiance), wide, lobe.wide);
}

// Light of one probe that a surface reflects. What the probe sees is part of its light: of the cones of
// visibility counts only what they hide beyond that. A surface with baked light has all occlusion in it, and
// what it reflects follows its lamps; elsewhere it follows the weights of the lamps around the probe.
vec3 probeLight(LocalProbe probe, uint row, SurfacePoint point, Shading shading, Layers layers,
                mediump float occlusion)
{
    vec3 position = point.position + view.eye;
    vec3 mirror = reflect(-shading.to_eye, shading.normal);
    mediump float diffuse_share = occlusion;
    mediump float mirror_share = occlusion;
    if (kSkyVisibility && !point.received.is_known)
    {
        SkyView sky = skyView(point, shading.normal, kTextureNormal);
        diffuse_share = min(occlusion, openShare(diffuseSky(sky), probeSkyShare(probe, shading.normal)));
        mirror_share = min(occlusion, openShare(specularSky(sky, shading.roughness, shading.n_dot_v, mirror),
                                                probeSkyShare(probe, mirror)));
    }
    LightCone hemisphere = cosineCone(shading.normal);
    mediump vec3 own = probeConeRadiance(row, hemisphere);
    mediump float own_luminance = luminance(own);
    vec3 irradiance = probeIrradiance(probe);
    mediump vec3 diffuse = irradiance * own; // irradiance / pi at the surface, before occlusion
    vec3 factor = irradiance * localProbeFactor(kPi * own_luminance, kPi * own_luminance);
    if (point.received.is_known)
    {
        diffuse = point.received.mean_radiance;
        diffuse_share = 1.0;
        vec3 color = irradiance / max(luminance(irradiance), 1e-20);
        factor = color * localProbeFactor(kPi * luminance(diffuse), kPi * probeLitConeLuminance(row, hemisphere));
    }
    vec3 radiance = shading.albedo.diffuse * (diffuse_share * diffuse) +
                    shading.albedo.specular * (mirror_share * factor *
                        probeMirror(probe, row, position, mirror, shading.normal, shading.roughness,
                                    shading.n_dot_v, own));
    if (hasLayer(kLayerSheen))
    {
        LightCone open = sheenCone(layers.sheen, shading.to_eye, shading.normal);
        radiance = addSheen(layers, radiance, diffuse_share * factor * probeConeRadiance(row, open));
    }
    if (hasLayer(kLayerClearcoat))
    {
        vec3 coat_mirror = reflect(-shading.to_eye, layers.coat_normal);
        radiance = addCoat(layers, radiance,
                           mirror_share * factor *
                               probeMirror(probe, row, position, coat_mirror, layers.coat_normal,
                                           layers.coat_roughness, layers.coat_n_dot_v, own));
    }
    return radiance;
}

// Light of the probes around a point that its surface reflects (rgb), and the sum of their weights (a):
// above 1 the light is a weighted mean.
vec4 sumLocalProbes(SurfacePoint point, Shading shading, Layers layers, mediump float occlusion)
{
    vec3 position = point.position + view.eye;
    vec4 sum = vec4(0.0);
    for (uint i = 0u; i < lighting.local_probe_count; ++i)
    {
        uint row = lighting.local_probe_row + i * kLocalProbeRows;
        LocalProbe probe = localProbe(row);
        float weight = localProbeWeight(probe, position);
        if (weight > 0.0)
            sum += weight * vec4(probeLight(probe, row, point, shading, layers, occlusion), 1.0);
    }
    return vec4(sum.rgb / max(sum.a, 1.0), sum.a);
}

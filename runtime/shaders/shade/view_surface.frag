// Debug views of surface data: clusters, LOD levels, triangles, materials, bones, normals, depth, sky
// visibility, lists of lights and receivers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/decisions.h"
#include "formats/gpu_shared/shading.h"
#include "runtime/shaders/scene/scene.glsl"
#include "runtime/shaders/scene/material.glsl"
#include "runtime/shaders/scene/surface_point.glsl"
#include "runtime/shaders/scene/resolve.glsl"
#include "runtime/shaders/scene/light_block.glsl"
#include "runtime/shaders/scene/to_eye.glsl"
#include "runtime/shaders/scene/visibility_input.glsl"
#include "runtime/shaders/scene/material_test.glsl"
#include "runtime/shaders/shade/image_color.glsl"
#include "runtime/shaders/shade/tonemap.glsl"
#include "runtime/shaders/shade/sky_occlusion.glsl"
#include "runtime/shaders/shade/light_list.glsl"
#include "runtime/shaders/shade/material_values.glsl"
#include "runtime/shaders/scene/receivers.glsl"

layout(early_fragment_tests) in;
layout(location = 0) out vec4 out_color;

// Map a number to a colour that differs much between neighbouring numbers.
vec3 hashColor(uint number)
{
    uint h = number * 2654435761u; // Knuth's multiplicative hash
    h ^= h >> 15;
    h *= 2246822519u;
    h ^= h >> 13;
    return 0.25 + 0.75 * vec3(h & 255u, h >> 8 & 255u, h >> 16 & 255u) / 255.0;
}

vec3 levelColor(uint level)
{
    // red for the source triangles, over yellow, green and blue to violet at level 12 and coarser
    float hue = min(float(level), 12.0) / 12.0 * 0.8;
    return clamp(abs(fract(hue + vec3(0.0, 2.0 / 3.0, 1.0 / 3.0)) * 6.0 - 3.0) - 1.0, 0.0, 1.0);
}

vec3 boneColor(Surface s)
{
    if (!isDeformed(s))
        return vec3(0.4);
    return hashColor(loadDeformedCluster(loadPose(s.pose.row), s.slot.cluster).joint + 1u);
}

// From black for none over blue for 1, green for 4, yellow for 8 and red for 16 to white for 32 and more.
vec3 countColor(uint count)
{
    const vec3 colors[] = vec3[](vec3(0.0), vec3(0.1, 0.1, 0.5), vec3(0.1, 0.4, 0.7), vec3(0.1, 0.7, 0.3), vec3(0.9, 0.8, 0.1), vec3(0.9, 0.15, 0.1), vec3(1.0));
    float at = min(log2(float(count) + 1.0) * 1.2, 5.999);
    uint color = uint(at);
    return mix(colors[color], colors[color + 1u], at - float(color));
}

vec3 lightColor(Surface s)
{
    if (push.debug_view == kViewLightCount)
    {
        LightListing listing = findLights(s.position, gl_FragCoord.xy, s.slot_number);
        return countColor(listing.count - listing.unranged_count);
    }
    float depth = dot(view.clip_w.xyz, s.position);
    return hashColor(lightCellAt(lighting.cascades[lightCascadeAt(depth)], gl_FragCoord.x, gl_FragCoord.y, depth));
}

// Irradiance of the atlas on white, with its texels as a checkerboard. Violet: the pixel has none.
vec3 receivedColor(Surface s, float facing)
{
    const vec3 none = vec3(0.16, 0.02, 0.22);
    if (!kReceivers)
        return none * facing;
    ReceiverRow row = receiverRow(s.slot.instance);
    if (!isReceiver(row, s))
        return none * facing;
    vec2 texel = surfaceReceiverTexel(row, s);
    uvec2 number = uvec2(texel);
    return toneMap(sampleReceivers(texel) / kVisibilityPi) * (((number.x ^ number.y) & 1u) == 0u ? 1.0 : 0.75);
}

bool isSkyView(uint debug_view)
{
    return debug_view == kViewAmbientOcclusion || debug_view == kViewBentNormal || debug_view == kViewAperture ||
           debug_view == kViewSpecularOcclusion;
}

// Colour of the sky visibility. Dark red: the mesh has none.
vec3 skyVisibilityColor(Surface s)
{
    if (!kSkyVisibility || (s.draw.vertex_layout & kVertexVisibility) == 0u)
        return vec3(0.35, 0.05, 0.05);
    SurfacePoint point = surfacePoint(s);
    MaterialValues values = materialValues(point, surfaceUvs(s), point.color);
    vec3 normal = values.normal;
    SkyView sky = skyView(point, normal, kTextureNormal);
    if (push.debug_view == kViewAmbientOcclusion)
        return vec3(diffuseSky(sky));
    if (push.debug_view == kViewBentNormal)
        return sky.cone.axis * 0.5 + 0.5;
    if (push.debug_view == kViewAperture)
        return vec3(sky.cone.aperture * (2.0 / kVisibilityPi));
    vec3 to_eye = normalizeOr(toEye(point.position), normal);
    return vec3(specularSky(sky, values.roughness, clampedCosine(normal, to_eye), reflect(-to_eye, normal)));
}

void main()
{
    uint id = loadVisibility();
    if (isForeign(id))
        discard;
    Surface s = resolveSurface(id, gl_FragCoord.xy);
    // dimmed by the angle to the eye, so that the shape is visible
    float facing = 0.35 + 0.65 * abs(dot(geometricNormal(s), normalizeOr(toEye(s.position), vec3(0.0))));
    vec3 color;
    if (push.debug_view == kViewReceivers)
    {
        out_color = vec4(imageColor(receivedColor(s, facing)), 1.0);
        return;
    }
    if (push.debug_view == kViewClusters)
        color = facing * hashColor(s.slot.cluster * 7919u + s.slot.instance);
    else if (push.debug_view == kViewLod)
        color = facing * (0.15 + 0.85 * levelColor(clusterLevel(s.draw)));
    else if (push.debug_view == kViewTriangles)
        color = facing * hashColor((s.slot.cluster * 128u + s.triangle) * 31u + s.slot.instance);
    else if (push.debug_view == kViewMaterials)
        color = facing * hashColor(s.draw.material);
    else if (push.debug_view == kViewBones)
        color = facing * boneColor(s);
    else if (isSkyView(push.debug_view))
        color = skyVisibilityColor(s);
    else if (push.debug_view == kViewLightCount || push.debug_view == kViewLightCells)
        color = (0.5 + 0.5 * facing) * lightColor(s);
    else if (push.debug_view == kViewNormals)
        color = materialValues(surfacePoint(s), surfaceUvs(s), vec3(1.0)).normal * 0.5 + 0.5;
    else
        color = vec3(push.depth_scale / (push.depth_scale + s.distance_w));
    out_color = vec4(imageColor(linearFromSrgb(color)), 1.0);
}

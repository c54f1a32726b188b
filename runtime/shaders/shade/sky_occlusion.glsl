// Sky occlusion from the visibility of a point: ambient occlusion for the diffuse part, specular occlusion
// for the reflection; and the light of occluders in place of the sky. Include after surface_point.glsl and
// light_block.glsl. formats/gpu_shared has the formulas, runtime/gpu/README.md the cost.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/ambient_occlusion.h"
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/instance_visibility.h"
#include "formats/gpu_shared/light_cone.h"
#include "formats/gpu_shared/occluder_light.h"
#include "runtime/shaders/scene/shading_push.glsl"
#include "formats/gpu_shared/specular_occlusion.h"

// 16 x 16 texels (aperture, roughness); squares for the nodes of beta below each other; white in scenes
// without a table
layout(set = kSetScene, binding = kSceneSpecularTable) uniform mediump sampler2D specular_table;

// Margin added to both shares of the sky, below. Where both see next to no sky the cone has no say.
const float kOpenMargin = 0.1;

// Visibility cone of a point, and its angles to the normals.
struct SkyView
{
    VisibilityCone cone;
    mediump float geometric; // cosine between the axis and the normal that the cone was baked for
    mediump float shading;   // cosine between the axis and the shading normal
    mediump vec3 occluded;   // mean of the occluded directions
};

// normal  of the lobe that the sky lights
// slot    texture of the normal map that changes it
SkyView skyView(SurfacePoint point, vec3 normal, uint slot)
{
    vec3 geometric = point.front ? point.normal : -point.normal;
    SkyView sky;
    VisibilityMoments moments = changedVisibility(point.sky, geometric, instanceVisibility(point.instance));
    sky.cone = visibilityCone(moments.m0, moments.m1, geometric);
    sky.occluded = meanOccludedDirection(moments.m0, moments.m1, geometric);
    sky.geometric = dot(sky.cone.axis, geometric);
    // the same bits if no normal map changes the normal: the terms of both then cancel
    sky.shading = hasTexture(slot) ? dot(sky.cone.axis, normal) : sky.geometric;
    return sky;
}

mediump float diffuseSky(SkyView sky)
{
    return ambientOcclusion(push.sky_occlusion & 255u, sky.cone.scale, sky.cone.cos_aperture, sky.cone.aperture,
                            sky.geometric, sky.shading);
}

// Share of light that a cone leaves where the light itself knows what hides the sky, but for detail.
// visible  share of the sky, by the cone
// known    by the light
mediump float openShare(mediump float visible, mediump float known)
{
    return min((visible + kOpenMargin) / (known + kOpenMargin), 1.0);
}

mediump float specularTableShare(vec3 place)
{
    float beta = place.z * 15.0;
    float below = floor(beta);
    vec2 at = vec2(place.x * 15.0 + 0.5, place.y * 15.0 + 0.5 + 16.0 * below) / vec2(16.0, 256.0);
    // one mip: explicit, so that no derivative is needed
    mediump float first = textureLod(specular_table, at, 0.0).r;
    mediump float second = textureLod(specular_table, vec2(at.x, below < 15.0 ? at.y + 1.0 / 16.0 : at.y), 0.0).r;
    mediump float above = beta - below;
    return mix(first, second, above);
}

// mirror: reflection of the view direction at the shading normal, unit
mediump float specularSky(SkyView sky, float roughness, float n_dot_v, vec3 mirror)
{
    uint mode = push.sky_occlusion >> 8 & 255u;
    if (mode == kSpecularOcclusionOff)
        return 1.0;
    float r_dot_axis = dot(mirror, sky.cone.axis);
    float share = mode == kSpecularOcclusionTable
                      ? specularTableShare(specularTableCoordinates(sky.cone.cos_aperture, roughness, r_dot_axis,
                                                              push.sky_occlusion >> 16))
                      : specularOcclusionFit(sky.cone.cos_aperture, roughness, n_dot_v, sky.shading, r_dot_axis);
    return share * sky.cone.scale;
}

// Radiance that the occluders of the diffuse part give back, by the part of its light that they hide.
// share  of the sky that is visible
mediump vec3 diffuseOccluders(OccluderLight occluders, SkyView sky, mediump float share)
{
    if ((push.sky_occlusion & 255u) == kAmbientOcclusionOff)
        return vec3(0.0);
    return (1.0 - share) * occluderRadiance(occluders, sky.occluded);
}

// The same of a reflection.
// open  cone without occlusion
mediump vec3 specularOccluders(OccluderLight occluders, LightCone open, mediump float share)
{
    if ((push.sky_occlusion >> 8 & 255u) == kSpecularOcclusionOff)
        return vec3(0.0);
    mediump vec3 mean = open.axis * (0.5 + 0.5 * open.cos_half_angle);
    return (1.0 - share) * occluderRadiance(occluders, mean);
}

// Directions from which the visible light of the diffuse part comes.
// open  cone without occlusion
LightCone visibleDiffuseCone(SkyView sky, vec3 normal, LightCone open)
{
    if ((push.sky_occlusion & 255u) == kAmbientOcclusionOff)
        return open;
    return visibleCosineCone(sky.cone, normal);
}

// Directions from which the visible light of the reflection comes.
// open  cone without occlusion
LightCone visibleSpecularCone(SkyView sky, LightCone open)
{
    if ((push.sky_occlusion >> 8 & 255u) == kSpecularOcclusionOff)
        return open;
    return visibleLobeCone(open, sky.cone);
}

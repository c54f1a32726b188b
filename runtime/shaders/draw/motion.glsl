// Finds where what a pixel shows was in the frame before, in pixels from where it is. Shaders that include it
// define HEARTH_DISTANCES if they write distances as well.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/decisions.h"
#include "formats/gpu_shared/push_constants.h"
#include "formats/gpu_shared/shading.h"
#include "runtime/shaders/scene/scene.glsl"
#include "runtime/shaders/scene/material.glsl"
#include "runtime/shaders/scene/surface_point.glsl"
#include "runtime/shaders/scene/resolve.glsl"
#include "runtime/shaders/scene/pixel_ray.glsl"

layout(set = kSetMotionPixels, binding = kPixelsVisibility) uniform usampler2D visibility;
layout(push_constant) uniform Push { MotionPush push; };

layout(location = 0) out vec2 motion;
#ifdef HEARTH_DISTANCES
layout(location = 1) out vec2 distances; // in this frame, and in the one before
#endif

// Corner of the pixel's triangle in the frame before, relative to its eye.
vec3 earlierCorner(Surface s, uint corner)
{
    Instance instance = instances[push.first_instance + s.slot.instance];
    if (!isDeformed(s))
        return toEyeRelative(instance, push.eye, vertexPosition(s.draw, s.vertices[corner]));
    Pose pose = loadPose(s.pose.row);
    pose.palette_row += push.pose_rows;
    pose.morph_word += push.pose_rows * 4u;
    precise vec3 origin = vec3(instance.world_from_object_x.w - push.eye.x, instance.world_from_object_y.w - push.eye.y,
                               instance.world_from_object_z.w - push.eye.z);
    return posedPosition(s.draw, pose, s.indices[corner]) + origin;
}

void main()
{
    uint id = texelFetch(visibility, ivec2(gl_FragCoord.xy), 0).x;
    vec3 now = vec3(0.0), before = vec3(0.0);
    if (id == kVisibilitySky)
    {
        PixelRay ray = pixelRay(gl_FragCoord.xy);
        now = before = ray.origin + ray.along;
    }
    else
    {
        Surface s = resolveSurface(id, gl_FragCoord.xy);
        for (uint i = 0u; i < 3u; ++i)
        {
            now += s.corners[i] * s.weights[i];
            before += earlierCorner(s, i) * s.weights[i];
        }
    }
    vec4 clip = clipPosition(view, now);
    float earlier_distance = dot(push.clip_w.xyz, before);
    vec3 earlier = vec3(dot(push.clip_x.xyz, before), dot(push.clip_y.xyz, before),
                        push.clip_w.w != 0.0 ? 1.0 : earlier_distance);
    motion = vec2(kMotionUnseen);
    if (earlier.z > 0.0)
    {
        vec2 halves = earlier.xy / earlier.z - clip.xy / clip.w - vec2(push.clip_x.w, push.clip_y.w);
        motion = clamp(halves * 0.5 * vec2(view.width, view.height), -kMaxMotion, kMaxMotion);
    }
#ifdef HEARTH_DISTANCES
    bool is_sky = id == kVisibilitySky;
    distances = is_sky ? vec2(kMaxMotionDistance) : clamp(vec2(dot(view.clip_w.xyz, now), earlier_distance), 0.0, kMaxMotionDistance);
#endif
}

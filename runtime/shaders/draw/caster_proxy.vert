// Draws the proxies that cast shadows into a map, depth only. A chunk of triangles is an instance.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/shadows/proxy_casters.h"
#include "formats/gpu_shared/push_constants.h"
#include "formats/gpu_shared/record_values.h"
#include "runtime/shaders/draw/caster_triangle.glsl"

layout(set = kSetTables, binding = kTableInstances, std430) readonly buffer Instances { Instance instances[]; };
layout(set = kSetTables, binding = kTableShadows, std140) uniform Shadows { ShadowBlock shadows; };
layout(set = kSetTables, binding = kTableProxies, std430) readonly buffer Proxies { ProxyCaster proxies[]; };
layout(set = kSetTables, binding = kTableProxyChunks, std430) readonly buffer Chunks { ProxyChunk chunks[]; };
layout(set = kSetTables, binding = kTableProxyPositions, std430) readonly buffer Positions { float positions[]; };
layout(set = kSetTables, binding = kTableProxyIndices, std430) readonly buffer Indices { uint indices[]; };
layout(push_constant) uniform Push { BinPush push; };

vec3 proxyPosition(ProxyCaster proxy, uint corner)
{
    uint at = (proxy.first_position + indices[proxy.first_index + corner]) * 3u;
    return vec3(positions[at], positions[at + 1u], positions[at + 2u]);
}

void main()
{
    ProxyChunk chunk = chunks[gl_InstanceIndex];
    Instance instance = instances[chunk.instance];
    ProxyCaster proxy = proxies[instance.mesh];
    uint triangle = chunk.first_triangle + gl_VertexIndex / 3u;
    gl_Position = vec4(0.0, 0.0, 0.0, 1.0); // three of these form a triangle without area
    if (triangle >= proxy.triangle_count)
        return;
    ShadowLight light = shadows.lights[push.light_row];
    vec3 points[3];
    for (uint i = 0u; i < 3u; ++i)
        points[i] = toEyeRelative(instance, light.origin, proxyPosition(proxy, triangle * 3u + (gl_VertexIndex + i) % 3u));
    CasterTriangle placed = casterTriangle(light, points);
    bool is_mirrored = ((instance.flags & kInstanceMirrored) != 0u) != ((instance.flags & kInstanceHandednessChanged) != 0u);
    vec3 front = is_mirrored ? -placed.normal : placed.normal;
    bool is_closed = proxy.is_closed != 0u;
    float error = proxy.distance * instance.scale_max * (is_closed ? proxyOffsetShare(light, placed.middle, front) : 1.0);
    float share = is_closed ? shadowOffsetShare(light, placed.middle, front) : 1.0;
    gl_Position = casterClip(light, shadows.maps[push.map_index], placed, error, share);
}

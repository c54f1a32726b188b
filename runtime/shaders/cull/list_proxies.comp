// Lists the proxies that cast shadows into a map, one thread per instance: takes the instances whose mesh has
// one out of the clusters' culling. Their order does not matter, since a map keeps the nearest depth.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/shadows/proxy_casters.h"
#include "formats/gpu_shared/push_constants.h"

layout(local_size_x = kGroupProxies) in;

layout(set = kSetTables, binding = kTableInstances, std430) readonly buffer Instances { Instance instances[]; };
layout(set = kSetTables, binding = kTableStates, std430) buffer States { InstanceState states[]; };
layout(set = kSetTables, binding = kTableProxies, std430) readonly buffer Proxies { ProxyCaster proxies[]; };
layout(set = kSetTables, binding = kTableProxyDraw, std430) buffer Draw { ProxyDraw draw; };
layout(set = kSetTables, binding = kTableProxyChunks, std430) writeonly buffer Chunks { ProxyChunk chunks[]; };
layout(push_constant) uniform Push { ListProxiesPush push; };

void main()
{
    uint i = gl_GlobalInvocationID.y * (kMaxDispatchX * kGroupProxies) + gl_GlobalInvocationID.x;
    if (i >= push.instance_count || states[i].visible == kInstanceHidden)
        return;
    ProxyCaster proxy = proxies[instances[i].mesh];
    uint count = countProxyChunks(proxy);
    if (count == 0u)
        return;
    states[i].visible = kInstanceHidden;
    uint first = atomicAdd(draw.instance_count, count);
    atomicAdd(draw.triangle_count, proxy.triangle_count);
    for (uint chunk = 0u; chunk < count; ++chunk)
        chunks[first + chunk] = ProxyChunk(i, chunk * kProxyChunkTriangles);
}

// Proxies that cast the shadows of their meshes: their records, and the depth bias that keeps a surface out
// of the shadow of its own proxy. One source for C++ and GLSL. See runtime/gpu/README.md, "Shadows".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_PROXY_CASTERS_H
#define HEARTH_SHARED_PROXY_CASTERS_H

#include "formats/gpu_shared/shadow.h"

HEARTH_SHARED_BEGIN

/// Proxy that casts the shadow of a mesh.
struct ProxyCaster
{
    uint first_position; ///< among the positions of all proxies
    uint first_index;    ///< among the indices of all proxies
    uint triangle_count; ///< 0: the mesh casts its own shadow
    uint is_closed;      ///< 1: it has no boundary
    float distance;      ///< metres in object space by which triangles are moved from the light: twice the
                         ///< widest gap between a surface and its proxy in front of it
    uint reserved0;
    uint reserved1;
    uint reserved2;
};

/// Triangles of a chunk: small enough that a box wastes little, large enough that instances of the draw are
/// few.
HEARTH_CONSTANT uint kProxyChunkTriangles = 64;
HEARTH_CONSTANT uint kProxyChunkVertices = kProxyChunkTriangles * 3;

HEARTH_FUNCTION uint countProxyChunks(HEARTH_IN(ProxyCaster) proxy)
{
    return (proxy.triangle_count + kProxyChunkTriangles - 1u) / kProxyChunkTriangles;
}

/// kProxyChunkTriangles triangles of the proxy of an instance, or as many as are left.
struct ProxyChunk
{
    uint instance;
    uint first_triangle;
};

/// Draw of all chunks of a view (VkDrawIndirectCommand), then a counter.
struct ProxyDraw
{
    uint vertex_count;
    uint instance_count; ///< chunks
    uint first_vertex;
    uint first_instance;
    uint triangle_count; ///< of all chunks
};

/// Instances that a workgroup lists.
HEARTH_CONSTANT uint kGroupProxies = 64;

/// Sine of the angle beyond edge-on from which triangles of a closed proxy that face away from the light stay
/// where they are. Where a surface turns away from the light, its proxy turns a little earlier or later, and
/// would draw its facets on it.
HEARTH_CONSTANT float kProxyTurn = 0.5f;

/// Return the share [0, 1] of ProxyCaster::distance by which a triangle is moved away from the light. A proxy
/// may lie in front of its surface, and would shadow it; moved by the distance, it lies behind. The back of a
/// closed proxy shadows nothing that is lit, and stays: so shadows stay attached, and thin parts cast.
///
/// point  of the triangle, relative to light.origin, world axes
/// front  normal of the triangle, unit
HEARTH_FUNCTION float proxyOffsetShare(HEARTH_IN(ShadowLight) light, Float3 point, Float3 front)
{
    Float3 ray = light.direction * (1.0f - light.perspective) + point * light.perspective;
    float away = dot3(front, ray) / sqrt(max(dot3(ray, ray), kMinPlaneDistance));
    return min(max(1.0f - away / kProxyTurn, 0.0f), 1.0f);
}

HEARTH_SHARED_END

#ifdef __cplusplus
// sizes in std430 layout
static_assert(sizeof(hearth::shared::ProxyCaster) == 32);
static_assert(sizeof(hearth::shared::ProxyChunk) == 8);
static_assert(sizeof(hearth::shared::ProxyDraw) == 20);
#endif

#endif

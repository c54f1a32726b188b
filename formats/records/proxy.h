// Chunks of proxies: simple meshes that stand for others, for collision and as occluders. See FORMAT.md,
// "Proxies".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/container.h"

#include <array>

namespace hearth::formats
{

inline constexpr uint32_t kChunkProxies = fourCC("PRXY");        ///< ProxyRecord[]
inline constexpr uint32_t kChunkProxySections = fourCC("PRXS");  ///< ProxySectionRecord[]
inline constexpr uint32_t kChunkProxyPositions = fourCC("PRXP"); ///< Float3[], of all proxies
inline constexpr uint32_t kChunkProxyIndices = fourCC("PRXI");   ///< u32[], of all proxies
inline constexpr uint32_t kChunkProxyBindings = fourCC("PRXB");  ///< ProxyBindingRecord[]

inline constexpr std::array kProxyChunks{kChunkProxies, kChunkProxySections, kChunkProxyPositions,
                                         kChunkProxyIndices, kChunkProxyBindings};

/// Maker of a proxy.
enum class ProxyOrigin : uint32_t
{
    cleaned = 0,  ///< the mesh itself, repaired and decimated
    wrapped = 1,  ///< a closed surface around the mesh
    authored = 2, ///< a mesh that an artist made for it
};

inline constexpr std::array<std::string_view, 3> kProxyOriginNames{"cleaned", "wrapped", "authored"};

/// Proxy of a mesh, in the mesh's object space and bind pose. Proxies are sorted by mesh.
struct ProxyRecord
{
    uint32_t mesh;
    uint32_t origin;
    uint32_t is_closed;
    float distance;
    float mesh_distance;
    Range positions;
    Range indices;
    Range sections;
    Range bindings;
    uint32_t reserved[3];
};

/// Triangles of a proxy with one material, or one convex part of it.
struct ProxySectionRecord
{
    Range triangles;
    uint32_t material;
    uint32_t is_convex;
};

/// Place on a proxy that a vertex of the mesh belongs to: the closest point that faces the same way.
struct ProxyBindingRecord
{
    uint32_t triangle;
    uint16_t weights[2];
    float distance;
};

/// One over the weight 1 of a binding.
inline constexpr float kProxyWeightStep = 1.0f / 65535;

} // namespace hearth::formats

HEARTH_RECORD(
    hearth::formats::ProxyRecord, 64,
    HEARTH_FIELD(hearth::formats::ProxyRecord, mesh, "mesh that it stands for"),
    HEARTH_FIELD(hearth::formats::ProxyRecord, origin, "ProxyOrigin"),
    HEARTH_FIELD(hearth::formats::ProxyRecord, is_closed, "1: it has no boundary, and an inside; else 0"),
    HEARTH_FIELD(hearth::formats::ProxyRecord, distance,
                 "metres: no point of the proxy is farther from the mesh; infinity: unknown"),
    HEARTH_FIELD(hearth::formats::ProxyRecord, mesh_distance,
                 "metres: no point of the mesh is farther from the proxy; infinity: unknown"),
    HEARTH_FIELD(hearth::formats::ProxyRecord, positions, "of chunk PRXP"),
    HEARTH_FIELD(hearth::formats::ProxyRecord, indices,
                 "of chunk PRXI: three a triangle, counted from its first position"),
    HEARTH_FIELD(hearth::formats::ProxyRecord, sections, "of chunk PRXS: all its triangles, in order"),
    HEARTH_FIELD(hearth::formats::ProxyRecord, bindings,
                 "of chunk PRXB: none, or one for each vertex of the mesh's first level, cluster by cluster"),
    HEARTH_FIELD(hearth::formats::ProxyRecord, reserved, "0"));

HEARTH_RECORD(hearth::formats::ProxySectionRecord, 16,
              HEARTH_FIELD(hearth::formats::ProxySectionRecord, triangles,
                           "counted from the proxy's first triangle"),
              HEARTH_FIELD(hearth::formats::ProxySectionRecord, material, "of all triangles; none: unknown"),
              HEARTH_FIELD(hearth::formats::ProxySectionRecord, is_convex,
                           "1: the section is a convex solid of its own; else 0"));

HEARTH_RECORD(hearth::formats::ProxyBindingRecord, 12,
              HEARTH_FIELD(hearth::formats::ProxyBindingRecord, triangle,
                           "counted from the proxy's first triangle"),
              HEARTH_FIELD(hearth::formats::ProxyBindingRecord, weights,
                           "barycentric weights of the second and third corner, over 65535"),
              HEARTH_FIELD(hearth::formats::ProxyBindingRecord, distance,
                           "metres from the vertex to that place"));

// Draws the clusters of a bin that have one material, with all shading attributes as vertex outputs.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/decisions.h"
#include "formats/gpu_shared/shading.h"
#include "runtime/shaders/scene/scene.glsl"
#include "runtime/shaders/scene/material.glsl"
#include "runtime/shaders/scene/surface_point.glsl"
#include "runtime/shaders/scene/resolve.glsl"

layout(set = kSetBins, binding = kBinsDraws, std430) readonly buffer BinDraws { BinDraw bin_draws[]; };
layout(push_constant) uniform Push
{
    uint bin_index;
    uint material_number;
};

layout(location = 0) out vec3 out_position; // relative to the eye
layout(location = 1) out vec3 out_normal; // world axes, any length; the next likewise
layout(location = 2) out vec3 out_tangent;
layout(location = 3) out vec3 out_color;
layout(location = 4) out vec4 out_uvs; // sets 0 and 1
layout(location = 5) flat out float out_side;
layout(location = 6) flat out uint out_mirrored;

void main()
{
    VisibleCluster slot = visible[bin_draws[bin_index].first_slot + gl_InstanceIndex];
    ClusterDraw draw = cluster_draws[slot.cluster];
    uint triangle = gl_VertexIndex / 3u;
    gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
    out_position = out_normal = out_tangent = out_color = vec3(0.0);
    out_uvs = vec4(0.0);
    out_side = 1.0;
    out_mirrored = 0u;
    if (triangle >= triangleCount(draw) || draw.material != material_number)
        return;
    Instance instance = instances[slot.instance];
    uint vertex = vertexAddress(draw, cornerVertex(draw, triangle, gl_VertexIndex % 3u));
    vec3 normal = vertexNormal(draw, vertex);
    out_position = toEyeRelative(instance, view.eye, vertexPosition(draw, vertex));
    gl_Position = clipPosition(view, out_position);
    out_normal = worldNormal(instance, normal);
    out_color = vertexColor(draw, vertex).rgb;
    out_uvs = vec4(vertexUv(draw, vertex, 0u), vertexUv(draw, vertex, 1u));
    out_mirrored = isMirrored(instance) ? 1u : 0u;
    if ((draw.vertex_layout & kVertexTangent) != 0u)
    {
        vec4 tangent = vertexTangent(draw, vertex, normal);
        out_tangent = worldVector(instance, tangent.xyz);
        out_side = isMirrored(instance) ? -tangent.w : tangent.w;
    }
}

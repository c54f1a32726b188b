// Vertex of a shadow caster, shared by caster.vert and caster_masked.vert.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/push_constants.h"
#include "runtime/shaders/scene/shadow_block.glsl"
#include "runtime/shaders/draw/caster_triangle.glsl"
#include "runtime/shaders/scene/drawn_vertex.glsl"

layout(set = kSetBins, binding = kBinsDraws, std430) readonly buffer BinDraws { BinDraw bin_draws[]; };
layout(push_constant) uniform Push { BinPush push; };

struct CasterCorner
{
    ClusterDraw draw;
    uint vertex; // address, or kVisibilitySky for the unused rest of the 128 triangles
    vec4 position;
};

// Compute the corner, moved away from the light (casterClip).
CasterCorner casterCorner()
{
    uint slot = bin_draws[push.bin].first_slot + gl_InstanceIndex;
    uint triangle = gl_VertexIndex / 3u;
    CasterCorner corner;
    corner.draw = cluster_draws[visible[slot].cluster];
    corner.vertex = kVisibilitySky;
    corner.position = vec4(0.0, 0.0, 0.0, 1.0); // three of these form a triangle without area
    if (triangle >= triangleCount(corner.draw))
        return corner;
    Instance instance = instances[visible[slot].instance];
    DrawnPose pose = drawnPose(visible[slot].instance, slot);
    ShadowLight light = shadows.lights[push.light_row];
    uint turn = cornerInBin(instance, gl_VertexIndex % 3u);
    vec3 points[3];
    for (uint i = 0u; i < 3u; ++i)
    {
        uint index = cornerVertex(corner.draw, triangle, (turn + i) % 3u);
        if (i == 0u)
            corner.vertex = vertexAddress(corner.draw, index);
        points[i] = drawnPosition(instance, corner.draw, pose, index, light.origin);
    }
    CasterTriangle placed = casterTriangle(light, points);
    float error = corner.draw.position_error * instance.scale_max;
    bool is_clockwise = (push.facing == kCasterClockwise) != ((instance.flags & kInstanceHandednessChanged) != 0u);
    float share = push.facing == kCasterDoubleSided
                      ? 1.0
                      : shadowOffsetShare(light, placed.middle, is_clockwise ? -placed.normal : placed.normal);
    corner.position = casterClip(light, shadows.maps[push.map_index], placed, error, share);
    return corner;
}

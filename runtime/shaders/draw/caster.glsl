// Vertex of a shadow caster, shared by caster.vert and caster_masked.vert.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/push_constants.h"
#include "runtime/shaders/scene/shadow_block.glsl"
#include "runtime/shaders/scene/drawn_vertex.glsl"

layout(set = kSetBins, binding = kBinsDraws, std430) readonly buffer BinDraws { BinDraw bin_draws[]; };
layout(push_constant) uniform Push { BinPush push; };

struct CasterCorner
{
    ClusterDraw draw;
    uint vertex; // address, or kVisibilitySky for the unused rest of the 128 triangles
    vec4 position;
};

// Compute the corner, moved away from the light by the slope-scaled offset of the triangle's own plane.
// Vertex normals would round off silhouettes in the map.
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
    vec3 points[3]; // the corner of this invocation, then the other two in order
    for (uint i = 0u; i < 3u; ++i)
    {
        uint index = cornerVertex(corner.draw, triangle, (turn + i) % 3u);
        if (i == 0u)
            corner.vertex = vertexAddress(corner.draw, index);
        points[i] = drawnPosition(instance, corner.draw, pose, index, light.origin);
    }
    vec3 across = cross(points[1] - points[0], points[2] - points[0]);
    float area2 = dot(across, across);
    // a triangle without area is not drawn, so any normal will do
    vec3 normal = area2 > 0.0 ? across * inversesqrt(area2) : light.direction;
    // no part of a triangle is nearer than its nearest corner minus its longest edge
    float nearest = min(length(points[0]), min(length(points[1]), length(points[2])));
    float longest = max(length(points[1] - points[0]),
                        max(length(points[2] - points[1]), length(points[0] - points[2])));
    float error = corner.draw.position_error * instance.scale_max;
    bool is_clockwise = (push.facing == kCasterClockwise) != ((instance.flags & kInstanceHandednessChanged) != 0u);
    // one value for the triangle, so that it stays flat
    float share = push.facing == kCasterDoubleSided
                      ? 1.0
                      : shadowOffsetShare(light, (points[0] + points[1] + points[2]) / 3.0, is_clockwise ? -normal : normal);
    corner.position = shadowCasterClip(light, shadows.maps[push.map_index], points[0], normal,
                                       max(nearest - longest, 0.0), error, share);
    return corner;
}

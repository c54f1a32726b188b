// Vertex of a visible cluster, shared by visibility.vert and visibility_masked.vert.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/push_constants.h"
#include "runtime/shaders/scene/drawn_vertex.glsl"

layout(set = kSetBins, binding = kBinsDraws, std430) readonly buffer BinDraws { BinDraw bin_draws[]; };
layout(push_constant) uniform Push { BinPush push; };

struct VisibleCorner
{
    ClusterDraw draw;
    uint vertex; // address, or kVisibilitySky for the unused rest of the 128 triangles
    uint id;
    vec4 position;
};

VisibleCorner visibleCorner()
{
    uint slot = bin_draws[push.bin].first_slot + gl_InstanceIndex;
    uint triangle = gl_VertexIndex / 3u;
    VisibleCorner corner;
    corner.draw = cluster_draws[visible[slot].cluster];
    corner.id = slot << kTriangleBits | triangle;
    corner.vertex = kVisibilitySky;
    corner.position = vec4(0.0, 0.0, 0.0, 1.0); // three of these form a triangle without area
    if (triangle < triangleCount(corner.draw))
    {
        Instance instance = instances[visible[slot].instance];
        uint index = cornerVertex(corner.draw, triangle, cornerInBin(instance, gl_VertexIndex % 3u));
        corner.vertex = vertexAddress(corner.draw, index);
        DrawnPose pose = drawnPose(visible[slot].instance, slot);
        corner.position = clipPosition(view, drawnPosition(instance, corner.draw, pose, index, view.eye));
    }
    return corner;
}

// Draws the area in which one material is shaded, at its depth: the tiles of its list, one instance per tile,
// or the whole frame, which is entry 0. Quads of the size of a tile avoid long diagonals, along which a
// tile-based GPU bins triangles without need.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/material_tiles.h"
#include "formats/gpu_shared/push_constants.h"
#include "formats/gpu_shared/records.h"

layout(set = kSetScene, binding = kSceneFrame, std140) uniform Frame { FrameView view; };
layout(set = kSetAttachments, binding = kAttachmentTileLists, std430) readonly buffer TileLists { uint tile_lists[]; };
layout(push_constant) uniform Push { ShadingPush push; };

// Corners 0 1 2 and 2 1 3 of a quad, two bits each, the first one in the lowest bits.
const uint kQuadCorners = 0xDA4u;

void main()
{
    uint vertex = uint(gl_VertexIndex) % kTileVertices;
    uint entry = uint(gl_VertexIndex) / kTileVertices + uint(gl_InstanceIndex);
    // one triangle that covers the screen
    vec2 ndc = vec2(vertex & 1u, vertex >> 1) * 4.0 - 1.0;
    if (entry != 0u)
    {
        uint tile = tile_lists[entry];
        uint corner = kQuadCorners >> (2u * vertex) & 3u;
        uvec2 pixel = (uvec2(tile & 0xFFFFu, tile >> 16) + uvec2(corner & 1u, corner >> 1)) * kMaterialTilePixels;
        vec2 size = vec2(view.width, view.height);
        ndc = min(vec2(pixel), size) * 2.0 / size - 1.0;
    }
    gl_Position = vec4(ndc, push.depth, 1.0);
}

// Debug view of the bricks (GI): the first solid voxel that the ray of a pixel hits. Shows the albedo of its
// face under a headlight, with the voxel edges drawn, or the radiance of the face. Red: the pack has no light
// for the face. One full-screen triangle in place of all surfaces.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/push_constants.h"
#include "runtime/shaders/scene/bricks.glsl"
#include "runtime/shaders/scene/pixel_ray.glsl"
#include "runtime/shaders/shade/image_color.glsl"
#include "runtime/shaders/shade/tonemap.glsl"

layout(push_constant) uniform Push { ShadingPush push; };

layout(location = 0) out vec4 out_color;

const vec3 kNoFaceColor = vec3(0.5, 0.02, 0.02);

// 1 on the edges of a voxel. Edges are as wide as a pixel or a twentieth of the voxel.
float edgeWeight(vec3 place, uint face, float pixel_voxels)
{
    vec3 part = abs(fract(place) - 0.5);
    part[face >> 1] = 0.0;
    float to_edge = 0.5 - max(part.x, max(part.y, part.z));
    float width = min(max(0.03, pixel_voxels), 0.1);
    // voxels as small as pixels get no edges
    return (1.0 - smoothstep(0.5 * width, width, to_edge)) * (1.0 - smoothstep(0.15, 0.5, pixel_voxels));
}

void main()
{
    PixelRay pixel = pixelRay(gl_FragCoord.xy);
    vec3 direction = normalize(pixel.along);
    BrickGrid grid = brick_view.grid;
    BrickRay ray = brickMarch(grid, brickRay(grid, view.eye + pixel.origin, direction, kBrickInfinity));
    bool lit = push.debug_view == kViewBrickLighting;
    vec3 color = lit ? toneMap(skyRadiance(sceneSky(), direction)) : linearFromSrgb(vec3(0.08));
    if (ray.inside != 0u)
    {
        uint face = brickFace(bricks[ray.brick], ray.bit, ray.face);
        if (face == kNoFace)
            color = kNoFaceColor;
        else if (lit)
            color = toneMap(brickRadianceAt(grid, face));
        else
        {
            float facing = 0.35 + 0.65 * abs(dot(brickFaceAxis(ray.face), direction));
            vec3 place = ray.start + ray.direction * ray.t;
            float distance = mix(brickDistance(grid, ray), 1.0, isOrthographic(view));
            float pixel_voxels = distance / (view.lod_scale * grid.voxel_size);
            color = (brickAlbedoAt(face) * facing + brickEmissionAt(face)) * (1.0 - 0.5 * edgeWeight(place, ray.face, pixel_voxels));
        }
    }
    out_color = vec4(imageColor(color), 1.0);
}

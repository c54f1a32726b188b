// Marches a test's rays through the bricks of a scene: first hit of each, and the next hit behind it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#include "runtime/shaders/scene/bricks.glsl"

layout(local_size_x = 64) in;

struct TestRay
{
    vec3 origin; // world
    float far;   // metres
    vec3 direction;
    float reserved;
};

struct TestHit
{
    uint inside;
    uint x;
    uint y;
    uint z;
    uint face;
    uint face_index;
    uint distance_bits;
    uint steps;
};

layout(set = kSetFreshLight, binding = kFreshLightFaces, std430) writeonly buffer Hits { TestHit hits[]; };
layout(set = kSetFreshLight, binding = kFreshLightLocations, std430) readonly buffer Rays { TestRay rays[]; };

TestHit makeHit(BrickRay ray)
{
    if (ray.inside == 0u)
        return TestHit(0u, 0u, 0u, 0u, 0u, 0u, 0u, ray.steps);
    return TestHit(1u, uint(ray.x), uint(ray.y), uint(ray.z), ray.face, brickFace(bricks[ray.brick], ray.bit, ray.face),
                   floatBitsToUint(brickDistance(brick_view.grid, ray)), ray.steps);
}

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(rays.length()))
        return;
    BrickGrid grid = brick_view.grid;
    BrickRay ray = brickMarch(grid, brickRay(grid, rays[i].origin, rays[i].direction, rays[i].far));
    hits[2u * i] = makeHit(ray);
    if (ray.inside != 0u)
        ray = brickMarch(grid, brickSkipVoxel(grid, ray));
    hits[2u * i + 1u] = makeHit(ray);
}

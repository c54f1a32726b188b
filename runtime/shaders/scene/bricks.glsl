// Bricks of the scene (GI): set 0 of the passes over them, and the accessors that
// formats/gpu_shared/brick_lighting.h needs.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/brick_codes.h"
#include "formats/gpu_shared/brick_lighting.h"
#include "formats/gpu_shared/brick_march.h"
#include "formats/gpu_shared/brick_view.h"
#include "formats/gpu_shared/receivers/receiver_rows.h"
#include "formats/gpu_shared/records.h"
#include "formats/gpu_shared/shading.h"

layout(set = kSetBricks, binding = kBricksFrame, std140) uniform Frame { FrameView view; };
layout(set = kSetBricks, binding = kBricksView, std140) uniform Bricks { BrickView brick_view; };
layout(set = kSetBricks, binding = kBricksGroups, std430) readonly buffer BrickGroups { BrickGroup brick_groups[]; };
layout(set = kSetBricks, binding = kBricksBricks, std430) readonly buffer BrickTable { Brick bricks[]; };
layout(set = kSetBricks, binding = kBricksOpacity, std430) readonly buffer BrickOpacities { uint brick_opacities[]; };
layout(set = kSetBricks, binding = kBricksSurfaces, std430) readonly buffer BrickSurfaces { uint brick_surfaces[]; };
layout(set = kSetBricks, binding = kBricksLight, std430) readonly buffer BrickLighting { BrickLight brick_lights[]; };
layout(set = kSetBricks, binding = kBricksLight, std430) readonly buffer BrickLightWords { uint brick_light_words[]; };
layout(set = kSetBricks, binding = kBricksLighting, std140) readonly buffer LightingBlock
{
    Lighting lighting;
    Light lights[];
};
layout(set = kSetBricks, binding = kBricksLighting, std430) readonly buffer LightWords { uint light_words[]; };

BrickGroup brickGroupAt(BrickGrid grid, uint group) { return brick_groups[group]; }
Brick brickAt(BrickGrid grid, uint brick) { return bricks[brick]; }

float brickOpacityAt(BrickGrid grid, uint voxel)
{
    return float(brick_opacities[voxel >> 2] >> (voxel & 3u) * 8u & 255u) / 255.0;
}

// Light of a face that the passes over bricks find: all of it where no lamp is baked into faces.
vec3 brickLiveRadianceAt(uint face) { return decodeBrickLight(brick_lights[face]); }

// Light of lamps that are baked into faces, by their weights.
vec3 brickBakedRadianceAt(uint face)
{
    return decodeSharedExponentWord(brick_light_words[2u * brick_view.face_count + face]) * brick_view.baked_scale;
}

vec3 brickRadianceAt(BrickGrid grid, uint face)
{
#ifdef LIVE_LIGHT_ALONE
    return brickLiveRadianceAt(face);
#else
    vec3 radiance = vec3(0.0);
    if ((brick_view.light_parts & kLiveFaceLight) != 0u)
        radiance += brickLiveRadianceAt(face);
    if ((brick_view.light_parts & kBakedFaceLight) != 0u)
        radiance += brickBakedRadianceAt(face);
    return radiance;
#endif
}

vec3 brickAlbedoAt(uint face) { return decodeAlbedo(brick_surfaces[face]); }

// Depth of the surface behind a face, in voxels.
float brickDepthAt(uint face) { return decodeFaceDepth(brick_surfaces[face]); }

// Emission of a face as stored in the pack.
vec3 brickEmissionAt(uint face) { return decodeRadiance(brick_surfaces[brick_view.face_count + face]); }

vec3 brickNormalAt(uint face)
{
    uint word = brick_surfaces[2u * brick_view.face_count + (face >> 1)];
    return decodeFaceNormal(word >> (face & 1u) * 16u & 0xFFFFu);
}

#include "runtime/shaders/scene/sky_rows.glsl"

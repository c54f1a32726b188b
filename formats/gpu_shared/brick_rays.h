// Traces rays of light through bricks: ray directions, the radiance that faces store, and the light along a
// ray. One source for C++ and GLSL. brick_march.h does the traversal, brick_lighting.h chooses the origins.
// cook/bricks/README.md has the reasons.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
//
// Positions are in voxels of the grid: (world - origin) / voxel_size. Directions are unit vectors, the same
// in world and grid space.
#ifndef HEARTH_SHARED_BRICK_RAYS_H
#define HEARTH_SHARED_BRICK_RAYS_H

#include "formats/gpu_shared/brick_codes.h"
#include "formats/gpu_shared/brick_march.h"
#include "formats/gpu_shared/sky.h"

HEARTH_SHARED_BEGIN

/// Transmittance below which a ray ends.
HEARTH_CONSTANT float kMinBrickTransmittance = 0.00390625f;

/// Distance in voxels off a face at which a ray is certainly in the air beside it: coordinates up to 2^14
/// round to 2^-11.
HEARTH_CONSTANT float kBrickFaceMargin = 0.001953125f;

// ---- random numbers and directions

/// Hash an integer.
/// source  C. Wellons, "Prospecting for hash functions", 2018: lowbias32
HEARTH_FUNCTION uint brickHash(uint x)
{
    x ^= x >> 16;
    x *= 0x21F0AAADu;
    x ^= x >> 15;
    x *= 0x735A2D97u;
    x ^= x >> 15;
    return x;
}

/// Return the seed of a voxel's face. It does not depend on other voxels.
HEARTH_FUNCTION uint brickFaceSeed(uint x, uint y, uint z, uint face)
{
    return brickHash(x + brickHash(y + brickHash(z * 8u + face)));
}

/// Return a number in [0, 1): the upper 24 bits, which a float holds exactly.
HEARTH_FUNCTION float brickRandomUnit(uint bits)
{
    return float(bits >> 8) * 5.9604644775390625e-8f;
}

/// Return ray `index` of `count`, cosine-distributed about the normal: a golden-angle spiral that fills the
/// disc below the hemisphere evenly at any count, rotated and shifted by the seed. To the same bits in both
/// languages.
/// source  H. Vogel, "A better way to construct the sunflower head", 1979; sine and cosine as in
///         cook/sampling/maps.h
HEARTH_FUNCTION Float3 brickRayDirection(Float3 normal, uint index, uint count, uint seed)
{
    HEARTH_PRECISE float u = (float(index) + brickRandomUnit(seed)) / float(count);
    HEARTH_PRECISE float quarters = brickRandomUnit(index * 2654435769u + brickHash(seed)) * 4.0f;
    uint quarter = uint(quarters + 0.5f);
    HEARTH_PRECISE float angle = (quarters - float(quarter)) * 1.57079633f;
    HEARTH_PRECISE float a = angle * angle;
    HEARTH_PRECISE float s =
        angle *
        (1.0f + a * (-0.166666667f + a * (0.00833333333f + a * (-0.000198412698f + a * 2.75573192e-6f))));
    HEARTH_PRECISE float c =
        1.0f + a * (-0.5f + a * (0.0416666667f + a * (-0.00138888889f + a * 2.48015873e-5f)));
    float sine = (quarter & 1u) != 0u ? c : s;
    float cosine = (quarter & 1u) != 0u ? s : c;
    sine = (quarter & 2u) != 0u ? -sine : sine;
    cosine = ((quarter + 1u) & 2u) != 0u ? -cosine : cosine;
    HEARTH_PRECISE float radius = sqrt(u);
    HEARTH_PRECISE float x = radius * cosine;
    HEARTH_PRECISE float y = radius * sine;
    HEARTH_PRECISE float z = sqrt(max(1.0f - u, 0.0f));
    // source of the tangent frame: T. Duff et al., "Building an orthonormal basis, revisited", 2017
    float side = normal.z < 0.0f ? -1.0f : 1.0f;
    HEARTH_PRECISE float p = -1.0f / (side + normal.z);
    HEARTH_PRECISE float q = normal.x * normal.y * p;
    HEARTH_PRECISE Float3 first = Float3(1.0f + side * normal.x * normal.x * p, side * q, -side * normal.x);
    HEARTH_PRECISE Float3 second = Float3(q, side + normal.y * normal.y * p, -normal.y);
    HEARTH_PRECISE Float3 direction = first * x + second * y + normal * z;
    return direction;
}

// ---- faces

/// Outward unit vector of face 0 to 5: x- x+ y- y+ z- z+.
HEARTH_FUNCTION Float3 brickFaceAxis(uint face)
{
    float side = (face & 1u) != 0u ? 1.0f : -1.0f;
    uint axis = face >> 1;
    return Float3(axis == 0u ? side : 0.0f, axis == 1u ? side : 0.0f, axis == 2u ? side : 0.0f);
}

/// Return the middle of a face, just off the face.
HEARTH_FUNCTION Float3 brickFaceMiddle(uint x, uint y, uint z, uint face)
{
    HEARTH_PRECISE Float3 middle = Float3(float(x) + 0.5f, float(y) + 0.5f, float(z) + 0.5f) +
                                   brickFaceAxis(face) * (0.5f + kBrickFaceMargin);
    return middle;
}

/// Return the normal by which a face is lit: the surface normal, flipped to the side of the face. Thin
/// surfaces have faces on both sides.
HEARTH_FUNCTION Float3 brickFaceNormal(Float3 surface_normal, uint face)
{
    return dot(surface_normal, brickFaceAxis(face)) < 0.0f ? -surface_normal : surface_normal;
}

// ---- radiance that a face stores

/// Radiance of a face in the iteration: the code that rays read, and the rounding error of that code in
/// 1/1022 of a code step, 10 bits signed for each colour. Steps of R11G11B10F are a 64th, for blue a 32nd, so
/// an iteration on the codes alone would stop up to 0.5 / (1 - albedo) steps before its limit: a furnace of
/// albedo .9 by 8 %, in blue by 16 %. With the rest the error is 2^-16 of the value, and the iteration
/// converges. A rest of 0 is the code's own value.
struct BrickLight
{
    uint code; ///< nearest code, encodeRadiance
    uint rest;
};

/// Return the distance from a code's value to the next code's value.
HEARTH_FUNCTION float brickCodeStep(float value, uint mantissa_bits)
{
    uint exponent = floatBits(value) >> 23;
    return floatFromBits(((exponent > 113u ? exponent : 113u) - mantissa_bits) << 23);
}

HEARTH_FUNCTION uint encodeBrickRest(float value, float coded, uint mantissa_bits)
{
    float steps = (value - coded) / brickCodeStep(coded, mantissa_bits);
    // the largest code stands for all larger values
    return uint(int(floor(min(max(steps, -0.5f), 0.5f) * 1022.0f + 0.5f))) & 1023u;
}

HEARTH_FUNCTION float decodeBrickRest(float coded, uint rest, uint mantissa_bits)
{
    return coded + float(int(rest << 22) >> 22) / 1022.0f * brickCodeStep(coded, mantissa_bits);
}

/// Encode radiance with its rest.
/// radiance  not negative
HEARTH_FUNCTION BrickLight encodeBrickLight(Float3 radiance)
{
    BrickLight light;
    light.code = encodeRadiance(radiance);
    Float3 coded = decodeRadiance(light.code);
    light.rest = encodeBrickRest(radiance.x, coded.x, 6u) | encodeBrickRest(radiance.y, coded.y, 6u) << 10 |
                 encodeBrickRest(radiance.z, coded.z, 5u) << 20;
    return light;
}

HEARTH_FUNCTION Float3 decodeBrickLight(BrickLight light)
{
    Float3 coded = decodeRadiance(light.code);
    return Float3(decodeBrickRest(coded.x, light.rest, 6u), decodeBrickRest(coded.y, light.rest >> 10, 6u),
                  decodeBrickRest(coded.z, light.rest >> 20, 5u));
}

// ---- rays

#ifdef __cplusplus
/// Tables that rays read, with the masks.
struct BrickScene
{
    BrickMasks masks;
    std::span<const uint8_t> opacity;  ///< one for each solid voxel
    std::span<const BrickLight> light; ///< one for each face
};
inline const BrickMasks& brickSceneMasks(const BrickScene& scene)
{
    return scene.masks;
}
/// Return the opacity of a solid voxel, [0, 1]; exactly 1 for an opaque one.
inline float brickOpacityAt(const BrickScene& scene, uint voxel)
{
    return static_cast<float>(scene.opacity[voxel]) / 255.0f;
}
/// Return the outgoing radiance of a face.
inline Float3 brickRadianceAt(const BrickScene& scene, uint face)
{
    return decodeBrickLight(scene.light[face]);
}
#else
// A shader defines these two functions over its buffers, before or after this header.
#define BrickScene BrickGrid
float brickOpacityAt(BrickGrid grid, uint voxel);
vec3 brickRadianceAt(BrickGrid grid, uint face);
BrickGrid brickSceneMasks(BrickGrid grid)
{
    return grid;
}
#endif

struct BrickRayLight
{
    Float3 radiance;
    float sky; ///< fraction of the ray that passes all bricks, [0, 1]
};

/// Return the light along a ray: the radiance of the faces that it meets, weighted by the opacity of their
/// voxels, and behind them the sky's.
/// ray  in its first solid voxel, as brickMarch finds it
HEARTH_FUNCTION BrickRayLight traceBrickLight(HEARTH_IN(BrickScene) scene, HEARTH_IN(Sky) sky, BrickRay ray)
{
    BrickRayLight light;
    light.radiance = Float3(0.0f, 0.0f, 0.0f);
    light.sky = 0.0f;
    float through = 1.0f;
    while (ray.inside != 0u)
    {
        Brick brick = brickAt(brickSceneMasks(scene), ray.brick);
        float opacity = brickOpacityAt(scene, brickVoxel(brick, ray.bit));
        uint face = brickFace(brick, ray.bit, ray.face);
        if (face != kNoFace)
            light.radiance = light.radiance + brickRadianceAt(scene, face) * (through * opacity);
        through *= 1.0f - opacity;
        if (through < kMinBrickTransmittance)
            return light;
        ray = brickMarch(brickSceneMasks(scene), brickSkipVoxel(brickSceneMasks(scene), ray));
    }
    light.radiance = light.radiance + skyRadiance(sky, ray.direction) * through;
    light.sky = through;
    return light;
}

/// Return the light along a ray from a position.
/// position      in voxels
/// direction  unit
HEARTH_FUNCTION BrickRayLight brickRayLight(HEARTH_IN(BrickScene) scene, HEARTH_IN(Sky) sky, Float3 position,
                                            Float3 direction)
{
    return traceBrickLight(
        scene, sky,
        brickMarch(brickSceneMasks(scene), brickRayInVoxels(brickMasksGrid(brickSceneMasks(scene)), position,
                                                            direction, kBrickInfinity)));
}

/// Return the transmittance along a ray, [0, 1].
/// max_distance  length in voxels
HEARTH_FUNCTION float brickTransmittance(HEARTH_IN(BrickScene) scene, Float3 position, Float3 direction,
                                         float max_distance)
{
    float through = 1.0f;
    BrickRay ray = brickMarch(brickSceneMasks(scene), brickRayInVoxels(brickMasksGrid(brickSceneMasks(scene)),
                                                                       position, direction, max_distance));
    while (ray.inside != 0u)
    {
        Brick brick = brickAt(brickSceneMasks(scene), ray.brick);
        through *= 1.0f - brickOpacityAt(scene, brickVoxel(brick, ray.bit));
        if (through < kMinBrickTransmittance)
            return 0.0f;
        ray = brickMarch(brickSceneMasks(scene), brickSkipVoxel(brickSceneMasks(scene), ray));
    }
    return through;
}

HEARTH_SHARED_END

#endif

// How the faces of bricks are lit, and how a surface gathers light from them: one iteration of
//     radiance = emission + albedo (direct + mean of what rays bring),
// written once for C++ and GLSL. The rays themselves march as in brick_march.h. cook/bricks/README.md, "Light", has the
// reasons, bounds and what was measured.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
//
// Directions and starts are the same in every frame, so that a rotation through all faces is one sweep of Jacobi's iteration
// for a fixed linear system: it converges to one answer, nothing flickers, and a light that went out is forgotten by a factor
// of the albedo each sweep. Nothing is blended over time.
//
// Places are in voxels of the grid: (world - origin) / voxel_size. Directions are unit and the same in both.
#ifndef HEARTH_SHARED_BRICK_LIGHTING_H
#define HEARTH_SHARED_BRICK_LIGHTING_H

#include "formats/shared/brick_codes.h"
#include "formats/shared/brick_march.h"
#include "formats/shared/shading.h"

HEARTH_SHARED_BEGIN

/// No surface returns more: what is lit by nothing but itself must fade.
HEARTH_CONSTANT float kBrickMostAlbedo = 0.95f;

/// Light that is left of a ray below this does not count any more.
HEARTH_CONSTANT float kBrickLeastThrough = 0.00390625f;

/// Voxels by which rays start off a slanted surface, along its normal and through the air: so far its stair-stepped neighbours
/// do not hide it from light.
HEARTH_CONSTANT float kBrickLift = 1.0f;

/// Sine of the angle to the nearest axis from which on a surface counts as slanted; below, by its share. What lies along an
/// axis has no steps, and rays that started off it would pass by what stands on it. 0.6 degrees, as finely as normals are
/// stored.
HEARTH_CONSTANT float kBrickSlantSine = 0.01f;

/// Voxels off a face where a ray is in the air beside it for certain: coordinates up to 2^14 round to 2^-11.
HEARTH_CONSTANT float kBrickFaceMargin = 0.001953125f;

/// Voxels along the normal within which a surface's point finds the air before it.
HEARTH_CONSTANT float kBrickMostBuried = 3.0f;

/// A light has no size: what stands nearer than this, and half of a voxel, would be as bright as one likes. It counts as a part
/// of the lamp and gets none of its light.
HEARTH_CONSTANT float kBrickLampMetres = 0.1f;

HEARTH_CONSTANT float kBrickPi = 3.14159265f;

/// formats::LightType
HEARTH_CONSTANT uint kBrickLightDirectional = 0u;
HEARTH_CONSTANT uint kBrickLightSpot = 2u;

// ---- random numbers and directions

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

/// Of a face of a voxel; the same whatever other voxels there are.
HEARTH_FUNCTION uint brickFaceSeed(uint x, uint y, uint z, uint face)
{
    return brickHash(x + brickHash(y + brickHash(z * 8u + face)));
}

/// In [0, 1): the upper 24 bits, which a float holds exactly.
HEARTH_FUNCTION float brickUnit(uint bits)
{
    return float(bits >> 8) * 5.9604644775390625e-8f;
}

/// Ray `index` of `count`, by the cosine about the normal: a spiral of the golden angle that fills the disc below the
/// hemisphere evenly at any count, turned and shifted by the seed. To the same bits in both languages.
/// source  H. Vogel, "A better way to construct the sunflower head", 1979; sine and cosine as in cook/sampling/maps.h
HEARTH_FUNCTION Float3 brickRayDirection(Float3 normal, uint index, uint count, uint seed)
{
    HEARTH_PRECISE float u = (float(index) + brickUnit(seed)) / float(count);
    HEARTH_PRECISE float quarters = brickUnit(index * 2654435769u + brickHash(seed)) * 4.0f;
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
    // source of the frame: T. Duff et al., "Building an orthonormal basis, revisited", 2017
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

/// The middle of a face, just off it.
HEARTH_FUNCTION Float3 brickFaceMiddle(uint x, uint y, uint z, uint face)
{
    HEARTH_PRECISE Float3 middle = Float3(float(x) + 0.5f, float(y) + 0.5f, float(z) + 0.5f) +
                                   brickFaceAxis(face) * (0.5f + kBrickFaceMargin);
    return middle;
}

/// The normal by which a face is lit: that of the surface, on the side that the face is on. Thin surfaces have faces on both.
HEARTH_FUNCTION Float3 brickFaceNormal(Float3 surface_normal, uint face)
{
    return dot(surface_normal, brickFaceAxis(face)) < 0.0f ? -surface_normal : surface_normal;
}

// ---- which faces a frame lights

/// The bricks of a frame lie one after the other, and so do their faces: what a frame found is copied in one piece.
HEARTH_FUNCTION uint brickSliceBegin(uint brick_count, uint frame, uint period)
{
    uint slice = frame % period;
    return brick_count / period * slice + (slice < brick_count % period ? slice : brick_count % period);
}

HEARTH_FUNCTION uint brickSliceEnd(uint brick_count, uint frame, uint period)
{
    return brickSliceBegin(brick_count, frame, period) + brick_count / period +
           (frame % period < brick_count % period ? 1u : 0u);
}

// ---- what a face stores

/// The radiance of a face as the iteration keeps it: the code that others see, and what that code left off, in 1/1023 of its
/// steps, 10 bits each with their sign. Steps of R11G11B10F are a 64th, a 32nd of blue, so that an iteration that read the
/// codes alone would stop up to 0.5 / (1 - albedo) steps before its goal: a furnace of albedo .9 by 8 %, of blue by 16 %.
/// With the rest it is off by 2^-16 of the value and does not notice. A rest of 0 is that of the code itself.
struct BrickLight
{
    uint code; ///< encodeRadiance: the nearest one
    uint rest;
};

/// How far the next code is, of a value that a code stands for.
HEARTH_FUNCTION float brickCodeStep(float value, uint mantissa_bits)
{
    uint exponent = floatBits(value) >> 23;
    return floatOfBits(((exponent > 113u ? exponent : 113u) - mantissa_bits) << 23);
}

HEARTH_FUNCTION uint brickRestOf(float value, float coded, uint mantissa_bits)
{
    float steps = (value - coded) / brickCodeStep(coded, mantissa_bits);
    // the largest code stands for all that is larger
    return uint(int(floor(min(max(steps, -0.5f), 0.5f) * 1022.0f + 0.5f))) & 1023u;
}

HEARTH_FUNCTION float brickWithRest(float coded, uint rest, uint mantissa_bits)
{
    return coded + float(int(rest << 22) >> 22) / 1022.0f * brickCodeStep(coded, mantissa_bits);
}

/// radiance  not negative
HEARTH_FUNCTION BrickLight encodeBrickLight(Float3 radiance)
{
    BrickLight light;
    light.code = encodeRadiance(radiance);
    Float3 coded = decodeRadiance(light.code);
    light.rest = brickRestOf(radiance.x, coded.x, 6u) | brickRestOf(radiance.y, coded.y, 6u) << 10 |
                 brickRestOf(radiance.z, coded.z, 5u) << 20;
    return light;
}

HEARTH_FUNCTION Float3 decodeBrickLight(BrickLight light)
{
    Float3 coded = decodeRadiance(light.code);
    return Float3(brickWithRest(coded.x, light.rest, 6u), brickWithRest(coded.y, light.rest >> 10, 6u),
                  brickWithRest(coded.z, light.rest >> 20, 5u));
}

// ---- rays

#ifdef __cplusplus
/// What rays read beside the masks.
struct BrickScene
{
    BrickMasks masks;
    std::span<const uint8_t> opacity;  ///< of solid voxels
    std::span<const BrickLight> light; ///< of faces
};
inline const BrickMasks& brickMasksOf(const BrickScene& scene)
{
    return scene.masks;
}
/// Of a solid voxel, [0, 1]; exactly 1 where it lets nothing through.
inline float brickOpacityAt(const BrickScene& scene, uint voxel)
{
    return static_cast<float>(scene.opacity[voxel]) / 255.0f;
}
/// What a face sends out.
inline Float3 brickRadianceAt(const BrickScene& scene, uint face)
{
    return decodeBrickLight(scene.light[face]);
}
#else
// A shader defines these two over its buffers, in front of this header or behind it.
#define BrickScene BrickGrid
float brickOpacityAt(BrickGrid grid, uint voxel);
vec3 brickRadianceAt(BrickGrid grid, uint face);
BrickGrid brickMasksOf(BrickGrid grid)
{
    return grid;
}
#endif

/// Radiances of the sky, as in shared::Lighting.
struct BrickSky
{
    Float3 zenith;
    Float3 horizon;
    Float3 ground;
};

HEARTH_FUNCTION float brickSmooth(float from, float to, float x)
{
    float t = min(max((x - from) / (to - from), 0.0f), 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

/// The gradient whose cosine-weighted mean is skyIrradiance of sky.glsl: skyRadiance at roughness 0.2.
HEARTH_FUNCTION Float3 brickSkyRadiance(HEARTH_IN(BrickSky) sky, Float3 direction)
{
    Float3 above = sky.horizon + (sky.zenith - sky.horizon) * brickSmooth(-0.2f, 1.0f, direction.y);
    return sky.ground + (above - sky.ground) * brickSmooth(-0.296f, 0.296f, direction.y);
}

struct BrickRayLight
{
    Float3 radiance;
    float sky; ///< share of the ray that passes all bricks, [0, 1]
};

/// What a ray brings: light of the faces that it meets, of each as much as its voxel stops, and behind them all the sky's.
/// ray  in the first solid voxel that it meets, as brickMarch finds it
HEARTH_FUNCTION BrickRayLight brickLightAlong(HEARTH_IN(BrickScene) scene, HEARTH_IN(BrickSky) sky,
                                              BrickRay ray)
{
    BrickRayLight light;
    light.radiance = Float3(0.0f, 0.0f, 0.0f);
    light.sky = 0.0f;
    float through = 1.0f;
    while (ray.inside != 0u)
    {
        Brick brick = brickAt(brickMasksOf(scene), ray.brick);
        float opacity = brickOpacityAt(scene, brickVoxel(brick, ray.bit));
        uint face = brickFace(brick, ray.bit, ray.face);
        if (face != kNoFace)
            light.radiance = light.radiance + brickRadianceAt(scene, face) * (through * opacity);
        through *= 1.0f - opacity;
        if (through < kBrickLeastThrough)
            return light;
        ray = brickMarch(brickMasksOf(scene), brickPass(brickMasksOf(scene), ray));
    }
    light.radiance = light.radiance + brickSkyRadiance(sky, ray.direction) * through;
    light.sky = through;
    return light;
}

/// The same from where it starts.
/// place      in voxels
/// direction  unit
HEARTH_FUNCTION BrickRayLight brickRayLight(HEARTH_IN(BrickScene) scene, HEARTH_IN(BrickSky) sky,
                                            Float3 place, Float3 direction)
{
    return brickLightAlong(scene, sky,
                           brickMarch(brickMasksOf(scene), brickRayInVoxels(brickGridOf(brickMasksOf(scene)),
                                                                            place, direction, kBrickFar)));
}

/// The share of light that passes along a ray. far  in voxels
HEARTH_FUNCTION float brickRayThrough(HEARTH_IN(BrickScene) scene, Float3 place, Float3 direction, float far)
{
    float through = 1.0f;
    BrickRay ray = brickMarch(brickMasksOf(scene),
                              brickRayInVoxels(brickGridOf(brickMasksOf(scene)), place, direction, far));
    while (ray.inside != 0u)
    {
        Brick brick = brickAt(brickMasksOf(scene), ray.brick);
        through *= 1.0f - brickOpacityAt(scene, brickVoxel(brick, ray.bit));
        if (through < kBrickLeastThrough)
            return 0.0f;
        ray = brickMarch(brickMasksOf(scene), brickPass(brickMasksOf(scene), ray));
    }
    return through;
}

// ---- where rays start

/// Where a face or a surface takes its light from.
struct BrickStart
{
    Float3 place; ///< in the air, in voxels
    Float3 normal;
    uint buried; ///< 1: no air was found before a surface; it gets no light
    /// What stands right before a surface, in a voxel that rays start behind: its mean radiance, and its opacity.
    Float3 close;
    float close_opacity; ///< [0, 1]; 0: nothing does
};

/// With nothing right before it.
HEARTH_FUNCTION BrickStart brickStartAt(Float3 place, Float3 normal)
{
    BrickStart start;
    start.place = place;
    start.normal = normal;
    start.buried = 0u;
    start.close = Float3(0.0f, 0.0f, 0.0f);
    start.close_opacity = 0.0f;
    return start;
}

/// 0 for a surface whose normal lies along an axis, whose voxels are as flat as it is; 1 for one between the axes.
HEARTH_FUNCTION float brickSlant(Float3 normal)
{
    float along = max(max(abs(normal.x), abs(normal.y)), abs(normal.z));
    return min(sqrt(max(1.0f - along * along, 0.0f)) / kBrickSlantSine, 1.0f);
}

/// Where the surface is taken to be that a face shows, in voxels: in the face's middle where it lies along an axis, for the
/// grid is laid so that walls end with their voxels, and in the voxel's where it is slanted.
/// normal  that the face is lit by
HEARTH_FUNCTION Float3 brickFaceSurface(uint x, uint y, uint z, uint face, Float3 normal)
{
    return brickFaceMiddle(x, y, z, face) - brickFaceAxis(face) * (0.5f * brickSlant(normal));
}

/// Off a place in the air along the normal, by kBrickLift if the surface is slanted, or half of the way to what is before
/// that.
HEARTH_FUNCTION Float3 brickLifted(HEARTH_IN(BrickScene) scene, Float3 place, Float3 normal)
{
    float lift = kBrickLift * brickSlant(normal);
    BrickRay ray = brickMarch(brickMasksOf(scene),
                              brickRayInVoxels(brickGridOf(brickMasksOf(scene)), place, normal, lift));
    return place + normal * (ray.inside != 0u ? 0.5f * (ray.start_t + ray.t) : lift);
}

/// surface_normal  that the face stores
HEARTH_FUNCTION BrickStart brickFaceStart(HEARTH_IN(BrickScene) scene, uint x, uint y, uint z, uint face,
                                          Float3 surface_normal)
{
    Float3 normal = brickFaceNormal(surface_normal, face);
    return brickStartAt(brickLifted(scene, brickFaceMiddle(x, y, z, face), normal), normal);
}

/// Whether the voxel that a ray is in is solid: a march that takes no step began in one.
HEARTH_FUNCTION bool brickIsInSolid(HEARTH_IN(BrickScene) scene, HEARTH_IN(BrickRay) ray)
{
    BrickRay met = brickMarch(brickMasksOf(scene), ray);
    return met.inside != 0u && met.steps == ray.steps;
}

/// For a point of a surface, which mostly lies in a solid voxel: along its normal out of it.
/// place   in voxels
/// normal  unit, of the side that is lit
HEARTH_FUNCTION BrickStart brickSurfaceStart(HEARTH_IN(BrickScene) scene, Float3 place, Float3 normal)
{
    BrickRay ray = brickRayInVoxels(brickGridOf(brickMasksOf(scene)), place, normal, kBrickMostBuried);
    while (brickIsInSolid(scene, ray))
        ray = brickPass(brickMasksOf(scene), ray);
    // where nothing was left, it is in the air already
    float out_t = ray.steps > 0u ? ray.start_t + ray.t : 0.0f;
    BrickStart start = brickStartAt(place, normal);
    start.buried = out_t >= kBrickMostBuried ? 1u : 0u;
    out_t += ray.steps > 0u ? kBrickFaceMargin : 0.0f;
    if (start.buried == 0u)
        start.place = brickLifted(scene, place + normal * out_t, normal);
    return start;
}

/// A start with what is in the solid voxel that the ray is in right before it.
HEARTH_FUNCTION BrickStart brickCloseTo(HEARTH_IN(BrickScene) scene, BrickStart start,
                                        HEARTH_IN(BrickRay) ray)
{
    BrickRay met = brickMarch(brickMasksOf(scene), ray);
    Brick brick = brickAt(brickMasksOf(scene), met.brick);
    float count = 0.0f;
    for (uint side = 0u; side < kVoxelFaces; ++side)
    {
        uint face = brickFace(brick, met.bit, side);
        if (face != kNoFace)
        {
            start.close = start.close + brickRadianceAt(scene, face);
            count += 1.0f;
        }
    }
    start.close = start.close * (1.0f / max(count, 1.0f));
    start.close_opacity = count > 0.0f ? brickOpacityAt(scene, brickVoxel(brick, met.bit)) : 0.0f;
    return start;
}

/// How much of a start's light comes from what is close to it, where rays bring `mean`: nothing where that is darker. Whether
/// such a thing hides the surface a grid cannot tell; that it shines on it is sure.
HEARTH_FUNCTION float brickCloseShare(HEARTH_IN(BrickStart) start, Float3 mean)
{
    float more = start.close.x + start.close.y + start.close.z - mean.x - mean.y - mean.z;
    return more > 0.0f ? start.close_opacity : 0.0f;
}

/// For a point of a surface that is seen: in the air before it; where other bricks stand there, as in the corners of rooms, in
/// the air that it is seen through.
/// to_eye  unit
HEARTH_FUNCTION BrickStart brickSeenStart(HEARTH_IN(BrickScene) scene, Float3 place, Float3 normal,
                                          Float3 to_eye)
{
    BrickStart start = brickSurfaceStart(scene, place, normal);
    Float3 way = start.place - place;
    float slant = brickSlant(normal);
    BrickRay own =
        brickRayInVoxels(brickGridOf(brickMasksOf(scene)),
                         place - normal * (kBrickPlaneReach + kBrickFaceMargin), normal, kBrickMostBuried);
    BrickRay next = brickPass(brickMasksOf(scene), own);
    // beyond that it was not its own voxel that was left
    float own_way = brickIsInSolid(scene, own) ? next.start_t + next.t : 1.0f;
    float most = own_way + (1.0f - own_way + kBrickLift) * slant + 0.25f;
    if (start.buried == 0u && dot(way, way) <= most * most)
        return start;
    start = brickSurfaceStart(scene, place, to_eye);
    start.normal = normal;
    if (brickIsInSolid(scene, next))
        start = brickCloseTo(scene, start, next);
    return start;
}

/// Mean radiance that rays by the cosine bring to a start: irradiance over pi, of all but the lights.
HEARTH_FUNCTION Float3 brickGather(HEARTH_IN(BrickScene) scene, HEARTH_IN(BrickSky) sky,
                                   HEARTH_IN(BrickStart) start, uint count, uint seed)
{
    Float3 sum = Float3(0.0f, 0.0f, 0.0f);
    for (uint i = 0u; i < count; ++i)
        sum =
            sum +
            brickRayLight(scene, sky, start.place, brickRayDirection(start.normal, i, count, seed)).radiance;
    if (start.buried != 0u)
        return Float3(0.0f, 0.0f, 0.0f);
    Float3 mean = sum * (1.0f / float(count));
    return mean + (start.close - mean) * brickCloseShare(start, mean);
}

// ---- lights

HEARTH_FUNCTION bool brickSolid(HEARTH_IN(BrickScene) scene, int x, int y, int z)
{
    BrickGrid grid = brickGridOf(brickMasksOf(scene));
    if (uint(x) >= grid.voxels_x || uint(y) >= grid.voxels_y || uint(z) >= grid.voxels_z)
        return false;
    uint group_index = (uint(x) >> 4) + brickGroups(grid.voxels_x) *
                                            ((uint(y) >> 4) + brickGroups(grid.voxels_y) * (uint(z) >> 4));
    BrickGroup group = brickGroupAt(brickMasksOf(scene), group_index);
    uint bit = brickBit(uint(x) >> 2, uint(y) >> 2, uint(z) >> 2);
    if (!maskHas(group.brick_mask_low, group.brick_mask_high, bit))
        return false;
    Brick brick =
        brickAt(brickMasksOf(scene),
                group.first_brick + maskCountBelow(group.brick_mask_low, group.brick_mask_high, bit));
    return maskHas(brick.voxel_mask_low, brick.voxel_mask_high, brickBit(uint(x), uint(y), uint(z)));
}

/// From where a lamp shines through the bricks, in voxels: where it stands, if that is in the air. Lamps stand in their
/// shades and beside their bulbs, which fill their voxel: then from the middle of the nearest voxel of air around, of two the
/// lower one, and from where it stands where there is none. The same for all faces: a frame may find it once.
/// lamp  in voxels
HEARTH_FUNCTION Float3 brickLampPlace(HEARTH_IN(BrickScene) scene, Float3 lamp)
{
    Float3 low = Float3(floor(lamp.x), floor(lamp.y), floor(lamp.z));
    // so far off the grid all is air, and the numbers would not fit
    float most = max(max(abs(lamp.x), abs(lamp.y)), abs(lamp.z));
    if (most > 32768.0f || !brickSolid(scene, int(low.x), int(low.y), int(low.z)))
        return lamp;
    Float3 place = lamp;
    float nearest = kBrickFar;
    for (int i = 0; i < 27; ++i)
    {
        int x = i % 3 - 1;
        int z = i / 3 % 3 - 1;
        int y = i / 9 - 1;
        Float3 middle = low + Float3(float(x) + 0.5f, float(y) + 0.5f, float(z) + 0.5f);
        Float3 way = middle - lamp;
        float distance2 = dot(way, way);
        if (distance2 < nearest && !brickSolid(scene, int(low.x) + x, int(low.y) + y, int(low.z) + z))
        {
            nearest = distance2;
            place = middle;
        }
    }
    return place;
}

/// What a light gives a face if nothing is in the way, and where it is looked for then.
struct BrickIncident
{
    Float3 arrived; ///< irradiance over pi; 0: the light need not be looked for
    Float3 way;     ///< unit, from the start of rays
    float far;      ///< to the light, in voxels
};

/// surface  brickFaceSurface: distance and angle are taken there
/// lamp    from where the light shines, in voxels: brickLampPlace, or where it stands. Suns have none
HEARTH_FUNCTION BrickIncident brickIncident(HEARTH_IN(BrickGrid) grid, HEARTH_IN(BrickStart) start,
                                            Float3 surface, HEARTH_IN(Light) light, Float3 lamp)
{
    BrickIncident incident;
    incident.arrived = Float3(0.0f, 0.0f, 0.0f);
    incident.way = -light.direction;
    incident.far = kBrickFar;
    if (light.type == kBrickLightDirectional)
    {
        incident.arrived = light.intensity * (max(dot(start.normal, incident.way), 0.0f) / kBrickPi);
        return incident;
    }
    Float3 to_light = (light.position - grid.origin) * (1.0f / grid.voxel_size) - surface;
    float distance = sqrt(dot(to_light, to_light));
    float metres = distance * grid.voxel_size;
    if (metres < kBrickLampMetres + 0.5f * grid.voxel_size)
        return incident;
    to_light = to_light * (1.0f / distance);
    float share = max(dot(start.normal, to_light), 0.0f) / (kBrickPi * metres * metres);
    if (light.range > 0.0f)
    {
        float ratio = metres / light.range;
        share *= min(max(1.0f - ratio * ratio * ratio * ratio, 0.0f), 1.0f);
    }
    if (light.type == kBrickLightSpot)
    {
        float cone =
            min(max(light.cone_offset - dot(light.direction, to_light) * light.cone_scale, 0.0f), 1.0f);
        share *= cone * cone;
    }
    Float3 way = lamp - start.place;
    incident.far = sqrt(dot(way, way));
    incident.way = incident.far > 0.0f ? way * (1.0f / incident.far) : start.normal;
    incident.arrived = light.intensity * share;
    return incident;
}

/// Irradiance over pi that a light gives a face through the bricks.
/// surface  brickFaceSurface
HEARTH_FUNCTION Float3 brickDirect(HEARTH_IN(BrickScene) scene, HEARTH_IN(BrickStart) start, Float3 surface,
                                   HEARTH_IN(Light) light)
{
    BrickGrid grid = brickGridOf(brickMasksOf(scene));
    Float3 lamp = Float3(0.0f, 0.0f, 0.0f);
    if (light.type != kBrickLightDirectional)
        lamp = brickLampPlace(scene, (light.position - grid.origin) * (1.0f / grid.voxel_size));
    BrickIncident incident = brickIncident(grid, start, surface, light, lamp);
    if (incident.arrived.x + incident.arrived.y + incident.arrived.z <= 0.0f || incident.far <= 0.0f)
        return incident.arrived;
    return incident.arrived * brickRayThrough(scene, start.place, incident.way, incident.far);
}

/// The radiance that a face sends out.
/// arrived  irradiance over pi, of lights and of rays
HEARTH_FUNCTION Float3 brickSentOut(Float3 emission, Float3 albedo, Float3 arrived)
{
    return emission + Float3(min(albedo.x, kBrickMostAlbedo), min(albedo.y, kBrickMostAlbedo),
                             min(albedo.z, kBrickMostAlbedo)) *
                          arrived;
}

HEARTH_SHARED_END

#endif

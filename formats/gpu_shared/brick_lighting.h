// How the faces of bricks are lit, and how a surface gathers light from them: one iteration of
//     radiance = emission + albedo (direct + mean of what rays bring),
// written once for C++ and GLSL. What rays bring is in brick_rays.h. cook/bricks/README.md, "Light", has the
// reasons, bounds and what was measured.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
//
// Directions and starts are the same in every frame, so that a rotation through all faces is one sweep of Jacobi's iteration
// for a fixed linear system: it converges to one answer, nothing flickers, and a light that went out is forgotten by a factor
// of the albedo each sweep. Nothing is blended over time.
#ifndef HEARTH_SHARED_BRICK_LIGHTING_H
#define HEARTH_SHARED_BRICK_LIGHTING_H

#include "formats/gpu_shared/brick_rays.h"
#include "formats/gpu_shared/shading.h"

HEARTH_SHARED_BEGIN

/// No surface returns more: what is lit by nothing but itself must fade.
HEARTH_CONSTANT float kBrickMostAlbedo = 0.95f;

/// Voxels by which rays start off a slanted surface, along its normal and through the air: so far its stair-stepped neighbours
/// do not hide it from light.
HEARTH_CONSTANT float kBrickLift = 1.0f;

/// Sine of the angle to the nearest axis from which on a surface counts as slanted; below, by its share. What lies along an
/// axis has no steps, and rays that started off it would pass by what stands on it. 0.6 degrees, as finely as normals are
/// stored.
HEARTH_CONSTANT float kBrickSlantSine = 0.01f;

/// Voxels along the normal within which a surface's point finds the air before it.
HEARTH_CONSTANT float kBrickMostBuried = 3.0f;

/// A light has no size: what stands nearer than this, and half of a voxel, would be as bright as one likes. It counts as a part
/// of the lamp and gets none of its light.
HEARTH_CONSTANT float kBrickLampMetres = 0.1f;

HEARTH_CONSTANT float kBrickPi = 3.14159265f;

/// formats::LightType
HEARTH_CONSTANT uint kBrickLightDirectional = 0u;
HEARTH_CONSTANT uint kBrickLightSpot = 2u;

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

// Lights the faces of bricks and gathers global illumination from them. One iteration computes
//     radiance = emission + albedo (direct + mean radiance along rays).
// One source for C++ and GLSL. brick_rays.h traces the rays. cook/bricks/README.md has the reasons, bounds
// and measurements.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
//
// Ray directions and origins are the same in every frame. So one rotation through all faces is one sweep of a
// Jacobi iteration for a fixed linear system: it converges to one answer, nothing flickers, and a light that
// went out fades by a factor of the albedo each sweep. There is no temporal blending.
#ifndef HEARTH_SHARED_BRICK_LIGHTING_H
#define HEARTH_SHARED_BRICK_LIGHTING_H

#include "formats/gpu_shared/brick_rays.h"
#include "formats/gpu_shared/record_values.h"
#include "formats/gpu_shared/reflector.h"
#include "formats/gpu_shared/shading.h"

HEARTH_SHARED_BEGIN

/// Upper bound of a face's albedo: below 1, so that light without a source fades.
HEARTH_CONSTANT float kMaxBrickAlbedo = 0.95f;

/// Distance in voxels by which ray origins are lifted off a slanted surface, along its normal through the
/// air. At this distance the surface's own stair-stepped voxels do not occlude it.
HEARTH_CONSTANT float kBrickLift = 1.0f;

/// Sine of the angle to the nearest axis above which a surface counts as fully slanted; below,
/// proportionally. An axis-aligned surface has no steps, and rays with a lifted origin would pass by objects
/// that stand on it. 0.6 degrees, the precision of stored normals.
HEARTH_CONSTANT float kBrickSlantSine = 0.01f;

/// Voxels by which the origin of a ray lies at most beside the start of its surface point.
HEARTH_CONSTANT float kMaxBrickShift = 3.0f;

/// Voxels along the normal within which a ray from a surface point must reach the air.
HEARTH_CONSTANT float kMaxBrickDepth = 3.0f;

/// Voxels towards the eye within which a ray from a visible surface point must reach the air. The way to the
/// eye is free, up to the eye, whatever voxels say: in the wedge below a roof it leads along the surface.
HEARTH_CONSTANT float kMaxBrickViewDepth = 16.0f;

/// Albedo of surfaces right behind a solid voxel, which a gather does not know: about that of a wall.
HEARTH_CONSTANT float kBrickCloseAlbedo = 0.5f;

/// Radius of a lamp in metres. A point light has no size, so irradiance grows without bound near it. Surfaces
/// nearer than this, or nearer than a voxel, count as part of the lamp and get no light from it.
HEARTH_CONSTANT float kBrickLampRadius = 0.1f;

HEARTH_CONSTANT float kBrickPi = 3.14159265f;

// ---- faces that a frame lights

/// Return the first brick of a frame's slice. The bricks of a frame are contiguous, and so are their faces:
/// one copy moves the results.
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

// ---- origins of rays

/// Position from which a face or a surface point gathers light.
struct BrickStart
{
    Float3 position; ///< position in the air, in voxels
    Float3 surface;  ///< point of the surface, in voxels
    Float3 normal;
    uint is_interior; ///< 1: no air within kMaxBrickDepth; the point gets no light
    /// Mean radiance of the solid voxel right in front of the surface, if rays start beyond that voxel.
    Float3 close;
    float close_opacity; ///< [0, 1]; 0: no such voxel
};

/// Return a start with no voxel close to it.
HEARTH_FUNCTION BrickStart brickStartAt(Float3 position, Float3 surface, Float3 normal)
{
    BrickStart start;
    start.position = position;
    start.surface = surface;
    start.normal = normal;
    start.is_interior = 0u;
    start.close = Float3(0.0f, 0.0f, 0.0f);
    start.close_opacity = 0.0f;
    return start;
}

/// Return 0 for a surface whose normal lies along an axis (its voxels are as flat as it is), 1 for a slanted
/// one.
HEARTH_FUNCTION float brickSlantedness(Float3 normal)
{
    float along = max(max(abs(normal.x), abs(normal.y)), abs(normal.z));
    return min(sqrt(max(1.0f - along * along, 0.0f)) / kBrickSlantSine, 1.0f);
}

/// Return the surface point of a face, in voxels: below the middle of the face.
/// depth  of the surface behind the face, in voxels: decodeFaceDepth
HEARTH_FUNCTION Float3 brickFaceSurface(uint x, uint y, uint z, uint face, float depth)
{
    return brickFaceMiddle(x, y, z, face) - brickFaceAxis(face) * depth;
}

/// Lift a position in the air along the normal: by kBrickLift for a slanted surface, but at most half the
/// distance to the next solid voxel.
HEARTH_FUNCTION Float3 liftBrickPosition(HEARTH_IN(BrickScene) scene, Float3 position, Float3 normal)
{
    float lift = kBrickLift * brickSlantedness(normal);
    BrickRay ray = brickMarch(brickSceneMasks(scene), brickRayInVoxels(brickMasksGrid(brickSceneMasks(scene)),
                                                                       position, normal, lift));
    return position + normal * (ray.inside != 0u ? 0.5f * (ray.start_t + ray.t) : lift);
}

/// Return the start of rays of a face.
/// surface_normal  normal that the face stores
/// surface         point of brickFaceSurface
HEARTH_FUNCTION BrickStart brickFaceStart(HEARTH_IN(BrickScene) scene, uint x, uint y, uint z, uint face,
                                          Float3 surface_normal, Float3 surface)
{
    Float3 normal = brickFaceNormal(surface_normal, face);
    return brickStartAt(liftBrickPosition(scene, brickFaceMiddle(x, y, z, face), normal), surface, normal);
}

/// Return the origin of a ray: the point at the start's height over the surface on the line through the
/// surface point. Rays from the start's position alone would see all that is near as if the surface were
/// nearer to it. Where solid voxels are on the way from the start's position, the origin is in front of them.
HEARTH_FUNCTION Float3 brickRayOrigin(HEARTH_IN(BrickScene) scene, HEARTH_IN(BrickStart) start,
                                      Float3 direction)
{
    float height = dot(start.position - start.surface, start.normal);
    float along = dot(direction, start.normal);
    if (height <= 2.0f * kBrickFaceMargin || along <= 0.0f)
        return start.position;
    Float3 offset = start.surface - start.position + direction * (height / max(along, 0.0625f));
    float distance = sqrt(dot(offset, offset));
    if (distance <= kBrickFaceMargin)
        return start.position;
    float shift = min(distance, kMaxBrickShift);
    offset = offset * (1.0f / distance);
    BrickRay ray = brickMarch(brickSceneMasks(scene), brickRayInVoxels(brickMasksGrid(brickSceneMasks(scene)),
                                                                       start.position, offset, shift));
    return start.position + offset * (ray.inside != 0u ? 0.0f : shift);
}

/// True if the ray's voxel is solid: a march without a step began in a solid voxel.
HEARTH_FUNCTION bool brickIsInSolid(HEARTH_IN(BrickScene) scene, HEARTH_IN(BrickRay) ray)
{
    BrickRay met = brickMarch(brickSceneMasks(scene), ray);
    return met.inside != 0u && met.steps == ray.steps;
}

/// Return the start for a point of a surface, which mostly lies in a solid voxel: march along a direction
/// into the air.
/// position   in voxels
/// direction  unit, to the lit side; it is the start's normal
/// max_depth  voxels within which the ray must reach the air
HEARTH_FUNCTION BrickStart brickStartAlong(HEARTH_IN(BrickScene) scene, Float3 position, Float3 direction,
                                           float max_depth)
{
    BrickRay ray = brickRayInVoxels(brickMasksGrid(brickSceneMasks(scene)), position, direction, max_depth);
    while (brickIsInSolid(scene, ray))
        ray = brickSkipVoxel(brickSceneMasks(scene), ray);
    // without a step, the point is already in the air
    float out_t = ray.steps > 0u ? ray.start_t + ray.t : 0.0f;
    BrickStart start = brickStartAt(position, position, direction);
    start.is_interior = out_t >= max_depth ? 1u : 0u;
    out_t += ray.steps > 0u ? kBrickFaceMargin : 0.0f;
    if (start.is_interior == 0u)
        start.position = liftBrickPosition(scene, position + direction * out_t, direction);
    return start;
}

/// Return the start along the normal.
/// normal  unit, on the lit side
HEARTH_FUNCTION BrickStart brickSurfaceStart(HEARTH_IN(BrickScene) scene, Float3 position, Float3 normal)
{
    return brickStartAlong(scene, position, normal, kMaxBrickDepth);
}

/// Return the start with the ray's solid voxel as the close voxel in front of it. Its faces have its light
/// towards the air, and what the surface reflects of its light towards the surface. So of the sides, which
/// have equal parts, all faces are there, and a part of the one towards the surface.
HEARTH_FUNCTION BrickStart withCloseVoxel(HEARTH_IN(BrickScene) scene, BrickStart start,
                                          HEARTH_IN(BrickRay) ray)
{
    BrickRay met = brickMarch(brickSceneMasks(scene), ray);
    Brick brick = brickAt(brickSceneMasks(scene), met.brick);
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
    start.close = start.close * (1.0f / (count + kBrickCloseAlbedo));
    start.close_opacity = count > 0.0f ? brickOpacityAt(scene, brickVoxel(brick, met.bit)) : 0.0f;
    return start;
}

/// Return the fraction of a start's light that comes from its close voxel, where rays bring the radiance
/// `mean`. The fraction is 0 if the close voxel is darker: a grid cannot tell if the voxel occludes the
/// surface, but it does tell that the voxel emits light.
HEARTH_FUNCTION float brickCloseFraction(HEARTH_IN(BrickStart) start, Float3 mean)
{
    float more = start.close.x + start.close.y + start.close.z - mean.x - mean.y - mean.z;
    return more > 0.0f ? start.close_opacity : 0.0f;
}

/// Return the start for a visible surface point: in the air in front of it. Where other bricks stand there,
/// as in the corners of rooms, the start lies in the air between the point and the eye.
/// to_eye  vector from the position to the eye, in voxels
HEARTH_FUNCTION BrickStart brickVisibleStart(HEARTH_IN(BrickScene) scene, Float3 position, Float3 normal,
                                             Float3 to_eye)
{
    BrickStart start = brickSurfaceStart(scene, position, normal);
    Float3 direction = start.position - position;
    float slant = brickSlantedness(normal);
    BrickRay own = brickRayInVoxels(brickMasksGrid(brickSceneMasks(scene)),
                                    position - normal * (kBrickPlaneTolerance + kBrickFaceMargin), normal,
                                    kMaxBrickDepth);
    BrickRay next = brickSkipVoxel(brickSceneMasks(scene), own);
    // beyond this distance the ray has left a voxel that is not the surface's own
    float own_way = brickIsInSolid(scene, own) ? next.start_t + next.t : 1.0f;
    float most = own_way + (1.0f - own_way + kBrickLift) * slant + 0.25f;
    if (start.is_interior == 0u && dot(direction, direction) <= most * most)
        return start;
    float eye_distance = sqrt(dot(to_eye, to_eye));
    start = brickStartAlong(scene, position, to_eye * (1.0f / max(eye_distance, kBrickFaceMargin)),
                            max(min(eye_distance, kMaxBrickViewDepth), kBrickFaceMargin));
    start.normal = normal;
    if (brickIsInSolid(scene, next))
        start = withCloseVoxel(scene, start, next);
    return start;
}

/// Return the mean radiance along cosine-distributed rays from a start: irradiance over pi of all light
/// except lamps and suns.
HEARTH_FUNCTION Float3 brickGather(HEARTH_IN(BrickScene) scene, HEARTH_IN(Sky) sky,
                                   HEARTH_IN(BrickStart) start, uint count, uint seed)
{
    Float3 sum = Float3(0.0f, 0.0f, 0.0f);
    for (uint i = 0u; i < count; ++i)
    {
        Float3 direction = brickRayDirection(start.normal, i, count, seed);
        sum = sum + brickRayLight(scene, sky, brickRayOrigin(scene, start, direction), direction).radiance;
    }
    if (start.is_interior != 0u)
        return Float3(0.0f, 0.0f, 0.0f);
    Float3 mean = sum * (1.0f / float(count));
    return mean + (start.close - mean) * brickCloseFraction(start, mean);
}

// ---- lights

HEARTH_FUNCTION bool brickSolid(HEARTH_IN(BrickScene) scene, int x, int y, int z)
{
    BrickGrid grid = brickMasksGrid(brickSceneMasks(scene));
    if (uint(x) >= grid.voxels_x || uint(y) >= grid.voxels_y || uint(z) >= grid.voxels_z)
        return false;
    uint group_index =
        (uint(x) >> 4) + brickGroupsAlongAxis(grid.voxels_x) *
                             ((uint(y) >> 4) + brickGroupsAlongAxis(grid.voxels_y) * (uint(z) >> 4));
    BrickGroup group = brickGroupAt(brickSceneMasks(scene), group_index);
    uint bit = brickBit(uint(x) >> 2, uint(y) >> 2, uint(z) >> 2);
    if (!maskHas(group.brick_mask_low, group.brick_mask_high, bit))
        return false;
    Brick brick =
        brickAt(brickSceneMasks(scene),
                group.first_brick + maskCountBelow(group.brick_mask_low, group.brick_mask_high, bit));
    return maskHas(brick.voxel_mask_low, brick.voxel_mask_high, brickBit(uint(x), uint(y), uint(z)));
}

/// Return the position from which a lamp shines through the bricks, in voxels: its own position if that is in
/// the air. Lamps stand in their shades and beside their bulbs, which fill their voxel; then it is the middle
/// of the nearest neighbouring voxel of air, of two the lower one. Without such a voxel the lamp's own
/// position is returned. The result does not depend on the face, so a frame may compute it once.
/// lamp  position in voxels
HEARTH_FUNCTION Float3 brickLampPosition(HEARTH_IN(BrickScene) scene, Float3 lamp)
{
    Float3 low = Float3(floor(lamp.x), floor(lamp.y), floor(lamp.z));
    // beyond this bound all is air, and the coordinates would overflow an int
    float most = max(max(abs(lamp.x), abs(lamp.y)), abs(lamp.z));
    if (most > 32768.0f || !brickSolid(scene, int(low.x), int(low.y), int(low.z)))
        return lamp;
    Float3 position = lamp;
    float nearest = kBrickInfinity;
    for (int i = 0; i < 27; ++i)
    {
        int x = i % 3 - 1;
        int z = i / 3 % 3 - 1;
        int y = i / 9 - 1;
        Float3 middle = low + Float3(float(x) + 0.5f, float(y) + 0.5f, float(z) + 0.5f);
        Float3 direction = middle - lamp;
        float distance2 = dot(direction, direction);
        if (distance2 < nearest && !brickSolid(scene, int(low.x) + x, int(low.y) + y, int(low.z) + z))
        {
            nearest = distance2;
            position = middle;
        }
    }
    return position;
}

/// Unoccluded light of a lamp or sun at a face, and the shadow ray that tests it.
struct BrickUnshadowedLight
{
    Float3 irradiance;       ///< irradiance over pi; 0: no shadow ray is needed
    Float3 direction;        ///< unit, direction of the shadow ray
    float distance_to_light; ///< distance to the light, in voxels
};

/// Return the distance from a lamp up to which faces get none of its light, metres: voxels do not resolve
/// what surrounds it. Up to the same distance a reflector holds the light that surfaces give back.
HEARTH_FUNCTION float brickLampReach(uint reflector_gain, float voxel_size)
{
    return max(kBrickLampRadius, voxel_size * (reflector_gain == kNoReflector ? 1.0f : kReflectorReach));
}

/// Compute the unoccluded light of a face. Distance and angle are measured at the surface point.
/// lamp     position from which the light shines, in voxels: brickLampPosition, or its own position. Ignored
///          for suns
HEARTH_FUNCTION BrickUnshadowedLight brickUnshadowedLight(HEARTH_IN(BrickGrid) grid,
                                                          HEARTH_IN(BrickStart) start, HEARTH_IN(Light) light,
                                                          Float3 lamp)
{
    BrickUnshadowedLight incident;
    incident.irradiance = Float3(0.0f, 0.0f, 0.0f);
    incident.direction = -light.direction;
    incident.distance_to_light = kBrickInfinity;
    if (light.type == kLightDirectional)
    {
        incident.irradiance = light.intensity * (max(dot(start.normal, incident.direction), 0.0f) / kBrickPi);
        return incident;
    }
    Float3 to_light = (light.position - grid.origin) * (1.0f / grid.voxel_size) - start.surface;
    float distance = sqrt(dot(to_light, to_light));
    float metres = distance * grid.voxel_size;
    if (metres < brickLampReach(light.reflector_gain, grid.voxel_size))
        return incident;
    to_light = to_light * (1.0f / distance);
    float share = max(dot(start.normal, to_light), 0.0f) / (kBrickPi * metres * metres);
    if (light.range > 0.0f)
    {
        float ratio = metres / light.range;
        share *= min(max(1.0f - ratio * ratio * ratio * ratio, 0.0f), 1.0f);
    }
    Float3 shone = Float3(1.0f, 1.0f, 1.0f);
    if (light.type == kLightSpot)
    {
        float cone =
            min(max(light.cone_offset - dot(light.direction, to_light) * light.cone_scale, 0.0f), 1.0f);
        shone = shone * (cone * cone);
    }
    shone = shone * reflectorPassed(light, -to_light) + reflectorShare(light, -to_light);
    Float3 direction = lamp - start.position;
    incident.distance_to_light = sqrt(dot(direction, direction));
    incident.direction =
        incident.distance_to_light > 0.0f ? direction * (1.0f / incident.distance_to_light) : start.normal;
    incident.irradiance = light.intensity * shone * share;
    return incident;
}

/// Return the irradiance over pi that a light gives a face through the bricks.
HEARTH_FUNCTION Float3 brickDirect(HEARTH_IN(BrickScene) scene, HEARTH_IN(BrickStart) start,
                                   HEARTH_IN(Light) light)
{
    BrickGrid grid = brickMasksGrid(brickSceneMasks(scene));
    Float3 lamp = Float3(0.0f, 0.0f, 0.0f);
    if (light.type != kLightDirectional)
        lamp = brickLampPosition(scene, (light.position - grid.origin) * (1.0f / grid.voxel_size));
    BrickUnshadowedLight incident = brickUnshadowedLight(grid, start, light, lamp);
    if (incident.irradiance.x + incident.irradiance.y + incident.irradiance.z <= 0.0f ||
        incident.distance_to_light <= 0.0f)
        return incident.irradiance;
    return incident.irradiance *
           brickTransmittance(scene, start.position, incident.direction, incident.distance_to_light);
}

/// Return the outgoing radiance of a face.
/// irradiance  over pi, of lights and of rays
HEARTH_FUNCTION Float3 brickOutgoingRadiance(Float3 emission, Float3 albedo, Float3 irradiance)
{
    return emission + Float3(min(albedo.x, kMaxBrickAlbedo), min(albedo.y, kMaxBrickAlbedo),
                             min(albedo.z, kMaxBrickAlbedo)) *
                          irradiance;
}

HEARTH_SHARED_END

#endif

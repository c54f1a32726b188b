// Decides which boxes of clusters a light reaches, in view space: the light's balls have to meet the box, and
// none of seven planes may part it from the sector of a cone, as for the cells of light_cells.h. One source
// for C++ and GLSL.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_LIGHT_BOXES_H
#define HEARTH_SHARED_LIGHT_BOXES_H

#include "formats/gpu_shared/light_cells.h"

HEARTH_SHARED_BEGIN

/// Box in view space.
struct LightBox
{
    Float3 low;
    Float3 high;
};

/// Middle of a box along an axis, and what the box reaches from there.
struct LightExtent
{
    float middle;
    float reach;
};

/// Measure a box of an instance along a unit vector.
/// center, half_size  of the box; relative: the centre as seen from the eye
HEARTH_FUNCTION LightExtent measureBox(HEARTH_IN(Instance) instance, Float3 axis, Float3 relative,
                                       Float3 half_size)
{
    HEARTH_PRECISE Float3 along = row3(instance.world_from_object_x) * axis.x +
                                  row3(instance.world_from_object_y) * axis.y +
                                  row3(instance.world_from_object_z) * axis.z;
    LightExtent extent;
    extent.middle = dot3(axis, relative);
    extent.reach = dot3(abs3(along), half_size);
    return extent;
}

/// Return the box in view space around a box of an instance, grown by more than the roundings of what is
/// drawn in it.
/// eye  of the view, in the space to which the instance transforms
HEARTH_FUNCTION LightBox lightBox(HEARTH_IN(LightGrid) grid, HEARTH_IN(Instance) instance, Float3 eye,
                                  Float3 box_min, Float3 box_max)
{
    HEARTH_PRECISE Float3 center = (box_min + box_max) * 0.5f;
    HEARTH_PRECISE Float3 half_size = (box_max - box_min) * 0.5f;
    Float3 relative = toEyeRelative(instance, eye, center);
    // magnitude of the terms that rounding errors are relative to, in any direction
    Float3 reach = abs3(center) + half_size;
    HEARTH_PRECISE float magnitude =
        (dot3(abs3(row3(instance.world_from_object_x)), reach) +
         abs(instance.world_from_object_x.w - eye.x)) +
        (dot3(abs3(row3(instance.world_from_object_y)), reach) +
         abs(instance.world_from_object_y.w - eye.y)) +
        (dot3(abs3(row3(instance.world_from_object_z)), reach) + abs(instance.world_from_object_z.w - eye.z));
    HEARTH_PRECISE float slack = magnitude * kRoundingSlack;
    LightExtent x = measureBox(instance, grid.right, relative, half_size);
    LightExtent y = measureBox(instance, grid.down, relative, half_size);
    LightExtent z = measureBox(instance, grid.forward, relative, half_size);
    HEARTH_PRECISE Float3 middle = Float3(x.middle, y.middle, z.middle);
    HEARTH_PRECISE Float3 half_box = Float3(x.reach + slack, y.reach + slack, z.reach + slack);
    HEARTH_PRECISE Float3 low = middle - half_box;
    HEARTH_PRECISE Float3 high = middle + half_box;
    LightBox box;
    box.low = low;
    box.high = high;
    return box;
}

/// True if a ball meets a box.
HEARTH_FUNCTION bool isBallInBox(Float3 center, float radius, HEARTH_IN(LightBox) box)
{
    HEARTH_PRECISE float x = max(max(box.low.x - center.x, center.x - box.high.x), 0.0f);
    HEARTH_PRECISE float y = max(max(box.low.y - center.y, center.y - box.high.y), 0.0f);
    HEARTH_PRECISE float z = max(max(box.low.z - center.z, center.z - box.high.z), 0.0f);
    HEARTH_PRECISE float distance2 = (x * x + y * y) + z * z;
    HEARTH_PRECISE float radius2 = radius * radius;
    return distance2 <= radius2;
}

/// True if a sector is wholly beside a box along one axis of the view.
/// apex, axis  coordinates of the cone along it
HEARTH_FUNCTION bool isSectorBesideBox(HEARTH_IN(CellLight) light, float apex, float axis, float low,
                                       float high)
{
    HEARTH_PRECISE float greatest = (apex + sectorReach(light, axis)) + light.slack;
    HEARTH_PRECISE float least = (apex - sectorReach(light, -axis)) - light.slack;
    return greatest < low || least > high;
}

/// True if the plane that touches a cone nearest to the middle of a box has the box on its outer side.
HEARTH_FUNCTION bool isBoxBesideCone(HEARTH_IN(CellLight) light, HEARTH_IN(LightBox) box)
{
    HEARTH_PRECISE Float3 middle = (box.low + box.high) * 0.5f;
    Float3 normal = coneNormal(light, middle);
    HEARTH_PRECISE float least = (min(normal.x * box.low.x, normal.x * box.high.x) +
                                  min(normal.y * box.low.y, normal.y * box.high.y)) +
                                 min(normal.z * box.low.z, normal.z * box.high.z);
    HEARTH_PRECISE float beside = least - dot3(normal, light.apex);
    return beside > light.slack;
}

/// True unless a light reaches no point of a box: its balls miss it, or one of seven planes parts them as in
/// reachesCell.
HEARTH_FUNCTION bool reachesBox(HEARTH_IN(CellLight) light, HEARTH_IN(LightBox) box)
{
    if (!isBallInBox(light.center, light.radius, box))
        return false;
    if (light.cosine < 0.0f)
        return true;
    CellLight ranged = rangeBall(light);
    return isBallInBox(ranged.center, ranged.radius, box) &&
           !isSectorBesideBox(light, light.apex.x, light.axis.x, box.low.x, box.high.x) &&
           !isSectorBesideBox(light, light.apex.y, light.axis.y, box.low.y, box.high.y) &&
           !isSectorBesideBox(light, light.apex.z, light.axis.z, box.low.z, box.high.z) &&
           !isBoxBesideCone(light, box);
}

HEARTH_SHARED_END

#endif

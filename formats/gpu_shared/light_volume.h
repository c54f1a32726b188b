// Solid around all that a ranged light reaches, as triangles: a cone of eight sides with a flat base for a
// narrow spot, else an icosahedron around its least ball. One source for C++ and GLSL.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_LIGHT_VOLUME_H
#define HEARTH_SHARED_LIGHT_VOLUME_H

#include "formats/gpu_shared/light_cells.h"

HEARTH_SHARED_BEGIN

/// Vertices of a volume: twenty triangles, counterclockwise from outside. A cone has fewer: the others are
/// points, so that no pixel is drawn twice.
HEARTH_CONSTANT uint kLightVolumeVertices = 60;
HEARTH_CONSTANT uint kLightConeSides = 8;
HEARTH_CONSTANT uint kLightConeVertices = 42;

/// Radius of the corners of an icosahedron around a ball of radius 1, and a little for rounding.
HEARTH_CONSTANT float kIcosahedronScale = 1.2586f;
/// The same of an octagon around a circle.
HEARTH_CONSTANT float kOctagonScale = 1.0825f;

/// Corner of an icosahedron, of length 1: 0 and 11 are poles along z, with a ring of five behind each.
HEARTH_FUNCTION Float3 icosahedronCorner(uint corner)
{
    if (corner == 0u || corner == 11u)
        return Float3(0.0f, 0.0f, corner == 0u ? 1.0f : -1.0f);
    uint number = corner - 1u;
    bool upper = number < 5u;
    float turn = 1.2566370614f * (float(number % 5u) + (upper ? 0.0f : 0.5f));
    return Float3(0.894427191f * cos(turn), 0.894427191f * sin(turn), upper ? 0.4472135955f : -0.4472135955f);
}

/// Number of the corner at a vertex: five triangles around each pole, ten between.
HEARTH_FUNCTION uint icosahedronIndex(uint vertex)
{
    uint triangle = vertex / 3u;
    uint corner = vertex % 3u;
    uint a = triangle % 5u;
    uint b = (a + 1u) % 5u;
    if (triangle < 5u)
        return corner == 0u ? 0u : corner == 1u ? 1u + a : 1u + b;
    if (triangle < 10u)
        return corner == 0u ? 1u + a : corner == 1u ? 6u + a : 1u + b;
    if (triangle < 15u)
        return corner == 0u ? 1u + b : corner == 1u ? 6u + a : 6u + b;
    return corner == 0u ? 11u : corner == 1u ? 6u + b : 6u + a;
}

/// Corner of a cone along z with its apex at 0: sides, then the base.
HEARTH_FUNCTION Float3 lightConeCorner(uint vertex, float base_radius, float height)
{
    uint triangle = vertex / 3u;
    uint corner = vertex % 3u;
    bool is_side = triangle < kLightConeSides;
    if (is_side && corner == 0u)
        return Float3(0.0f, 0.0f, 0.0f);
    uint place = is_side ? triangle + 2u - corner : corner == 0u ? 0u : triangle - kLightConeSides + corner;
    float turn = 0.785398163f * float(place);
    return Float3(base_radius * cos(turn), base_radius * sin(turn), height);
}

/// Return a vertex of a light's volume in the space of the light.
/// vertex  below kLightVolumeVertices
HEARTH_FUNCTION Float3 lightVolumeCorner(HEARTH_IN(CellLight) light, uint vertex)
{
    if (light.cosine <= light.sine)
        return light.center +
               icosahedronCorner(icosahedronIndex(vertex)) * (light.radius * kIcosahedronScale);
    // begins behind the apex, so that the cone has grown by the slack on all sides
    float behind = light.slack / max(light.sine, 1e-4f);
    float height = light.range + light.slack + behind;
    float base_radius = height * light.sine / light.cosine * kOctagonScale;
    uint last = kLightConeVertices - 1u;
    Float3 local = lightConeCorner(vertex < last ? vertex : last, base_radius, height);
    Float3 axis = light.axis;
    Float3 across = abs(axis.x) < 0.5f ? Float3(0.0f, axis.z, -axis.y) : Float3(-axis.z, 0.0f, axis.x);
    across = across * (1.0f / sqrt(dot3(across, across)));
    Float3 other = Float3(axis.y * across.z - axis.z * across.y, axis.z * across.x - axis.x * across.z,
                          axis.x * across.y - axis.y * across.x);
    return light.apex + across * local.x + other * local.y + axis * (local.z - behind);
}

/// True if a point in the space of the light is in its volume.
HEARTH_FUNCTION bool isInLightVolume(HEARTH_IN(CellLight) light, Float3 place)
{
    for (uint vertex = 0u; vertex < kLightVolumeVertices; vertex += 3u)
    {
        Float3 a = lightVolumeCorner(light, vertex);
        Float3 u = lightVolumeCorner(light, vertex + 1u) - a;
        Float3 v = lightVolumeCorner(light, vertex + 2u) - a;
        Float3 normal = Float3(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x);
        if (dot3(normal, place - a) > 0.0f)
            return false;
    }
    return true;
}

HEARTH_SHARED_END

#endif

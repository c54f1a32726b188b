// Finds the face of a cube that a direction meets, and the place there. One source for C++ and GLSL.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_CUBE_H
#define HEARTH_SHARED_CUBE_H

#include "formats/gpu_shared/language.h"

HEARTH_SHARED_BEGIN

/// Place of a direction in a cube: across / depth and down / depth run from -1 to 1, rightwards and
/// downwards.
struct CubePlace
{
    uint panel; ///< face, in the order of a cube map
    float across;
    float down;
    float depth; ///< above 0
};

/// Return the place of a direction.
/// direction  of any length but 0
/// source     Vulkan 1.3, section "Cube Map Face Selection"
HEARTH_FUNCTION CubePlace findCubePlace(Float3 direction)
{
    float x = abs(direction.x);
    float y = abs(direction.y);
    float z = abs(direction.z);
    bool is_z = z >= x && z >= y;
    bool is_y = !is_z && y >= x;
    float major = is_z ? direction.z : (is_y ? direction.y : direction.x);
    CubePlace place;
    place.panel = (is_z ? 4u : (is_y ? 2u : 0u)) + (major < 0.0f ? 1u : 0u);
    place.across = is_z ? (major < 0.0f ? -direction.x : direction.x)
                        : (is_y ? direction.x : (major < 0.0f ? direction.z : -direction.z));
    place.down = is_y ? (major < 0.0f ? -direction.z : direction.z) : -direction.y;
    place.depth = abs(major);
    return place;
}

HEARTH_SHARED_END

#endif

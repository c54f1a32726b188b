// Selects the clusters that are drawn into a shadow map, by the same tests as for the camera's image
// (decisions.h), with other planes and a coarser cut. C++ only.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/shadow.h"

namespace hearth::shared
{

/// Return the view that selects the shadow casters of a map: clusters between its sides, and in front of
/// the light or within its range. The cut is that of the camera's image with less weight for errors, seen
/// from the camera and not from the light. Otherwise a surface would be cast by a level far from the
/// displayed one, and shadow itself. Normal cones and occlusion are not tested: a cluster that faces away
/// from the camera casts shadows as well.
///
/// view            of the camera's image; its clip rows are kept and have no meaning for a map
/// range           of the light in metres: farther casters shadow nothing. 0: unlimited
/// error_bias      BiasLODError, 1 or more: factor by which a shadow may be coarser than the image
FrameView makeCasterView(const FrameView& view, const ShadowLight& light, const ShadowMap& map,
                         float error_bias, float range = 0);

/// Position of the eye for LOD selection of casters, in place of the camera: the centre of a grid cell, so
/// that shadow maps can be cached while the camera moves within the cell.
struct EyeCell
{
    Float3 eye;      ///< world
    float shift = 0; ///< maximum distance of the centre from any point of the cell, metres
};

/// Return the largest cell, with a power of two as its side, that makes the casters' error grow by no more
/// than half a texel, which is not visible in the map.
///
/// texel_m         metres that the finest texel covers; above 0
/// error_bias      as in makeCasterView
EyeCell findEyeCell(const FrameView& view, float texel_m, float error_bias);

} // namespace hearth::shared

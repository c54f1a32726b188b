// C++ only: which clusters are drawn into a shadow map. The same tests as for a picture (decisions.h), with other
// planes and a coarser cut.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/shadow.h"

namespace hearth::shared
{

/// The view that finds the casters of a map: what lies between its sides and before a spot. The cut is that of the
/// picture, with errors counted less, seen from the camera and not from the light: else a surface would be cast by
/// one of its levels far from the one that is shown, and shadow itself. Normal cones and hidden clusters are not
/// looked at: what faces away from the camera casts as well.
///
/// view            of the picture; its clip rows stay as they are and mean nothing to a map
/// error_bias      BiasLODError, 1 or more: by how many times a shadow may be coarser than the picture
FrameView makeCasterView(const FrameView& view, const ShadowLight& light, const ShadowMap& map,
                         float error_bias);

/// Where the eye of the casters' views stands in place of the picture's: in the middle of a cell of a grid, so that maps can
/// be kept while the eye moves within it.
struct EyeCell
{
    Float3 eye;      ///< world
    float shift = 0; ///< farthest that the cell's middle is from anything in it, metres
};

/// The largest cells, with a power of two as their side, that make the casters' error grow by no more than half a texel: what
/// is drawn coarser for it is not seen in the map.
///
/// texel_m         metres that the finest texel covers; above 0
/// error_bias      as makeCasterView
EyeCell eyeCell(const FrameView& view, float texel_m, float error_bias);

} // namespace hearth::shared

// C++ only: which clusters are drawn into a shadow map. The same tests as for a picture (decisions.h), with other
// planes and a coarser cut.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/shared/shadow.h"

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

} // namespace hearth::shared

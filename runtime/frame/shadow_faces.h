// Finds the faces of point lights that shade something in the view. C++ only.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/shadow.h"

namespace hearth::shared
{

/// True if a point in the view may look up a face of a point light: false only if the pyramid of the face, as
/// far as the light reaches, lies outside of the view. Allows for the errors by which points are moved before
/// they look up shadows, where the cut is as the view asks for.
///
/// view   of the image
/// face   projection of the face, of half-width kFaceTangent
/// range  of the light in metres; 0: unlimited
bool mayShowFace(const FrameView& view, const ShadowLight& face, float range);

} // namespace hearth::shared

// hearth diff --image without a camera: computes one that has the scenes of both packs in view.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <string>

namespace hearth::command
{

/// Compute a camera at the side and above that has the boxes of all instances of both packs in view. Both
/// images use it, so that they differ only where the packs do.
/// size     of the image, "WIDTHxHEIGHT"; treated as square if it is invalid, which hearth-render reports
/// returns  PX,PY,PZ,TX,TY,TZ,FOV, as hearth-render takes it
std::string makeDiffCamera(const formats::PackView& a, const formats::PackView& b, const std::string& size);

} // namespace hearth::command

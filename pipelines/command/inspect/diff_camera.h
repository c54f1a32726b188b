// hearth diff --picture without a camera: one that has the scenes of both packs in view.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <string>

namespace hearth::command
{

/// A camera at the side and above, so far away that the boxes of all instances of both packs are in view:
/// one for both pictures, so that they differ only where the packs do.
/// size     of the picture, "WIDTHxHEIGHT"; taken as square where it is none, of which hearth-render tells
/// returns  PX,PY,PZ,TX,TY,TZ,FOV, as hearth-render takes it
std::string cameraOfBoth(const formats::PackView& a, const formats::PackView& b, const std::string& size);

} // namespace hearth::command

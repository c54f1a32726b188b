// hearth diff --picture without a camera: one that has the scenes of both packs in view.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack_view.h"

#include <string>

namespace hearth::command
{

/// From the side and above, so far away that the boxes of all instances are in view, those of either pack where they are of
/// different sizes: one camera for both, so that only what differs differs.
/// size     of the picture, "WIDTHxHEIGHT"; taken as square where it is none, of which hearth-render tells
/// returns  PX,PY,PZ,TX,TY,TZ,FOV, as hearth-render takes it
std::string cameraOfBoth(const formats::PackView& a, const formats::PackView& b, const std::string& size);

} // namespace hearth::command

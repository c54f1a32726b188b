// Sources in a few lines, with files beside them: what a cook has to keep an eye on.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/support/sandbox.h"

#include <string>

namespace hearth::test
{

/// A quad of that height: NAME.obj, NAME.mtl, and NAME.tga of one grey.
void writeObj(const Sandbox& folder, const std::string& name, double height = 1, int grey = 128);

/// An uncompressed TGA image of 2 x 2 texels.
std::string tgaImage(int grey);

/// A triangle whose top is at x = `top` from 0 to 1, by which NAME.bin alone differs: NAME.gltf, NAME.bin, and a texture
/// NAME.tga that is not there.
void writeGltf(const Sandbox& folder, const std::string& name, float top = 0);

} // namespace hearth::test

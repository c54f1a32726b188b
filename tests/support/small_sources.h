// Sources of a few lines with further files beside them, as inputs of incremental builds.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/support/sandbox.h"

#include <string>

namespace hearth::test
{

/// Write a quad of this height: NAME.obj, NAME.mtl, and NAME.tga with one grey value.
void writeObj(const Sandbox& folder, const std::string& name, double height = 1, int grey = 128);

/// Return an uncompressed TGA image of 2 x 2 texels.
std::string tgaImage(int grey);

/// Write a triangle whose top is at x = `top` from 0 to 1; only NAME.bin depends on it. Files: NAME.gltf,
/// NAME.bin, and a reference to a missing texture NAME.tga.
void writeGltf(const Sandbox& folder, const std::string& name, float top = 0);

} // namespace hearth::test

// Sources whose scene has an image-based light.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/double3.h"
#include "tests/support/sandbox.h"

#include <functional>
#include <string>

namespace hearth::test
{

/// Radiance by direction, which is of any length.
using Sky = std::function<Double3(Double3 direction)>;

/// Texels along a side of the images of writeGltfUnderSky.
inline constexpr uint32_t kSkySourceSide = 16;

/// Write the triangle of writeGltf under a sky: NAME.gltf, NAME.bin, NAME.tga, and six photographs of the
/// sky in RGBD, NAME0.tga to NAME5.tga.
void writeGltfUnderSky(const Sandbox& folder, const std::string& name, const Sky& sky);

} // namespace hearth::test

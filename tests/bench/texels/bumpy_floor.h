// A bumpy floor under the sun, and the light that it reflects at a distance, summed over many points of
// each pixel from the finest normals. It knows nothing of mips or of the renderer.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/frame/frame.h"
#include "sample_assets/shapes/document.h"

#include <cstdint>

namespace hearth::bench
{

struct BumpyFloor
{
    float slope = 0.2f;     ///< root mean square of the slopes of its bumps, in each direction; 0: it is flat
    float roughness = 0.3f; ///< in a texture of one value
    float elevation_deg = 30; ///< of the eye and of the sun, which is where the floor mirrors it to the eye
    float sun = 2;            ///< lux; no more than the key of the exposure rule, which would dim it
};

/// Return the floor of black plastic with its sun, as a source. All that it reflects is specular.
samples::Document makeBumpyFloor(const BumpyFloor& floor);

/// Return a camera whose picture the floor fills, fifteen metres away at its middle.
shared::Camera floorCamera(const BumpyFloor& floor);

/// Return the radiance of the sun's reflection, as the mean over a picture of the camera. The lobe is that of
/// glTF 2.0, appendix B.
/// points_per_side  points a pixel: its square
double reflectedSun(const BumpyFloor& floor, uint32_t width, uint32_t height, uint32_t points_per_side);

} // namespace hearth::bench

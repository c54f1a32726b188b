// Generates a boulder: a sphere cut by random planes, roughened by ridges and fractal noise, and its
// textures.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/shapes/document.h"

namespace hearth::samples
{

/// Make a closed mesh of about `triangle_count` triangles (12 n^2 for some n), about 1 m in radius, around
/// the origin. Six UV charts, one for each side of the cube that is projected to the sphere; `uv_repeat`
/// texture tiles a side.
TriangleMesh makeRock(uint64_t triangle_count, uint32_t seed, float uv_repeat);

/// Add a material with base colour, occlusion-roughness-metallic and normal image of `size` texels; return
/// its index.
int addRockMaterial(Document& document, uint32_t size);

} // namespace hearth::samples

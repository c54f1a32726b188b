// Compares the scenes of two packs: what a way to glTF and back may not change.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <array>
#include <compare>
#include <string>
#include <vector>

namespace hearth::test
{

/// Triangle that can be sorted: nine coordinates from its smallest corner on, and its material.
struct SortedTriangle
{
    std::array<float, 9> positions;
    uint32_t material; ///< or kInvalidIndex
    friend auto operator<=>(const SortedTriangle&, const SortedTriangle&) = default;
};

SortedTriangle sortCorners(const std::array<Float3, 3>& corners, uint32_t material);

/// Return the finest triangles that instances draw, each as often as it is drawn, in object space; sorted.
std::vector<SortedTriangle> findDrawnTriangles(const formats::PackView& pack);

/// Differences in words; none: the packs agree.
using Differences = std::vector<std::string>;

/// Compare the triangles of findDrawnTriangles. The order of meshes, clusters and vertices is free.
Differences compareTriangles(const formats::PackView& a, const formats::PackView& b);

/// Compare the transforms of instances with those of their meshes, as multisets, to 1e-6 of the scene.
Differences compareInstances(const formats::PackView& a, const formats::PackView& b);

/// Compare factors, modes, flags, samplers and layers of all materials. Transforms of textures may differ by
/// the rounding of an angle.
Differences compareMaterials(const formats::PackView& a, const formats::PackView& b);

/// Compare the finest texels of all textures of materials, by their material and slot.
/// max_step  largest difference of a channel that shaders read, in 1/65535
Differences compareTexels(const formats::PackView& a, const formats::PackView& b, uint32_t max_step);

/// Compare the finest texels with those of the source where an image of `encoded` has a lossy format: their
/// root mean square error, in the units of ImageRecord::error, may be twice the error that it states.
/// source  pack with the source's texels
/// decoded  pack that was cooked from the glTF file of `encoded`, with that file's texels
Differences compareLoss(const formats::PackView& source, const formats::PackView& encoded,
                        const formats::PackView& decoded);

/// Compare nodes, lights, cameras, skins and extras.
Differences compareScenes(const formats::PackView& a, const formats::PackView& b);

/// Compare clips: where they take the vertices of instances at many times. The distance may be the sum
/// of both clips' errors.
Differences compareClips(const formats::PackView& a, const formats::PackView& b);

} // namespace hearth::test

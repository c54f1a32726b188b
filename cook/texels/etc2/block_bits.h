// Writes the bits of ETC2's blocks of colours.
// Source: Khronos Data Format Specification 1.3, chapter 21.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/etc2/halves_search.h"
#include "cook/texels/etc2/paint_search.h"
#include "cook/texels/etc2/planar_search.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace hearth::texels
{

/// Return the block of a solution, each texel with its best index.
std::array<std::byte, 8> writeHalves(const Block8& block, const HalvesSolution& solution,
                                     const ColorWeights& weights);
/// The same. If the order of H's colours is not that which the distance asks for, they change places.
std::array<std::byte, 8> writePaints(const Block8& block, PaintSolution solution,
                                     const ColorWeights& weights);
std::array<std::byte, 8> writePlanar(const PlanarSolution& solution);

} // namespace hearth::texels

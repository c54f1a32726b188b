// Keeps the area of alpha-tested cut-outs in mips: without it leaves and grass thin out with distance.
// Source: I. Castano, "Computing Alpha Mipmaps", 2010; differs: the scale comes from a histogram, not from a search.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/textures/halve.h"

namespace hearth::textures
{

/// Share of the texels (RGBA8) whose alpha passes the test: alpha / 255 >= cutoff.
double alphaCoverage(std::span<const std::byte> texels, float cutoff);

/// What alpha has to be multiplied with so that, once stored in 8 bits, a share of `coverage` passes the test.
/// 1 where that is so already, or where no scale can do it (nothing or everything is to be cut away).
float scaleForCoverage(const FloatImage& image, float cutoff, double coverage);

} // namespace hearth::textures

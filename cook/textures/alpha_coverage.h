// Keeps the area of alpha-tested cut-outs in mips: without it, leaves and grass thin out with distance.
// Source: I. Castano, "Computing Alpha Mipmaps", 2010. Differs: the scale comes from a histogram, not from a
// search.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/textures/halve.h"

namespace hearth::textures
{

/// Compute the share of the texels (RGBA8) whose alpha passes the test: alpha / 255 >= cutoff.
double alphaCoverage(std::span<const std::byte> texels, float cutoff);

/// Compute the factor of alpha with which, once stored in 8 bits, a share of `coverage` passes the test. 1 if
/// that is so already, or if no scale can reach it (nothing or everything is cut away).
float scaleForCoverage(const FloatImage& image, float cutoff, double coverage);

} // namespace hearth::textures

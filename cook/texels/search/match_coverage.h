// Keeps the area of cut-outs through compression: decoded alphas at the edge of a leaf are not those
// that were encoded, and more or fewer of them pass the alpha test.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/encoding/encode.h"

#include <cstddef>
#include <vector>

namespace hearth::texels
{

/// Maximum change of the share of texels of a mip that pass the alpha test, for which it is not encoded
/// again.
inline constexpr double kMaxCoverageChange = 0.005;

/// Encode mips of an alpha-tested image again, with their alpha scaled, while their decoded texels
/// cover an area that is off by more than kMaxCoverageChange; at most three times, the best result
/// stays. Scaling does not help alphas that are all 0 or 1 and cover too little. Same bytes for any
/// number of threads.
///
/// encoded  of all mips, as encodeImage; changed
void matchCoverage(const PlainImage& image, std::span<const SmoothCells> smooth, const Candidate& candidate,
                   Effort effort, std::vector<std::byte>& encoded);

} // namespace hearth::texels

// Cuts through a hierarchy, and their invariants.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/levels/validate.h"
#include "tests/support/surfaces/boundary.h"

#include <cstdint>
#include <random>
#include <span>
#include <vector>

namespace hearth::cuts
{

/// Return replaced[group] for the cut at one object-space error.
std::vector<uint8_t> cutAtError(const clusters::Hierarchy& hierarchy, double error);

/// Return the cut for an eye position, with errors up to `threshold` per distance.
std::vector<uint8_t> cutFromEye(const clusters::Hierarchy& hierarchy, Float3 eye, double threshold);

/// Return a random closed cut: a group is replaced with the given chance if all groups that its clusters were
/// made from are.
std::vector<uint8_t> randomCut(const clusters::Hierarchy& hierarchy, double chance, std::mt19937& random);

/// Return the position_id triples of the triangles that a cut draws.
std::vector<uint32_t> trianglesOfCut(const clusters::Hierarchy& hierarchy,
                                     const clusters::DecodedHierarchy& decoded,
                                     std::span<const uint8_t> replaced);

/// Level that leaves the box of the finest level the farthest.
struct Overshoot
{
    uint32_t level = 0;
    double part = 0;     ///< how far beyond the box, in parts of its diagonal
    double diagonal = 0; ///< of the box of the finest level, object space
};
Overshoot measureOvershoot(const clusters::Hierarchy& hierarchy);

/// Return the boundary of the finest level.
Boundary findSourceBoundary(const clusters::Hierarchy& hierarchy, const clusters::DecodedHierarchy& decoded);

} // namespace hearth::cuts

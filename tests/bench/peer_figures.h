// Figures of meshoptimizer's clusterlod.h (config "clod") on the same meshes. Cuts missing from a first
// measurement were made by running version 1.2 and measured by cut_quality.h, which reproduces the first
// figures of the other meshes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <array>
#include <string_view>

namespace hearth::bench
{

struct PeerCut
{
    double share;          ///< share of the source's triangles
    double rms;            ///< two-sided, as a part of the bounding box's diagonal
    double normal_rms_deg; ///< cut against the source
};

struct PeerFigures
{
    std::string_view mesh;
    /// user time, one thread, -O3 -march=native, on the machine of the first measurement
    double ktris_per_second;
    /// user time of 1.2, -O2, over the time of 0.18's meshlets and one halving; 0: unknown
    double calibration;
    std::array<PeerCut, 3> cuts{}; ///< share 0: unknown
};

inline constexpr std::array kPeerFigures = {
    PeerFigures{"rock2m", 565, 1.97, {{{0.5, 0.86e-4, 5.2}, {0.1, 3.30e-4, 16.0}, {0.01, 12.2e-4, 34.6}}}},
    PeerFigures{"terrain1m", 610, 2.18, {{{0.5, 0.54e-4, 3.1}, {0.1, 2.33e-4, 9.0}, {0.01, 10.0e-4, 21.4}}}},
    PeerFigures{"nefertiti", 558, 2.38, {{{0.5, 0.89e-4, 1.0}, {0.1, 3.23e-4, 3.1}, {0.01, 22.2e-4, 9.4}}}},
    PeerFigures{"seams500k", 534, 2.10, {{{0, 0, 0}, {0.1, 10.2e-4, 56}, {0.01, 22.1e-4, 65}}}},
    PeerFigures{"foliage", 370, 1.53, {}},
    PeerFigures{"rock200k", 606, 2.36, {{{0.5, 2.74e-4, 5.46}, {0.1, 10.6e-4, 16.2}, {0.01, 40.6e-4, 36.7}}}},
    PeerFigures{
        "stanford-bunny", 579, 2.46, {{{0.5, 0.994e-4, 1.09}, {0.1, 6.60e-4, 3.73}, {0.01, 49.9e-4, 12.1}}}},
    PeerFigures{"rocker-arm", 628, 0, {{{0.5, 1.82e-4, 1.53}, {0.1, 12.2e-4, 4.25}, {0.01, 91.8e-4, 24.4}}}},
    PeerFigures{"fandisk", 0, 0, {{{0.5, 0.202e-4, 0.053}, {0.1, 5.87e-4, 1.25}, {0.01, 89.9e-4, 20.4}}}},
};

} // namespace hearth::bench

// Plots the error of cuts over their triangle counts, beside the peers' figures.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/bench/cut_quality.h"
#include "tests/bench/peer_figures.h"

#include <string>
#include <vector>

namespace hearth::bench
{

struct MeshCurve
{
    std::string mesh;
    double source_triangles = 0;
    double diagonal = 0;
    std::vector<CutQuality> cuts;
    const PeerFigures* peer = nullptr; ///< may be null
};

/// SVG document: one panel for each mesh with peer figures; both axes are logarithmic, in powers of ten.
std::string errorPlot(const std::vector<MeshCurve>& curves);

} // namespace hearth::bench
